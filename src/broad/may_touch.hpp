// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene_view.hpp"

namespace impinge::broad {

/// Whether two objects are to be tested, and their bounds meet: boxes, then spheres (section 3.2 of the paper).
bool may_touch(const scene::SceneView& view, std::uint32_t a, std::uint32_t b);

}  // namespace impinge::broad
