// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/shared_within.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "clash/polygon.hpp"
#include "measure/triangle_distance.hpp"

namespace impinge::clash {
namespace {

constexpr double kNarrow = 0x1p-10;  ///< times the resolution: far above the rounding of a common edge
constexpr double kFlushCosine = 0.9;
constexpr double kRun = 4;  ///< times the resolution: a shorter segment is a point

/// A triangle that is wide enough for its plane to be known.
struct Face {
  Triangle triangle;
  Vec3 normal;
};

/// The computed normal is off by an angle of at most 2^-50 / s, s being the sine of the two shorter edges' angle: it
/// lifts no point of the triangle by more than a quarter of the tolerance.
std::optional<Face> face_of(const Triangle& t, double tolerance, double scale) {
  const std::array<Vec3, 3> edges{t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  const Vec3 normal = cross(edges[0], edges[1]);
  const double longest = std::max({norm(edges[0]), norm(edges[1]), norm(edges[2])}), size = norm(normal);
  if (!(size > 0) || !(0x1p-50 * (longest + scale) * longest * longest <= size * tolerance / 4)) return {};
  return Face{t, (1 / size) * normal};
}

/// The prism over a face along a direction.
std::array<HalfSpace, 3> prism_over(const Face& face, const Vec3& direction) {
  std::array<HalfSpace, 3> sides;
  const double turn = dot(face.normal, direction) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 out = cross(face.triangle[(i + 1) % 3] - face.triangle[i], turn * direction);
    const Vec3 normal = (1 / norm(out)) * out;
    sides[i] = {normal, dot(normal, face.triangle[i])};
  }
  return sides;
}

/// The distance from a point to a face's plane along a direction, with a sign.
double way_to(const Face& face, const Vec3& point, const Vec3& direction) {
  return dot(face.triangle[0] - point, face.normal) / dot(direction, face.normal);
}

double distance_to_line(const Vec3& p, const Vec3& from, const Vec3& to) {
  return norm(cross(p - from, to - from)) / norm(to - from);
}

class Near {
 public:
  Near(const Triangle& a, const Triangle& b, const SharedWithinSetting& setting)
      : frame_(setting.frame),
        tolerance_(frame_.unit * setting.tolerance),
        resolution_(frame_.unit * setting.resolution) {
    const Triangle local_a = frame_.to_local(a), local_b = frame_.to_local(b);
    triangles_ = {local_a, local_b};
    faces_ = {face_of(local_a, tolerance_, frame_.scale), face_of(local_b, tolerance_, frame_.scale)};
  }

  /// Empty if the triangles are not flush.
  [[nodiscard]] SharedWithin shared_if_flush() const {
    if (!faces_[0] || !faces_[1]) return {};
    const double cosine = dot(faces_[0]->normal, faces_[1]->normal);
    if (!(std::abs(cosine) >= kFlushCosine)) return {};
    const Vec3 sum = faces_[0]->normal + (cosine < 0 ? -1.0 : 1.0) * faces_[1]->normal;
    const Vec3 direction = (1 / norm(sum)) * sum;
    Polygon overlap(faces_[0]->triangle);
    for (const HalfSpace& side : prism_over(*faces_[1], direction)) {
      overlap = cut(overlap, side).within;
      if (overlap.size() == 0) return {};
    }
    std::array<Vec3, 6> between{};  // each cut adds one corner at most
    std::size_t size = 0;
    double gap = 0;
    for (const Vec3& p : overlap) {
      const double way = way_to(*faces_[1], p, direction);
      if (!(std::abs(way) <= tolerance_)) return {};
      gap = std::max(gap, std::abs(way));
      between[size++] = p + (way / 2) * direction;
    }
    const SharedPart part = without_slivers(std::span(between).first(size));
    // Rounding decides whether triangles that end over each other overlap by a line.
    if (part.size < 3 && gap > resolution_) return {};
    return {part, gap / frame_.unit};
  }

