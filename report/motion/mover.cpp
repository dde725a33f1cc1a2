// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/motion/mover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

namespace impinge::report {
namespace {

/// For each node the nearest one up the tree, itself included, that the animation moves, and 1; 0 if there is none.
std::vector<std::uint32_t> movers_of(const io::Model& model, const io::Animation& animation) {
  std::vector<std::uint32_t> movers(model.nodes.size(), 0);
  for (const io::Track& track : animation.tracks) movers[track.node] = track.node + 1;
  for (std::size_t i = 0; i < movers.size(); ++i)
    if (movers[i] == 0 && model.nodes[i].parent) movers[i] = movers[*model.nodes[i].parent];
  return movers;
}

/// Whether a mesh may be posed by this instead of being mapped: the bounds of `Pose`.
bool is_rigid(const Affine& map) {
  constexpr double kMostOff = 1e-6;
  const auto& m = map.m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      const double product = m[i] * m[j] + m[3 + i] * m[3 + j] + m[6 + i] * m[6 + j];
      if (!(std::fabs(product - (i == j ? 1 : 0)) <= kMostOff)) return false;
    }
  }
  const double determinant =
      m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
  return determinant > 0 && std::all_of(map.t.begin(), map.t.end(), [](double t) { return std::isfinite(t); });
}

/// By the adjugate; its entries are not finite where there is no inverse.
Affine inverse(const Affine& map) {
  const auto& m = map.m;
  Affine out;
  const auto cofactor = [&](std::size_t row, std::size_t column) {
    const std::size_t r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (column + 1) % 3, c2 = (column + 2) % 3;
    return m[3 * r1 + c1] * m[3 * r2 + c2] - m[3 * r1 + c2] * m[3 * r2 + c1];
  };
  const double determinant = m[0] * cofactor(0, 0) + m[1] * cofactor(0, 1) + m[2] * cofactor(0, 2);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) out.m[3 * row + column] = cofactor(column, row) / determinant;
  for (std::size_t row = 0; row < 3; ++row) {
    const double* const r = &out.m[3 * row];
    out.t[row] = -((r[0] * map.t[0] + r[1] * map.t[1]) + r[2] * map.t[2]);
  }
  return out;
}

bool is_finite(const Affine& map) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::all_of(map.m.begin(), map.m.end(), finite) && std::all_of(map.t.begin(), map.t.end(), finite);
}

}  // namespace

Mover::Mover(const io::Model& model, const io::Animation& animation) : model_(model), animation_(animation) {
  const std::vector<std::uint32_t> movers = movers_of(model, animation);
  for (const io::Object& object : model.objects) bodies_.push_back(object.node ? movers[*object.node] : 0);
  rest_ = io::nodes_at(model, {}, 0);
}

Result<Posed> Mover::place(std::size_t i, const std::vector<Affine>& worlds, double seconds) const {
  const io::Object& object = model_.objects[i];
  if (bodies_[i] == 0) return Posed{object.mesh, object.pose, {object.pose.R, object.pose.t}};
  const auto error = [&](Code code, std::string_view message) {
    return Error{code, fmt::format("object '{}' at {} s: {}", object.name, seconds, message)};
  };
  // A mesh that was mapped by where its node is at rest is first brought back from there.
  Affine map = worlds[*object.node];
  if (object.is_baked) {
    const Affine back = inverse(rest_[*object.node]);
    if (!is_finite(back))
      return error(Code::bad_file,
                   "it is scaled to nothing where it rests, so that no shape of it is left; give its "
                   "node a scale other than 0");
    map = io::product(map, back);
  }
  if (is_rigid(map)) return Posed{object.mesh, {map.m, map.t}, map};
  Result<Mesh> mapped = object.mesh.transformed(map);
  if (!mapped) return error(mapped.error().code, mapped.error().message);
  return Posed{std::move(*mapped), Pose{}, map};
}

Result<std::vector<Posed>> Mover::at(double seconds) const {
  std::vector<std::uint32_t> all(model_.objects.size());
  std::iota(all.begin(), all.end(), 0U);
  return at(seconds, all);
}

Result<std::vector<Posed>> Mover::at(double seconds, std::span<const std::uint32_t> objects) const {
  const std::vector<Affine> worlds = io::nodes_at(model_, animation_, seconds);
  std::vector<Posed> posed;
  posed.reserve(objects.size());
  for (const std::uint32_t i : objects) {
    Result<Posed> placed = place(i, worlds, seconds);
    if (!placed) return placed.error();
    posed.push_back(std::move(*placed));
  }
  return posed;
}

}  // namespace impinge::report
