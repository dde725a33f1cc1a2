// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "measure/triangle_distance.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/orthogonal.hpp"

namespace impinge::measure {
namespace {

/// Both triangles about a local origin and scaled, so that the largest coordinate is between 1 and 2: no product of
/// four coordinates overflows, and one that underflows is nothing beside the rounding of the differences.
struct Local {
  Triangle a, b;
  Vec3 origin;
  double unit;  ///< a power of two, or 0 where all corners are the same but for denormal differences

  [[nodiscard]] Vec3 world(const Vec3& v) const { return origin + unit * v; }
};

/// Of local coordinates, u being 2^-53. A corner's difference from the origin is rounded once: 2 u a coordinate, 3.5 u
/// in length. A point of a triangle found is a corner and at most two multiples of differences of corners, each rounded
/// (and below 4): less than 16 u a coordinate, 28 u in length; two of them, and the corners' own errors, 63 u. A slab's
/// bound is a difference of two dot products with a vector of length 1 to within 4 u: 2 (3.5 + 6 + 14) u, and 7 u.
/// 2^-46 = 128 u is taken for either; what was scaled back is rounded once more, which is counted in it.
constexpr double kMargin = 0x1p-46;
/// A slab whose gap is this part of the margin less than the distance of two points found confirms them: of the margin,
/// the errors of the gap and of the points leave more than that.
constexpr double kConfirming = 0.25;
/// Triangles that share the nearest corner are as near as each other up to rounding, and one of them is enough.
constexpr double kAllowance = 4 * kMargin;

double scale_of(double largest) {
  constexpr std::uint64_t kExponent = std::uint64_t{0x7FF} << 52;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(largest) & kExponent);
}

Local localised(const Triangle& a, const Triangle& b) {
  Local local{a, b, a[0], 0};
  Vec3 most{0, 0, 0};
  for (Triangle* const t : {&local.a, &local.b})
    for (Vec3& corner : *t) corner = corner - local.origin, most = max(most, abs(corner));
  local.unit = scale_of(max_component(most));
  if (local.unit == 0) return local;
  const double inverse = 1 / local.unit;
  for (Triangle* const t : {&local.a, &local.b})
    for (Vec3& corner : *t) corner = inverse * corner;
  return local;
}

/// Two points that may be the nearest, and the directions in which the features that they are on reach beyond them:
/// edges, two of them for a face. A zero vector stands for none.
struct Found {
  double square = std::numeric_limits<double>::infinity();
  Vec3 a{}, b{};
  Vec3 along[2]{};

  /// Whether they are nearer than what was found before.
  bool offer(const Vec3& p, const Vec3& q, const Vec3& first, const Vec3& second) {
    const Vec3 r = q - p;
    const double rr = dot(r, r);
    if (!(rr < square)) return false;
    *this = {rr, p, q, {first, second}};
    return true;
  }
};

double unit_clamped(double x) { return std::clamp(x, 0.0, 1.0); }

/// A segment from `start` along `d`; dd = d . d.
struct Edge {
  Vec3 start, d;
  double dd;
  [[nodiscard]] double parameter(const Vec3& point) const {
    return dd > 0 ? unit_clamped(dot(point - start, d) / dd) : 0;
  }
  [[nodiscard]] Vec3 at(double s) const { return start + s * d; }
  /// Its direction, where the point is no end.
  [[nodiscard]] Vec3 along(double s) const { return s > 0 && s < 1 ? d : Vec3{0, 0, 0}; }
};

using Edges = std::array<Edge, 3>;

Edges edges_of(const Triangle& t) {
  Edges edges;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 d = t[(i + 1) % 3] - t[i];
    edges[i] = {t[i], d, dot(d, d)};
  }
  return edges;
}

