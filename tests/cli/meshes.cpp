// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "meshes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>

namespace impinge::test {
namespace {

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t j = 0; j < 3; ++j)
      three = three << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j) text += i + j > bytes.size() ? '=' : kDigits[three >> (18 - 6 * j) & 63U];
  }
  return text;
}

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

}  // namespace

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

std::string obj(const Solid& solid) {
  std::string text;
  for (const auto& [x, y, z] : solid.vertices) text += fmt::format("v {} {} {}\n", x, y, z);
  for (const auto& [a, b, c] : solid.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
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
  const Solid solid = cube(0, 0, 0);
  std::string bytes;
  for (const auto& triangle : solid.triangles)
    for (const int v : triangle) append(bytes, static_cast<std::uint16_t>(v));
  const std::size_t index_bytes = bytes.size();
  for (const auto& vertex : solid.vertices)
    for (const int c : vertex) append(bytes, static_cast<float>(c));

  std::string list, all;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto& [x, y, z] = nodes[i].shift;
    list +=
        fmt::format(R"({}{{"name":"{}","mesh":0,"translation":[{},{},{}]}})", i > 0 ? "," : "", nodes[i].name, x, y, z);
    all += fmt::format("{}{}", i > 0 ? "," : "", i);
  }
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{}]}}],"nodes":[{}],)"
      R"("meshes":[{{"name":"cube","primitives":[{{"attributes":{{"POSITION":1}},"indices":0}}]}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5123,"count":36,"type":"SCALAR"}},)"
      R"({{"bufferView":1,"componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],"max":[2,2,2]}}],)"
      R"("bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],)"
      R"("buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{}"}}]}})",
      all, list, index_bytes, index_bytes, bytes.size() - index_bytes, bytes.size(), base64(bytes));
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
