// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/contact_depth.hpp"
#include "scenes/scene.hpp"

/// The pairs of meshes that collision libraries are usually measured on: two rigid copies of one mesh.
namespace impinge::bench {

struct Subject {
  std::string name;
  scenes::MeshData data;
  double thickness = 1;  ///< of its length
};

Subject torus_knot_subject(int triangles);
/// A file of libcgal-demo: a scan, or a machine part.
Subject demo_subject(const std::string& file);
/// Ten times as long along (1, 1, 1): a shape that boxes along the axes fit badly.
Subject elongated(Subject subject);

/// Torus knots of `kPaperSizes`.
std::vector<Subject> paper_subjects();

enum class Depth : std::uint8_t {
  near,   ///< a gap of 0.01 bounding-sphere diameters before first touch
  light,  ///< 0.03 diameters past first touch
  deep,   ///< sphere centres 0.2 diameters apart, times the thickness of the mesh
};
inline constexpr std::array<Depth, 3> kDepths{Depth::near, Depth::light, Depth::deep};
const char* name_of(Depth depth);

/// The same poses in every run.
std::vector<scenes::PosePair> random_poses(const Mesh& mesh, Depth depth, int poses, double thickness = 1);

}  // namespace impinge::bench