/// The nearest points of two lines are found by way of d x e, whose error is u |d| |e|: the parameter is then off by u
/// over the sine of the angle between them. The distance as a function of it is flat in as much as the sine is small,
/// so its square is off by no more than some u^2. Parallel segments may begin anywhere.
bool offer_edges(const Edge& p, const Edge& q, Found& found) {
  const Vec3 r = q.start - p.start;
  const Vec3 n = cross(p.d, q.d);
  const double nn = dot(n, n);
  double s = nn > 0 ? unit_clamped(dot(cross(r, q.d), n) / nn) : 0;
  double t = q.dd > 0 ? dot(s * p.d - r, q.d) / q.dd : 0;
  if (!(t >= 0 && t <= 1)) {
    t = unit_clamped(t);
    s = p.dd > 0 ? unit_clamped(dot(r + t * q.d, p.d) / p.dd) : 0;
  } else if (nn == 0) {  // parallel, or a point: the foot of what was begun with
    s = p.dd > 0 ? unit_clamped(dot(r + t * q.d, p.d) / p.dd) : s;
  }
  return found.offer(p.at(s), q.at(t), p.along(s), q.along(t));
}

/// A triangle by its longest edge and its height over it: the two are orthogonal however thin it is.
struct Face {
  Vec3 corner, base, side, height;  ///< side: from the corner to the apex
  double base_square, height_square, foot;

  explicit Face(const Edges& edges) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (edges[i].dd > edges[longest].dd) longest = i;
    corner = edges[longest].start, base = edges[longest].d, base_square = edges[longest].dd;
    side = edges[(longest + 2) % 3].start - corner;
    foot = base_square > 0 ? dot(side, base) / base_square : 0;
    height = side - foot * base;
    height_square = dot(height, height);
  }

  /// Offers the point's foot on the face; where that is not inside, an edge is nearer.
  template <class Offer>
  void offer_foot(const Vec3& point, const Offer& offer) const {
    if (!(height_square > 0)) return;
    const Vec3 r = point - corner;
    const double s = dot(r, base) / base_square;
    const double t = dot(r - s * base, height) / height_square;
    const double along_base = s - t * foot;
    if (t < 0 || along_base < 0 || along_base + t > 1) return;
    offer(corner + along_base * base + t * side, base, height);
  }
};

struct Range {
  double lo, hi;
};

Range range_along(const Vec3& n, const Triangle& t) {
  const double x = dot(n, t[0]), y = dot(n, t[1]), z = dot(n, t[2]);
  return {std::min({x, y, z}), std::max({x, y, z})};
}

/// The gap between the two along a direction: a lower bound of the distance, but for the margin.
double gap_along(const Vec3& n, const Triangle& a, const Triangle& b) {
  const double nn = dot(n, n);
  if (!(nn > 0x1p-900)) return 0;  // no direction, or one that was rounded too much
  const Range of_a = range_along(n, a), of_b = range_along(n, b);
  return std::max(of_b.lo - of_a.hi, of_a.lo - of_b.hi) / std::sqrt(nn);
}

/// If a slab with such a gap says that they are far enough apart, but for some allowance.
std::optional<TriangleDistance> apart_by(double gap, const Local& local, double enough_apart, double allowance) {
  if (!(gap > kMargin) || !(local.unit * (gap - kMargin + allowance) > enough_apart)) return std::nullopt;
  return TriangleDistance{std::numeric_limits<double>::infinity(), local.unit * kMargin, local.unit * (gap - kMargin),
                          local.world(local.a[0]), local.world(local.b[0])};
}

/// The normal of the slab between the features that the points are on.
Vec3 slab_normal(const Found& found) {
  const auto& [first, second] = found.along;
  const Vec3 none{0, 0, 0};
  if (first != none && second != none) return cross(first, second);
  return orthogonal_to(first, orthogonal_to(second, found.b - found.a));
}

/// From one of its points to the corner of a triangle that lies farthest against a direction.
Vec3 to_farthest_against(const Vec3& n, const Triangle& t, const Vec3& point) {
  Vec3 farthest = t[0];
  for (const Vec3& corner : t)
    if (dot(n, corner) < dot(n, farthest)) farthest = corner;
  return farthest - point;
}

