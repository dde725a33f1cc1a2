// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/self/self_edge_crossings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>

#include "clash/slab.hpp"
#include "clash/wall.hpp"
#include "core/local_frame.hpp"
#include "measure/nearest.hpp"

namespace impinge::clash {
namespace {

/// By how many tolerances surfaces that cross go on, on all four sides and along the line. Less may be the height of a
/// sliver, or the end of a triangle where the next one bends away.
constexpr double kFarther = 16;

/// Part of an edge.
struct Stretch {
  Vec3 from, to;
};

class SelfEdgeCrossings {
 public:
  SelfEdgeCrossings(const solid::Body& body, const solid::Topology& topology, double tolerance)
      : body_(body), topology_(topology), frame_(local_frame(body.box, body.box)) {
    // Twice what slabs need at least, so that their planes are known; and far less than the wall, since the two faces
    // of a wall do not cross each other.
    const double least = 2 * kLeastTolerance * frame_.scale, most = wall() / 16 / kFarther;
    tolerance_ = std::max(std::min(frame_.unit * tolerance, most), least);
    is_told_ = tolerance_ <= 4 * most;
  }

  /// Whether the tolerance is so far below the wall that crossings can be told from the two faces of a wall.
  [[nodiscard]] bool is_told() const { return is_told_; }
  /// How far apart the triangles of a pair may be, in the world.
  [[nodiscard]] double reach() const { return tolerance_ / frame_.unit; }

  bool is_one(std::uint32_t a, std::uint32_t b) {
    if (!topology_.is_proper(a) || !topology_.is_proper(b) || common_positions(a, b) > 1) return false;
    return passes(a, b) || passes(b, a);
  }

 private:
  /// The thickness of the body's wall, in local units.
  [[nodiscard]] double wall() const {
    AreaAndVolume whole;
    for (std::uint32_t t = 0; t < body_.size(); ++t) whole.add(local(t));
    return whole.wall();
  }

  [[nodiscard]] int common_positions(std::uint32_t a, std::uint32_t b) const {
    int common = 0;
    for (const std::uint32_t p : topology_.corners(body_, a))
      for (const std::uint32_t q : topology_.corners(body_, b)) common += int{p == q};
    return common;
  }
  [[nodiscard]] Triangle local(std::uint32_t t) const { return frame_.to_local(body_.triangle(t)); }

  /// The positions of an edge's ends, the lower one first.
  using Edge = std::array<std::uint32_t, 2>;
  [[nodiscard]] Edge edge_of(std::uint32_t t, std::size_t k) const {
    const auto at = topology_.corners(body_, t);
    return {std::min(at[k], at[(k + 1) % 3]), std::max(at[k], at[(k + 1) % 3])};
  }

  /// The two proper triangles that use an edge; nothing if there are more or fewer.
  using Pair = std::array<std::uint32_t, 2>;
  [[nodiscard]] std::optional<Pair> sheet_at(const Edge& edge) const {
    Pair pair{};
    std::size_t uses = 0;
    topology_.for_each_use(body_, edge[0], edge[1], [&](std::uint32_t t, std::uint32_t) {
      if (!topology_.is_proper(t)) return;
      if (uses < 2) pair[uses] = t;
      ++uses;
    });
    return uses == 2 ? std::optional(pair) : std::nullopt;
  }

  /// The corner of a triangle that is not on its edge.
  [[nodiscard]] Vec3 apex(std::uint32_t t, const Edge& edge) const {
    const auto at = topology_.corners(body_, t);
    std::size_t k = 0;
    while (k < 2 && (at[k] == edge[0] || at[k] == edge[1])) ++k;
    return local(t)[k];
  }

  /// Whether the surface passes through b, or through an edge of b, along an edge of a.
  bool passes(std::uint32_t a, std::uint32_t b) {
    const Triangle of_a = local(a);
    const auto slab = make_slab(local(b), tolerance_, frame_.scale);
    if (!slab || !slab->has_plane) return false;
    for (std::size_t e = 0; e < 3; ++e) {
      const auto near = clipped({of_a[e], of_a[(e + 1) % 3]}, *slab);
      if (!near || norm(near->to - near->from) <= kFarther * tolerance_) continue;
      const Edge edge = edge_of(a, e);
      const auto sheet = sheet_at(edge);
      if (sheet && passes_at(*sheet, edge, *near, b, *slab)) return true;
    }
    return false;
  }

  /// The part of an edge between a slab's sides, if all of it is in the slab: an edge that only pierces the slab does
  /// not run along the triangle, however flat the angle.
  static std::optional<Stretch> clipped(Stretch s, const Slab& slab) {
    const auto clip = [&](const HalfSpace& half_space) {
      const double p = dot(half_space.normal, s.from) - half_space.offset;
      const double q = dot(half_space.normal, s.to) - half_space.offset;
      if (p > 0 && q > 0) return false;
      if (p > 0) s.from = s.from + (p / (p - q)) * (s.to - s.from);
      if (q > 0) s.to = s.from + (p / (p - q)) * (s.to - s.from);
      return true;
    };
    for (std::size_t i = 0; i < slab.size; ++i)
      if (!clip(slab.sides[i])) return std::nullopt;
    for (const HalfSpace* const half_space : {&slab.top, &slab.bottom})
      for (const Vec3& end : {s.from, s.to})
        if (dot(half_space->normal, end) > half_space->offset) return std::nullopt;
    return s;
  }

