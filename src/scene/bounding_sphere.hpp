// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "core/shapes.hpp"
#include "scene/vertex_numbers.hpp"

namespace impinge::scene {

/// The smallest sphere around the points, up to rounding; it holds every one of them for certain. `numbers` are theirs.
Sphere bounding_sphere(std::span<const Vec3> points, const VertexNumbers& numbers);

}  // namespace impinge::scene