/// Several features may be nearest up to rounding, and the slab between the two that were found may then cut off
/// corners of the triangles: such corners turn it until they are on its border.
double turned_gap(const Local& local, const Found& found, double enough) {
  const Vec3 r = found.b - found.a;
  Vec3 n = r, first{0, 0, 0};
  double gap = 0;
  for (int turn = 0; turn < 2; ++turn) {
    const Vec3 in_a = to_farthest_against(-1.0 * n, local.a, found.a), in_b = to_farthest_against(n, local.b, found.b);
    const Vec3 out = orthogonal_to(first, dot(n, in_a) > -dot(n, in_b) ? in_a : in_b);
    n = orthogonal_to(out, orthogonal_to(first, r));
    n = orthogonal_to(first, n);
    gap = std::max(gap, gap_along(n, local.a, local.b));
    if (gap >= enough) break;
    first = out;
  }
  return gap;
}

TriangleDistance finished(const Local& local, const Found& found) {
  const double value = std::sqrt(found.square);
  double gap = std::max(0.0, gap_along(found.b - found.a, local.a, local.b));
  const double enough = value - kConfirming * kMargin;
  if (gap < enough) gap = std::max(gap, gap_along(slab_normal(found), local.a, local.b));
  if (gap < enough) gap = std::max(gap, turned_gap(local, found, enough));
  return {local.unit * value, local.unit * kMargin, local.unit * std::max(0.0, gap - kMargin), local.world(found.a),
          local.world(found.b)};
}

/// Of corners that are the same but for differences below 2^-1022, which were not scaled: no two points are farther
/// apart than twice the greatest.
TriangleDistance same_point(const Local& local) {
  double most = 0;
  for (const Triangle* const t : {&local.a, &local.b})
    for (const Vec3& corner : *t) most = std::max(most, max_component(abs(corner)));
  return {0, 4 * most, 0, local.origin, local.origin};
}

/// Squared distance below which two points give no direction for a slab; the bound matters little then.
constexpr double kClose = 0x1p-60;

/// The nearest of all features, which are the triangles' nearest points unless they cross.
TriangleDistance nearest_features(const Local& local, const Edges& a, const Edges& b) {
  Found found;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (!offer_edges(a[i], b[j], found)) continue;
      // Nearest points of two edges are those of the triangles if both third corners are out of the slab between them
      // (Larsen et al., 1999). Where the points are near and a triangle is thin, the signs are those of rounding
      // errors, so a slab has to confirm them.
      const Vec3 r = found.b - found.a;
      const Vec3 &third_a = local.a[(i + 2) % 3], &third_b = local.b[(j + 2) % 3];
      if (dot(r, third_a - found.a) > 0 || dot(r, third_b - found.b) < 0 || found.square <= kClose) continue;
      const TriangleDistance d = finished(local, found);
      if (d.lower >= d.distance - (1 + kConfirming) * d.margin) return d;
    }
  }
  const Face face_a(a), face_b(b);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &p = local.a[i], &q = local.b[i];
    face_b.offer_foot(p, [&](const Vec3& foot, const Vec3& d, const Vec3& e) { found.offer(p, foot, d, e); });
    face_a.offer_foot(q, [&](const Vec3& foot, const Vec3& d, const Vec3& e) { found.offer(foot, q, d, e); });
  }
  return finished(local, found);
}

}  // namespace