  /// Whether the two sheets alternate around the middle of the segment that the triangles share.
  bool passes_at(const Pair& sheet, const Edge& edge, const Stretch& near, std::uint32_t b, const Slab& slab) {
    const Vec3 middle = 0.5 * (near.from + near.to), along = near.to - near.from;
    const std::array<Vec3, 2> own{apex(sheet[0], edge) - middle, apex(sheet[1], edge) - middle};
    std::array<Vec3, 2> other;
    const Triangle of_b = local(b);
    const Vec3 normal = cross(of_b[1] - of_b[0], of_b[2] - of_b[0]);
    other = {cross(normal, along), cross(along, normal)};
    for (std::size_t e = 0; e < 3; ++e) {
      if (!is_on_line(near, {of_b[e], of_b[(e + 1) % 3]})) continue;
      const Edge edge_b = edge_of(b, e);
      const auto sheet_b = sheet_at(edge_b);
      if (!sheet_b || edge_b == edge) return false;
      other = {apex((*sheet_b)[0], edge_b) - middle, apex((*sheet_b)[1], edge_b) - middle};
      return alternate(along, own, other);
    }
    const double length = norm(other[0]);
    if (!(length > 0)) return false;
    for (Vec3& ray : other) ray = (reach(slab, middle, (1 / length) * ray) / length) * ray;
    return alternate(along, own, other);
  }

  /// The distance from a point of a triangle to its border, in a direction.
  static double reach(const Slab& slab, const Vec3& from, const Vec3& direction) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < slab.size; ++i) {
      const double speed = dot(slab.sides[i].normal, direction);
      if (speed > 0) least = std::min(least, (slab.sides[i].offset - dot(slab.sides[i].normal, from)) / speed);
    }
    return std::isfinite(least) ? std::max(0.0, least) : 0;
  }

  /// Whether the ends of a segment are on the line through an edge, within the tolerance.
  [[nodiscard]] bool is_on_line(const Stretch& near, const Stretch& edge) const {
    const Vec3 step = edge.to - edge.from;
    const double length = norm(step);
    const auto is_on = [&](const Vec3& p) { return norm(cross(step, p - edge.from)) <= 2 * tolerance_ * length; };
    return length > 0 && is_on(near.from) && is_on(near.to);
  }

  [[nodiscard]] bool alternate(const Vec3& along, const std::array<Vec3, 2>& own,
                               const std::array<Vec3, 2>& other) const {
    const Vec3 axis = (1 / norm(along)) * along;
    const auto across = [&](const Vec3& ray) { return ray - dot(axis, ray) * axis; };
    for (const auto& rays : {own, other})
      for (const Vec3& ray : rays)
        if (norm(across(ray)) <= kFarther * tolerance_) return false;
    const Vec3 first = across(own[0]);
    const Vec3 u = (1 / norm(first)) * first, v = cross(axis, u);
    const auto angle = [&](const Vec3& ray) {
      const double at = std::atan2(dot(v, ray), dot(u, ray));
      return at < 0 ? at + 2 * std::numbers::pi : at;
    };
    const double split = angle(own[1]);
    std::array<bool, 2> is_before{};
    for (std::size_t i = 0; i < 2; ++i) {
      for (const Vec3& ray : own)
        if (are_near(across(ray), across(other[i]))) return false;
      is_before[i] = angle(other[i]) < split;
    }
    return is_before[0] != is_before[1];
  }
  /// Whether the shorter of two rays from a point ends near the other.
  [[nodiscard]] bool are_near(const Vec3& p, const Vec3& q) const {
    if (dot(p, q) <= 0) return false;
    return norm(cross(p, q)) <= kFarther * tolerance_ * std::max(norm(p), norm(q));
  }

  const solid::Body& body_;
  const solid::Topology& topology_;
  LocalFrame frame_;
  double tolerance_;  ///< in local units
  bool is_told_;
};

}  // namespace

std::vector<TrianglePair> self_edge_crossings(const solid::Body& body, const solid::Topology& topology,
                                              double tolerance, const std::stop_token& stop) {
  SelfEdgeCrossings search(body, topology, tolerance);
  std::vector<TrianglePair> found;
  if (!search.is_told()) return found;
  const auto take = [&](const TrianglePair& pair) {
    if (pair.a < pair.b && search.is_one(pair.a, pair.b)) found.push_back(pair);
    return true;
  };
  measure::candidate_pairs(body.placed, body.placed, search.reach(), take, stop);
  std::sort(found.begin(), found.end(),
            [](const auto& x, const auto& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
  return found;
}

}  // namespace impinge::clash
