// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/half_planes.hpp"

#include <array>
#include <cmath>

#include "exact/segment.hpp"
#include "solid/triangles.hpp"

namespace impinge::clash {
namespace {

using exact::Rational;

const exact::Projection& projection_of(const Triangle& t) {
  return exact::kProjections[static_cast<std::size_t>(exact::find_projection(t[0], t[1], t[2]))];
}

/// Twice the area between the line's two points and p, in the projection.
Rational height(const exact::Projection& projection, const Line& line, const Vec3& p) {
  const auto difference = [&](const Vec3& x, int axis) {
    return Rational(Rational(component(x, axis)) - Rational(component(line.from(), axis)));
  };
  const auto [u, v] = projection;
  return difference(line.to(), u) * difference(p, v) - difference(line.to(), v) * difference(p, u);
}

}  // namespace

Line::Line(const Vec3& from, const Vec3& to) : from_(from), to_(to), axis_(0) {
  // Halves do not overflow. Any axis in which the two differ would do.
  const Vec3 step = abs(0.5 * to - 0.5 * from);
  axis_ = step.x >= std::max(step.y, step.z) ? 0 : step.y >= step.z ? 1 : 2;
  backward_ = component(to, axis_) < component(from, axis_);
}

std::optional<Stretch> stretch_of(const Line& line, const Triangle& t, std::uint32_t number) {
  if (exact::orient3d(t[0], t[1], t[2], line.from()) != 0 || exact::orient3d(t[0], t[1], t[2], line.to()) != 0)
    return std::nullopt;
  const exact::Projection& projection = projection_of(t);
  std::array<int, 3> side{};
  for (std::size_t i = 0; i < 3; ++i) side[i] = exact::orient2d(projection, line.from(), line.to(), t[i]);
  std::vector<Rational> ends;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (side[i] == 0) ends.push_back(line.along(t[i]));
    if (side[i] * side[j] >= 0) continue;
    const Rational p = height(projection, line, t[i]), q = height(projection, line, t[j]);
    ends.emplace_back((p * line.along(t[j]) - q * line.along(t[i])) / (p - q));
  }
  if (ends.size() != 2 || ends[0] == ends[1]) return std::nullopt;
  Stretch stretch{std::min(ends[0], ends[1]), std::max(ends[0], ends[1]), {}};
  for (const int way : {1, -1})
    for (std::size_t i = 0; i < 3; ++i) {
      if (side[i] != way) continue;
      stretch.half_planes.push_back({number, t[i], solid::same_orientation({line.from(), line.to(), t[i]}, t)});
      break;
    }
  return stretch;
}

std::vector<std::vector<HalfPlane>> in_order(const Line& line, const std::vector<HalfPlane>& half_planes) {
  const auto turn = [&](const HalfPlane& p, const HalfPlane& q) {
    return exact::orient3d(line.from(), line.to(), p.toward, q.toward);
  };
  const HalfPlane& first = half_planes.front();
  // By quarters from the first: along it, up to half a turn, opposite of it, beyond.
  const auto quarter = [&](const HalfPlane& half_plane) {
    const int way = turn(first, half_plane);
    if (way != 0) return way > 0 ? 1 : 3;
    return solid::same_orientation({line.from(), line.to(), first.toward}, {line.from(), line.to(), half_plane.toward})
               ? 0
               : 2;
  };
  const auto comes_before = [&](const HalfPlane& p, const HalfPlane& q) {
    const int of_p = quarter(p), of_q = quarter(q);
    return of_p != of_q ? of_p < of_q : turn(p, q) > 0;
  };
  std::vector<HalfPlane> sorted = half_planes;
  std::sort(sorted.begin(), sorted.end(), comes_before);
  std::vector<std::vector<HalfPlane>> rays;
  for (const HalfPlane& half_plane : sorted) {
    if (rays.empty() || comes_before(rays.back().front(), half_plane)) rays.emplace_back();
    rays.back().push_back(half_plane);
  }
  return rays;
}

}  // namespace impinge::clash