TriangleDistance triangle_distance(const Triangle& a, const Triangle& b, double enough_apart, const Vec3& guess) {
  const Local local = localised(a, b);
  if (local.unit == 0) return same_point(local);
  if (const auto far = apart_by(gap_along(guess, local.a, local.b), local, enough_apart, kAllowance)) return *far;
  // Most triangles are far apart beside their size, and a slab across the line between them says so.
  const Vec3 across = (local.b[0] + local.b[1] + local.b[2]) - (local.a[0] + local.a[1] + local.a[2]);
  if (const auto far = apart_by(gap_along(across, local.a, local.b), local, enough_apart, 0)) return *far;
  const Edges edges_a = edges_of(local.a), edges_b = edges_of(local.b);
  for (const bool is_a : {true, false}) {
    const Triangle &face = is_a ? local.a : local.b, &other = is_a ? local.b : local.a;
    const Edges& edges = is_a ? edges_a : edges_b;
    const Vec3 n = cross(edges[0].d, edges[1].d);
    const double gap = gap_along(n, face, other);
    if (const auto far = apart_by(gap, local, enough_apart, 0)) return *far;
    if (!(gap > kMargin)) continue;
    // The other's corner nearest to the plane is the nearest of all where it is over the face.
    const auto height = [&](const Vec3& corner) { return std::abs(dot(n, corner - face[0])); };
    const Vec3& corner =
        *std::min_element(other.begin(), other.end(), [&](auto& p, auto& q) { return height(p) < height(q); });
    Found found;
    Face(edges).offer_foot(corner, [&](const Vec3& foot, const Vec3& d, const Vec3& e) {
      is_a ? found.offer(foot, corner, d, e) : found.offer(corner, foot, d, e);
    });
    const double value = std::sqrt(found.square);
    if (gap >= value - kConfirming * kMargin)
      return {local.unit * value, local.unit * kMargin, local.unit * (gap - kMargin), local.world(found.a),
              local.world(found.b)};
  }
  return nearest_features(local, edges_a, edges_b);
}

TriangleDistance point_distance(const Vec3& point, const Triangle& triangle, double enough_apart) {
  const Local local = localised({point, point, point}, triangle);
  if (local.unit == 0) return same_point(local);
  const Vec3 across = local.b[0] + local.b[1] + local.b[2];
  if (const auto far = apart_by(gap_along(across, local.a, local.b), local, enough_apart, 0)) return *far;
  Found found;
  const Edges edges = edges_of(local.b);
  const Vec3 none{0, 0, 0}, &p = local.a[0];
  for (const Edge& edge : edges) {
    const double s = edge.parameter(p);
    found.offer(p, edge.at(s), edge.along(s), none);
  }
  Face(edges).offer_foot(p, [&](const Vec3& foot, const Vec3& d, const Vec3& e) { found.offer(p, foot, d, e); });
  return finished(local, found);
}

std::array<Vec3, 2> common_point(const Triangle& a, const Triangle& b) {
  const Local local = localised(a, b);
  if (local.unit == 0) return {a[0], b[0]};
  const Edges edges_a = edges_of(local.a), edges_b = edges_of(local.b);
  Found found;
  // Where an edge pierces the other triangle's plane.
  const auto offer_piercing = [&](const Edges& edges, const Edges& plane, bool edges_are_a) {
    const Vec3 n = cross(plane[0].d, plane[1].d);
    for (std::size_t i = 0; i < 3; ++i) {
      const double h = dot(n, edges[i].start - plane[0].start), k = dot(n, edges[(i + 1) % 3].start - plane[0].start);
      if (!(h * k < 0)) continue;
      const Vec3 p = edges[i].at(h / (h - k));
      Face(plane).offer_foot(p, [&](const Vec3& foot, const Vec3& d, const Vec3& e) {
        edges_are_a ? found.offer(p, foot, d, e) : found.offer(foot, p, d, e);
      });
    }
  };
  offer_piercing(edges_a, edges_b, true);
  offer_piercing(edges_b, edges_a, false);
  if (!(found.square < 0x1p-100))
    if (const TriangleDistance d = nearest_features(local, edges_a, edges_b);
        d.distance < local.unit * std::sqrt(found.square))
      return {d.a, d.b};
  return {local.world(found.a), local.world(found.b)};
}

}  // namespace impinge::measure