  /// The longest part of an edge along the other triangle, if it is longer than kRun resolutions.
  [[nodiscard]] SharedWithin edge_part() const {
    Segment longest{};
    double gap = 0;
    double length = kRun * resolution_;
    for (std::size_t s = 0; s < 2; ++s) {
      if (!faces_[1 - s]) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const Face& face = *faces_[1 - s];
        const auto part = along({triangles_[s][i], triangles_[s][(i + 1) % 3]}, face);
        if (!part || norm((*part)[1] - (*part)[0]) <= length) continue;
        const double from = way_to(face, (*part)[0], face.normal), to = way_to(face, (*part)[1], face.normal);
        longest = {(*part)[0] + (from / 2) * face.normal, (*part)[1] + (to / 2) * face.normal};
        length = norm((*part)[1] - (*part)[0]), gap = std::max(std::abs(from), std::abs(to));
      }
    }
    if (!(length > kRun * resolution_)) return {};
    return {part_of(longest), gap / frame_.unit};
  }

 private:
  /// The part of an edge over a face, if all of it is within the resolution.
  [[nodiscard]] std::optional<Segment> along(Segment edge, const Face& face) const {
    for (const HalfSpace& side : prism_over(face, face.normal)) {
      const double from = dot(side.normal, edge[0]) - side.offset, to = dot(side.normal, edge[1]) - side.offset;
      if (from > 0 && to > 0) return {};
      const Vec3 at = from > 0 || to > 0 ? edge[0] + (from / (from - to)) * (edge[1] - edge[0]) : Vec3{};
      if (from > 0) edge[0] = at;
      if (to > 0) edge[1] = at;
    }
    for (const Vec3& p : edge)
      if (!(std::abs(way_to(face, p, face.normal)) <= resolution_)) return {};
    return edge;
  }

  /// Reduces a polygon narrower than kNarrow resolutions to a segment or a point.
  [[nodiscard]] SharedPart without_slivers(std::span<const Vec3> polygon) const {
    const double narrow = kNarrow * resolution_;
    Segment farthest{polygon[0], polygon[0]};
    for (const Vec3& p : polygon)
      for (const Vec3& q : polygon)
        if (norm(q - p) > norm(farthest[1] - farthest[0])) farthest = {p, q};
    if (norm(farthest[1] - farthest[0]) <= narrow) return part_of(std::array{farthest[0]});
    if (std::all_of(polygon.begin(), polygon.end(),
                    [&](const Vec3& p) { return distance_to_line(p, farthest[0], farthest[1]) <= narrow; }))
      return part_of(farthest);
    return part_of(polygon);
  }
  template <class Points>
  [[nodiscard]] SharedPart part_of(const Points& points) const {
    SharedPart part;
    for (const Vec3& p : points) part.corners[part.size++] = {frame_.to_world(p), 0};
    return part;
  }

  const LocalFrame& frame_;
  double tolerance_, resolution_;
  std::array<Triangle, 2> triangles_;
  std::array<std::optional<Face>, 2> faces_;
};

double length_of(const SharedPart& part, double unit) {
  return part.size == 2 ? norm(unit * (part.corners[1].point - part.corners[0].point)) : 0;
}

}  // namespace

SharedWithin shared_within(const Triangle& a, const Triangle& b, const SharedWithinSetting& setting) {
  const Near near(a, b, setting);
  const SharedWithin flush = near.shared_if_flush();
  if (flush.shared.size > 0) return flush;
  const SharedWithin edge = near.edge_part();
  if (edge.shared.size == 0)
    if (const auto vertex = common_vertex(a, b)) return {{{*vertex}, 1}};
  const SharedPart exact = shared_part(a, b);
  const double unit = setting.frame.unit;
  if (edge.shared.size > 0 && exact.size < 3 &&
      length_of(edge.shared, unit) >= length_of(exact, unit) - unit * setting.resolution)
    return edge;
  if (exact.size > 0) return {exact};
  const auto nearest = measure::triangle_distance(a, b, std::numeric_limits<double>::infinity());
  return {{{Corner{0.5 * nearest.a + 0.5 * nearest.b, 0}}, 1}};
}

}  // namespace impinge::clash
