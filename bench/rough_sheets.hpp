// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/scene.hpp"

namespace impinge::bench {

/// Two wrinkled sheets of about `triangles` triangles each that lie in one another, turned so that nothing is along an
/// axis: about one and a half pairs touch for each triangle of one of them.
scenes::PlacedScene rough_sheets(int triangles);

}  // namespace impinge::bench
