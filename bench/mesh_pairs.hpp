// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "scenes/contact_depth.hpp"
#include "scenes/scene.hpp"

/// The pairs of meshes that collision libraries are usually measured on: two rigid copies of one mesh.
namespace impinge::bench {

struct Subject {
  std::string name;
  scenes::MeshData data;
};

/// Five torus knots; then an animal, a machine part and a scan from libcgal-demo.
std::vector<Subject> torus_knots();
std::vector<Subject> demo_meshes();

enum class Depth : std::uint8_t {
  light,  ///< 0.03 bounding-sphere diameters past first touch
  deep,   ///< sphere centres 0.2 diameters apart
};
inline constexpr std::array<Depth, 2> kDepths{Depth::light, Depth::deep};
const char* name_of(Depth depth);

/// The same poses in every run.
std::vector<scenes::PosePair> random_poses(const Mesh& mesh, Depth depth, int poses);

}  // namespace impinge::bench
