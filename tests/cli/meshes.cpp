// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "meshes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tests/io/animated_gltf.hpp"

namespace impinge::test {
Solid cube(int x, int y, int z) { return box({x, y, z}, {x + 2, y + 2, z + 2}); }

Solid box(const std::array<int, 3>& lo, const std::array<int, 3>& hi) {
  Solid solid;
  for (const int z : {lo[2], hi[2]})
    for (const int y : {lo[1], hi[1]})
      for (const int x : {lo[0], hi[0]}) solid.vertices.push_back({x, y, z});
  solid.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return solid;
}

Solid sheet(const std::array<int, 2>& lo, const std::array<int, 2>& hi, int z) {
  return {{{lo[0], lo[1], z}, {hi[0], lo[1], z}, {hi[0], hi[1], z}, {lo[0], hi[1], z}}, {{0, 1, 2}, {0, 2, 3}}};
}

std::string off(const Solid& solid) {
  std::string text = fmt::format("OFF\n{} {} 0\n", solid.vertices.size(), solid.triangles.size());
  for (const auto& [x, y, z] : solid.vertices) text += fmt::format("{} {} {}\n", x, y, z);
  for (const auto& [a, b, c] : solid.triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
  return text;
}

void write_off(const Folder& folder, const std::vector<std::pair<std::string, Solid>>& solids) {
  for (const auto& [name, solid] : solids) folder.write(name + ".off", off(solid));
}

Solid as_one(const std::vector<Solid>& solids) {
  Solid all;
  for (const Solid& solid : solids) {
    const auto first = static_cast<int>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), solid.vertices.begin(), solid.vertices.end());
    for (const auto& [a, b, c] : solid.triangles) all.triangles.push_back({a + first, b + first, c + first});
  }
  return all;
}

std::string obj(const Solid& solid) { return obj({{"", solid}}); }

std::string obj(const std::vector<std::pair<std::string, Solid>>& parts) {
  std::string text;
  int first = 1;
  for (const auto& [name, solid] : parts) {
    if (!name.empty()) text += "o " + name + "\n";
    for (const auto& [x, y, z] : solid.vertices) text += fmt::format("v {} {} {}\n", x, y, z);
    for (const auto& [a, b, c] : solid.triangles) text += fmt::format("f {} {} {}\n", a + first, b + first, c + first);
    first += static_cast<int>(solid.vertices.size());
  }
  return text;
}

std::string ply(const Solid& solid) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      solid.vertices.size(), solid.triangles.size());
  for (const auto& [x, y, z] : solid.vertices) text += fmt::format("{} {} {}\n", x, y, z);
  for (const auto& [a, b, c] : solid.triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
  return text;
}

std::string stl(const Solid& solid) {
  std::string text = "solid cube\n";
  for (const auto& triangle : solid.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int v : triangle) {
      const auto& [x, y, z] = solid.vertices[static_cast<std::size_t>(v)];
      text += fmt::format("vertex {} {} {}\n", x, y, z);
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid cube\n";
}

std::string gltf(const std::vector<Node>& nodes) {
  AnimatedGltf file;
  std::vector<int> roots;
  for (const auto& [name, shift] : nodes)
    roots.push_back(
        file.node({{"name", name}, {"mesh", 0}, {"translation", {shift[0] + 1, shift[1] + 1, shift[2] + 1}}}));
  file.roots(roots);
  return file.text();
}

std::string off_fan(int triangles, double turn) {
  std::string text = fmt::format("OFF\n{} {} 0\n0 0 0\n", 2 * triangles + 1, triangles);
  for (int i = 0; i < triangles; ++i) {
    const double angle = turn + i;
    text += fmt::format("{} {} {}\n", std::cos(angle), std::sin(angle), std::sin(7 * angle));
    text += fmt::format("{} {} {}\n", std::cos(angle + 2), std::sin(angle + 2), std::cos(5 * angle));
  }
  for (int i = 0; i < triangles; ++i) text += fmt::format("3 0 {} {}\n", 2 * i + 1, 2 * i + 2);
  return text;
}

}  // namespace impinge::test
