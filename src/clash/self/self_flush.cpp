// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/self/self_flush.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>

#include "clash/regions/shared_within.hpp"
#include "clash/slab.hpp"
#include "clash/wall.hpp"
#include "core/disjoint_sets.hpp"
#include "core/local_frame.hpp"
#include "measure/nearest.hpp"

namespace impinge::clash {
namespace {

/// The cosine of 11 degrees. Two planes that diverge by a tolerance over the least width of an area are at most 3.6
/// degrees apart.
constexpr double kParallel = 0.98;
constexpr double kLeastWidth = 16;  ///< of a flush area, in tolerances
constexpr double kThinWall = 8;     ///< any wall is thicker than the tolerance divided by this
constexpr double kOfWall = 256;     ///< the tolerance is at most the wall divided by this

Vec3 normal_of(const Triangle& t) {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double length = norm(normal);
  return length > 0 ? (1 / length) * normal : Vec3{0, 0, 0};
}

/// Whether a convex polygon is wider than `width` in every direction: it is narrowest at a right angle to an edge.
bool is_wider(std::span<const Vec3> polygon, const Vec3& normal, double width) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double length = norm(edge);
    if (!(length > 0)) continue;
    const Vec3 across = (1 / length) * cross(normal, edge);
    double lo = 0, hi = 0;
    for (const Vec3& corner : polygon) {
      const double at = dot(across, corner - polygon[i]);
      lo = std::min(lo, at), hi = std::max(hi, at);
    }
    if (hi - lo <= width) return false;
  }
  return polygon.size() > 2;
}

/// Whether triangle b, seen along the normal of a, overlaps a by at most a seam of that width: most neighbours do.
bool is_beside(const Triangle& a, const Vec3& normal, const Triangle& b, double seam) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 edge = a[(i + 1) % 3] - a[i], out = cross(edge, normal);
    const double most = seam * norm(edge);
    if (std::all_of(b.begin(), b.end(), [&](const Vec3& p) { return dot(out, p - a[i]) >= -most; })) return true;
  }
  return false;
}

class SelfFlush {
 public:
  SelfFlush(const solid::Body& body, const solid::Topology& topology, double tolerance)
      : body_(body), topology_(topology), setting_{local_frame(body.box, body.box), tolerance} {
    DisjointSets pieces(topology.positions);
    const auto each_proper = [&](const auto& look_at) {
      for (std::uint32_t t = 0; t < body.size(); ++t)
        if (topology.is_proper(t)) look_at(t);
    };
    each_proper([&](std::uint32_t t) {
      const auto [i, j, k] = topology.corners(body, t);
      pieces.join(i, j), pieces.join(i, k);
    });
    std::vector<AreaAndVolume> measures(topology.positions);
    AreaAndVolume whole;
    piece_.resize(body.size());
    each_proper([&](std::uint32_t t) {
      const Triangle triangle = setting_.frame.to_local(body.triangle(t));
      piece_[t] = pieces.find(topology.corners(body, t)[0]);
      measures[piece_[t]].add(triangle), whole.add(triangle);
    });
    const auto most = [&](const AreaAndVolume& m) { return m.wall() / setting_.frame.unit / kOfWall; };
    is_outward_ = whole.volume > 0;
    whole_ = most(whole);
    for (const AreaAndVolume& measure : measures) most_.push_back(most(measure));
  }

  /// How far apart the triangles of a pair may be.
  [[nodiscard]] double reach() const {
    const double most = most_.empty() ? 0 : *std::max_element(most_.begin(), most_.end());
    return std::min(setting_.tolerance, most);
  }
  [[nodiscard]] bool is_told(double tolerance) const {
    return setting_.frame.unit * tolerance >= kThinWall * kLeastTolerance * setting_.frame.scale;
  }

  [[nodiscard]] bool is_one(const TrianglePair& pair) const {
    if (!topology_.is_proper(pair.a) || !topology_.is_proper(pair.b)) return false;
    SharedWithinSetting setting = setting_;
    setting.tolerance = setting.resolution =
        std::min({setting.tolerance, most_[piece_[pair.a]], most_[piece_[pair.b]]});
    const double least_width = kLeastWidth * setting.frame.unit * setting.tolerance;
    const Triangle a = body_.triangle(pair.a), b = body_.triangle(pair.b);
    const Triangle local_a = setting.frame.to_local(a), local_b = setting.frame.to_local(b);
    const Vec3 normal = normal_of(local_a);
    // Half of the width, since flush areas are projected along another direction than the normal.
    if (is_beside(local_a, normal, local_b, least_width / 2)) return false;
    const double cosine = dot(normal, normal_of(local_b));
    if (std::abs(cosine) < kParallel || !is_told(setting.tolerance)) return false;
    const SharedWithin near = shared_if_flush(a, b, setting);
    std::array<Vec3, 6> corners;
    for (std::size_t i = 0; i < near.shared.size; ++i)
      corners[i] = setting.frame.to_local(near.shared.corners[i].point);
    const std::span<const Vec3> polygon = std::span(corners).first(near.shared.size);
    if (!is_wider(polygon, normal, least_width)) return false;
    return near.gap <= std::min(setting.tolerance, whole_) / kThinWall ||
           (cosine < 0 && is_in_front(polygon, local_a, normal));
  }

 private:
  /// Whether the polygon half-way to the other triangle is in front of triangle a, and not behind it.
  [[nodiscard]] bool is_in_front(std::span<const Vec3> polygon, const Triangle& a, const Vec3& normal) const {
    double height = 0;
    for (const Vec3& corner : polygon) height += dot(normal, corner - a[0]);
    return is_outward_ ? height > 0 : height < 0;
  }

  const solid::Body& body_;
  const solid::Topology& topology_;
  SharedWithinSetting setting_;
  bool is_outward_;  ///< normals point outward
  /// The greatest tolerance for the wall of the whole body, as between a shell and its cavity, and for that of each
  /// piece, such as a foil on a block. A piece is connected by common positions, and closed as the whole body is.
  double whole_;
  std::vector<double> most_;
  std::vector<std::uint32_t> piece_;  ///< per proper triangle
};

}  // namespace

std::optional<std::vector<TrianglePair>> self_flush(const solid::Body& body, const solid::Topology& topology,
                                                    double tolerance, const std::stop_token& stop) {
  const SelfFlush search(body, topology, tolerance);
  if (!search.is_told(search.reach())) return std::nullopt;
  std::vector<TrianglePair> found;
  const auto take = [&](const TrianglePair& pair) {
    if (pair.a < pair.b && search.is_one(pair)) found.push_back(pair);
    return true;
  };
  measure::candidate_pairs(body.placed, body.placed, search.reach(), take, stop);
  std::sort(found.begin(), found.end(),
            [](const auto& x, const auto& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
  return found;
}

}  // namespace impinge::clash
