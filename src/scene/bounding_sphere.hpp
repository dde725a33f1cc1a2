// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "core/shapes.hpp"

namespace impinge::scene {

/// The smallest sphere around the points, up to rounding; it holds every one of them for certain.
Sphere bounding_sphere(std::span<const Vec3> points);

}  // namespace impinge::scene
