// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/model.hpp"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "io/precision.hpp"
#include "io/triangulate.hpp"

namespace impinge::io {
namespace {

std::vector<std::uint32_t> triangulated(const Part& part, Triangulator& triangulator) {
  std::vector<std::uint32_t> triangles;
  triangles.reserve(part.corners.size());
  const std::span<const std::uint32_t> corners = part.corners;
  std::size_t first = 0;
  for (const std::uint32_t size : part.sizes) {
    triangulator.append(corners.subspan(first, size), triangles);
    first += size;
  }
  return triangles;
}

/// The vertices that the triangles use, in their old order; the triangles then speak of these.
std::vector<double> take_used(const std::vector<double>& xyz, std::vector<std::uint32_t>& triangles) {
  std::vector<std::uint32_t> used = triangles;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::uint32_t& corner : triangles) {
    corner = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
  }
  std::vector<double> out;
  out.reserve(3 * used.size());
  for (const std::uint32_t vertex : used) {
    const auto at = xyz.begin() + 3 * static_cast<std::ptrdiff_t>(vertex);
    out.insert(out.end(), at, at + 3);
  }
  return out;
}

}  // namespace

Result<Model> make_model(const Source& source, Parts&& parts) {
  Model model;
  model.warnings = std::move(parts.warnings);
  Triangulator triangulator(parts.xyz);
  PrecisionCheck precision;
  for (Part& part : parts.parts) {
    std::vector<std::uint32_t> triangles = triangulated(part, triangulator);
    if (triangles.empty()) continue;
    const bool is_only = parts.parts.size() == 1;
    const Precision numbers = parts.floats ? Precision::single : Precision::whole;
    Result<Mesh> mesh = is_only ? Mesh::create(parts.xyz, triangles, {}, numbers)
                                : Mesh::create(take_used(parts.xyz, triangles), triangles, {}, numbers);
    if (!mesh) return file_error(source, mesh.error().message);
    std::string name = part.name.empty() ? std::string(source.name) : std::move(part.name);
    if (parts.floats) precision.add(name, *mesh, Affine{});
    model.objects.push_back({name, name, "", std::move(*mesh), Pose{}});
  }
  if (model.objects.empty()) {
    return file_error(source, "the file holds no triangles; export the part as a mesh with faces");
  }
  if (triangulator.fanned() > 0) {
    model.warnings.push_back(sentence(
        triangulator.fanned(),
        " concave polygons could not be cut into ears, because their outlines cross themselves or are too long; they "
        "became fans, which may cover more than the polygon: export the file with triangulated faces."));
  }
  precision.report(model.warnings);
  make_names_unique(model.objects);
  return model;
}

void make_names_unique(std::vector<Object>& objects) {
  std::unordered_set<std::string> taken;
  for (const Object& object : objects) taken.insert(object.name);
  std::unordered_map<std::string, std::uint64_t> uses;
  for (Object& object : objects) {
    std::uint64_t& number = uses[object.name];
    if (++number == 1) continue;
    std::string candidate = sentence(object.name, " (", number, ")");
    while (!taken.insert(candidate).second) candidate = sentence(object.name, " (", ++number, ")");
    object.name = std::move(candidate);
  }
}

}  // namespace impinge::io
