// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/near_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "clash/slab.hpp"
#include "measure/nearest.hpp"
#include "measure/triangle_distance.hpp"

namespace impinge::clash {
namespace {

/// In tolerances: what is no farther from a point than the first of these is there, and a ray is with another one if it
/// ends no farther from it than the second. (A line may be one tolerance off what is near it, and so may what is near
/// on its other side.)
constexpr double kThere = 3, kWith = 2;

struct Span {
  double lo, hi;
  [[nodiscard]] double length() const { return hi - lo; }
};

/// Of the points from + s along, those within a half space.
Span clip(const Span& span, const Vec3& from, const Vec3& along, const HalfSpace& half_space) {
  const double slope = dot(half_space.normal, along), room = half_space.offset - dot(half_space.normal, from);
  if (slope > 0) return {span.lo, std::min(span.hi, room / slope)};
  if (slope < 0) return {std::max(span.lo, room / slope), span.hi};
  return room >= 0 ? span : Span{kInfinity, -kInfinity};
}

/// What a triangle has of a plane across a line.
std::optional<Segment> section(const Triangle& t, const Vec3& point, const Vec3& along) {
  std::array<double, 3> height{};
  for (std::size_t i = 0; i < 3; ++i) height[i] = dot(t[i] - point, along);
  Segment found{};
  std::size_t size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if ((height[i] > 0) != (height[j] > 0) && size < 2)
      found[size++] = t[i] + (height[i] / (height[i] - height[j])) * (t[j] - t[i]);
  }
  return size == 2 ? std::optional(found) : std::nullopt;
}

double distance(const Vec3& point, const Segment& segment) {
  const Vec3 way = segment[1] - segment[0];
  const double square = dot(way, way);
  const double share = square > 0 ? std::clamp(dot(point - segment[0], way) / square, 0.0, 1.0) : 0;
  return norm(point - segment[0] - share * way);
}

Vec3 normal(const Triangle& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// A triangle's half-plane as it goes on from a point.
struct NearHalfPlane {
  HalfPlane half_plane;
  Segment section;  ///< of the whole triangle
  double extent, angle;
};

}  // namespace

std::optional<NearLine> NearGeometry::line(const Vec3& from, const Vec3& to) const {
  const double length = norm(to - from);
  if (!is_long(length)) return std::nullopt;
  return NearLine{from, (1 / length) * (to - from), length};
}

std::optional<NearStretch> NearGeometry::stretch(const NearLine& line, const Triangle& triangle,
                                                 std::uint32_t number) const {
  const auto slab = make_slab(triangle, tolerance_, frame_.scale);
  if (!slab || !slab->has_plane) return std::nullopt;
  const auto clipped = [&](double margin) {
    Span span{0, line.length};
    const auto clip_by = [&](const HalfSpace& half_space) {
      span = clip(span, line.from, line.along, {half_space.normal, half_space.offset + margin});
    };
    for (std::size_t i = 0; i < slab->size; ++i) clip_by(slab->sides[i]);
    clip_by(slab->top), clip_by(slab->bottom);
    return span;
  };
  const Span near = clipped(tolerance_), nearby = clipped(3 * tolerance_);
  if (!(nearby.length() > 0)) return std::nullopt;
  NearStretch stretch{nearby.lo, nearby.hi, 2 * near.lo - nearby.lo, 2 * near.hi - nearby.hi, false, number, triangle};
  if (!(near.length() > 0) || !(stretch.surely_hi > stretch.surely_lo)) {
    stretch.surely_lo = stretch.surely_hi = nearby.hi;
    // What ends because the two part at an angle is as much longer as the distance is, or by half of that if the line
    // begins beyond the triangle.
    stretch.is_beside = clipped(3.25 * tolerance_).length() < (1 + 1.0 / 32) * nearby.length();
  }
  return stretch;
}

std::optional<std::vector<Ray>> NearGeometry::rays(const NearLine& line, double at,
                                                   const std::vector<const NearStretch*>& near) const {
  const Vec3 point = line.from + at * line.along;
  std::vector<NearHalfPlane> half_planes;
  for (const NearStretch* const stretch : near) {
    const auto found = section(stretch->triangle, point, line.along);
    if (!found || distance(point, *found) > kThere * tolerance_) continue;
    if (!is_long(std::max(norm((*found)[0] - point), norm((*found)[1] - point)))) return std::nullopt;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 way = (*found)[i] - point, back = (*found)[1 - i] - point;
      const double extent = norm(way);
      if (dot(way, back) > 0 && extent < norm(back)) continue;
      if (extent <= tolerance_) continue;
      if (!is_long(extent) && ends_on(point, (*found)[i], stretch->number % 2 == 0 ? b_ : a_)) return std::nullopt;
      const bool ahead_is_front = dot(normal(stretch->triangle), impinge::cross(line.along, way)) > 0;
      half_planes.push_back({{stretch->number, (*found)[i], ahead_is_front}, *found, extent, 0});
    }
  }
  if (half_planes.empty()) return std::vector<Ray>{};
  const Vec3 right = half_planes[0].half_plane.toward - point, up = impinge::cross(line.along, right);
  for (NearHalfPlane& half_plane : half_planes)
    half_plane.angle =
        std::atan2(dot(half_plane.half_plane.toward - point, up), dot(half_plane.half_plane.toward - point, right));
  std::stable_sort(half_planes.begin(), half_planes.end(),
                   [](const NearHalfPlane& p, const NearHalfPlane& q) { return p.angle < q.angle; });
  const auto are_one = [&](const NearHalfPlane& p, const NearHalfPlane& q) {
    const auto& [shorter, longer] = p.extent < q.extent ? std::tie(p, q) : std::tie(q, p);
    return dot(shorter.half_plane.toward - point, longer.half_plane.toward - point) > 0 &&
           distance(shorter.half_plane.toward, longer.section) <= kWith * tolerance_;
  };
  for (std::size_t i = 0; half_planes.size() > 1 && i < half_planes.size(); ++i) {
    const NearHalfPlane &half_plane = half_planes[i], &next = half_planes[(i + 1) % half_planes.size()];
    if (!is_long(std::min(half_plane.extent, next.extent)) && are_one(half_plane, next)) return std::nullopt;
  }
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < half_planes.size(); ++i) {
    if (i == 0 || !are_one(half_planes[i - 1], half_planes[i])) rays.emplace_back();
    rays.back().push_back(half_planes[i].half_plane);
  }
  if (rays.size() > 1 && are_one(half_planes.back(), half_planes.front())) {
    rays.front().insert(rays.front().end(), rays.back().begin(), rays.back().end());
    rays.pop_back();
  }
  return rays;
}

/// Whether a half-plane ends on the other part, and lies on it half-way.
bool NearGeometry::ends_on(const Vec3& from, const Vec3& to, const solid::Body& other) const {
  const double within = tolerance_ / frame_.unit;
  const auto is_near = [&](const Vec3& point) {
    return measure::nearest_point(other.placed, frame_.to_world(point), within, within).has_value();
  };
  return is_near(to) && is_near(0.5 * (from + to));
}

bool NearGeometry::cross(const Triangle& a, const Triangle& b) const {
  const Vec3 of_a = normal(a), of_b = normal(b), way = impinge::cross(of_a, of_b);
  const double size = norm(way);
  if (!(size > 0x1p-20 * norm(of_a) * norm(of_b))) return false;
  const Vec3 along = (1 / size) * way;
  // The point of both planes that is nearest to a corner of a.
  const Vec3 down = impinge::cross(along, of_a);
  const Vec3 from = a[0] + (dot(of_b, b[0] - a[0]) / dot(of_b, down)) * down;
  Span span{-kInfinity, kInfinity};
  for (const auto& [t, up] : {std::pair(&a, &of_a), {&b, &of_b}})
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 outward = impinge::cross((*t)[(i + 1) % 3] - (*t)[i], *up);
      span = clip(span, from, along, {outward, dot(outward, (*t)[i])});
    }
  if (!is_long(span.length())) return false;
  const Vec3 middle = from + ((span.lo + span.hi) / 2) * along;
  const auto goes_on = [&](const Triangle& one, const Triangle& other) {
    const auto found = section(one, middle, along);
    return found && std::all_of(found->begin(), found->end(), [&](const Vec3& end) {
             return measure::point_distance(end, other, kInfinity).distance > tolerance_;
           });
  };
  return goes_on(a, b) && goes_on(b, a);
}

bool NearGeometry::is_narrow(const Triangle& t) const {
  constexpr double kNarrow = 64;
  const double longest = std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
  return norm(normal(t)) <= kNarrow * tolerance_ * longest;
}

/// Whether of two near triangles some of what a has over b is farther than the tolerance, and nothing by much.
bool NearGeometry::parts_a_little(const Triangle& a, const Triangle& b) const {
  constexpr double kMuch = 8;
  const auto slab = make_slab(b, tolerance_, frame_.scale);
  if (!slab || !slab->has_plane) return false;
  double height = 0;
  for (const Vec3& point : between(Polygon(a), *slab))
    height = std::max(height, std::abs(dot(slab->top.normal, point - b[0])));
  return height > tolerance_ && height <= kMuch * tolerance_;
}

bool NearGeometry::is_open(const Triangle& a, const Triangle& b) const {
  if (is_narrow(a) || is_narrow(b)) return true;
  const Vec3 of_a = normal(a), of_b = normal(b);
  // At a steeper angle it is plain where they part.
  const bool is_flat = norm(impinge::cross(of_a, of_b)) < 0.5 * norm(of_a) * norm(of_b);
  return is_flat && (parts_a_little(a, b) || parts_a_little(b, a));
}

bool NearGeometry::share_area(const Triangle& a, const Triangle& b) const {
  const double near = width_within(a, b, tolerance_), nearby = width_within(a, b, 2 * tolerance_);
  return is_long(2 * near - nearby);
}

double NearGeometry::width_within(const Triangle& a, const Triangle& b, double tolerance) const {
  const auto slab = make_slab(b, tolerance, frame_.scale);
  if (!slab || !slab->has_plane) return 0;
  const Polygon piece = cut(cut(between(Polygon(a), *slab), slab->top).within, slab->bottom).within;
  double width = kInfinity;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec3 &from = piece[i], way = piece[(i + 1) % piece.size()] - from;
    if (!(norm(way) > tolerance_ / 16)) continue;  // too short to have a direction
    double height = 0;
    for (const Vec3& point : piece) height = std::max(height, norm(impinge::cross(way, point - from)) / norm(way));
    width = std::min(width, height);
  }
  return width < kInfinity ? width : 0;
}

}  // namespace impinge::clash
