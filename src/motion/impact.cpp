// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/impact.hpp"

#include <algorithm>
#include <vector>

#include "core/number.hpp"
#include "exact/integers.hpp"
#include "motion/filter.hpp"
#include "motion/root.hpp"
#include "motion/rounded_roots.hpp"

namespace impinge::motion {

namespace {

using Vector = std::array<Polynomial, 3>;

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Polynomial dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Integers: each axis times a power of two of its own, which leaves all signs as they are.
std::array<Vector, 4> integer_paths(const FourPoints& from, const FourPoints& to) {
  std::array<Vector, 4> paths;
  for (int axis = 0; axis < 3; ++axis) {
    int unit = 1024;
    for (const FourPoints* points : {&from, &to})
      for (const Vec3& p : *points)
        if (const double x = component(p, axis); x != 0) unit = std::min(unit, lowest_bit(x));
    for (int i = 0; i < 4; ++i)
      paths[i][axis] = linear(integer(component(from[i], axis), unit), integer(component(to[i], axis), unit));
  }
  return paths;
}

/// Component `axis` of a cross product.
Polynomial minor(const Vector& a, const Vector& b, std::size_t axis) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  return a[i] * b[j] - a[j] * b[i];
}

constexpr Spanning kFace{{{1, 2}, {1, 3}, {1, 0}}}, kEdges{{{0, 1}, {2, 3}, {0, 2}}};

/// The determinant of three differences that move linearly. Where coordinates have 60 bits, as most have, differences
/// have 61 and their minors 123.
Polynomial volume_of(const FourPoints& from, const FourPoints& to, const Spanning& spanning) {
  std::array<Vec3, 8> points;
  std::ranges::copy(from, points.begin());
  std::ranges::copy(to, points.begin() + 4);
  std::array<exact::IntVec, 8> integers;
  if (!exact::to_integers(points, integers.data())) {
    const auto paths = integer_paths(from, to);
    const auto difference = [&](std::size_t i) { return paths[spanning[i][1]] - paths[spanning[i][0]]; };
    return dot(cross(difference(0), difference(1)), difference(2));
  }
  const auto difference = [&](std::size_t i, std::size_t end) {
    return integers[spanning[i][1] + 4 * end] - integers[spanning[i][0] + 4 * end];
  };
  Polynomial volume;
  volume.degree = 3;
  for (std::size_t u = 0; u < 2; ++u)
    for (std::size_t v = 0; v < 2; ++v) {
      const exact::IntNormal normal = exact::cross(difference(0, u), difference(1, v));
      const Integer x(normal.x), y(normal.y), z(normal.z);
      for (std::size_t w = 0; w < 2; ++w) {
        const exact::IntVec d = difference(2, w);
        volume.coefficients[u + v + w] += x * d.x + y * d.y + z * d.z;
      }
    }
  return volume;
}

/// Whether a point is on a segment, which is so while it is in line with the ends and not beyond them on any axis; by
/// the ends as seen from the point.
bool on_segment(const Vector& a, const Vector& b, Root& root) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (root.sign(minor(a, b, axis)) != 0 || root.sign(a[axis]) * root.sign(b[axis]) > 0) return false;
  return true;
}

using Deciding = std::vector<Polynomial>;
void add_minors(const Vector& a, const Vector& b, Deciding& deciding) {
  for (std::size_t axis = 0; axis < 3; ++axis) deciding.push_back(minor(a, b, axis));
}

struct VertexAndFace {
  std::array<Vector, 3> corners;  ///< as seen from the vertex

  explicit VertexAndFace(const std::array<Vector, 4>& p) : corners{p[1] - p[0], p[2] - p[0], p[3] - p[0]} {}

  /// While they are coplanar: by the areas that the vertex spans with the edges, which add up to the face's. Along an
  /// axis on which that is not zero none may have the other sign.
  [[nodiscard]] bool meet(Root& root) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<Polynomial, 3> areas;
      for (std::size_t i = 0; i < 3; ++i) areas[i] = minor(corners[i], corners[(i + 1) % 3], axis);
      const int whole = root.sign(areas[0] + areas[1] + areas[2]);
      if (whole == 0) continue;
      return std::ranges::all_of(areas, [&](const Polynomial& area) { return root.sign(area) * whole >= 0; });
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (on_segment(corners[i], corners[(i + 1) % 3], root)) return true;
    return false;
  }
  /// All whose signs `meet` asks for.
  [[nodiscard]] Deciding deciding() const {
    Deciding all;
    for (std::size_t i = 0; i < 3; ++i) add_minors(corners[i], corners[(i + 1) % 3], all);
    for (std::size_t axis = 0; axis < 3; ++axis) all.push_back(all[axis] + all[3 + axis] + all[6 + axis]);
    for (const Vector& corner : corners) all.insert(all.end(), corner.begin(), corner.end());
    return all;
  }
};

struct TwoEdges {
  std::array<Vector, 2> ways;                 ///< of the edges, from end to end
  std::array<std::array<Vector, 2>, 2> gaps;  ///< from each end of the first to each of the second

  explicit TwoEdges(const std::array<Vector, 4>& p)
      : ways{p[1] - p[0], p[3] - p[2]}, gaps{{{p[2] - p[0], p[3] - p[0]}, {p[2] - p[1], p[3] - p[1]}}} {}

  /// While they are coplanar: along an axis on which they are not parallel, the ends of each must not be on one side of
  /// the other. Where they are parallel, or one is a point, an end must be on the other edge.
  [[nodiscard]] bool meet(Root& root) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (root.sign(minor(ways[0], ways[1], axis)) == 0) continue;
      const auto side = [&](int edge, int i, int j) { return root.sign(minor(ways[edge], gaps[i][j], axis)); };
      return side(0, 0, 0) * side(0, 0, 1) <= 0 && side(1, 0, 0) * side(1, 1, 0) <= 0;
    }
    for (int i = 0; i < 2; ++i)
      if (on_segment(gaps[0][i], gaps[1][i], root) || on_segment(gaps[i][0], gaps[i][1], root)) return true;
    return false;
  }
  [[nodiscard]] Deciding deciding() const {
    Deciding all;
    add_minors(ways[0], ways[1], all);
    for (int i = 0; i < 2; ++i) {
      add_minors(ways[0], gaps[0][i], all);
      add_minors(ways[1], gaps[i][0], all);
      add_minors(gaps[0][i], gaps[1][i], all);
      add_minors(gaps[i][0], gaps[i][1], all);
      for (const Vector& gap : gaps[i]) all.insert(all.end(), gap.begin(), gap.end());
    }
    return all;
  }
};

bool sooner(const Interval& x, const std::optional<Interval>& y) {
  return !y || x.lo < y->lo || (x.lo == y->lo && x.hi < y->hi);
}

/// `certain(time)`: 1, -1 or 0, as floating point says whether they meet at a time within the interval at which they
/// are coplanar.
template <class Features, class Certain>
std::optional<Interval> first_impact(const FourPoints& from, const FourPoints& to, const Spanning& spanning,
                                     const Certain& certain) {
  std::optional<Features> features;
  const auto meet = [&](Root& root) {
    if (!features) features.emplace(integer_paths(from, to));
    return features->meet(root);
  };
  if (const auto rounded = rounded_roots(from, to, spanning)) {
    std::optional<Polynomial> volume;
    for (std::size_t i = 0; i < rounded->count; ++i) {
      const Interval& time = rounded->times[i];
      int verdict = certain(time);
      if (verdict == 0) {
        if (!volume) volume = volume_of(from, to, spanning);
        Root root = Root::only_one(*volume, time);
        verdict = meet(root) ? 1 : -1;
      }
      if (verdict > 0) return time;
    }
    return std::nullopt;
  }
  const Polynomial volume = volume_of(from, to, spanning);
  Deciding deciding{volume};
  if (volume.is_zero()) {
    // Coplanar throughout. Between two neighbouring roots of all that decides no sign changes, nor does the answer; and
    // the times at which they meet are a closed set, so that its first is 0 or such a root.
    Root start = Root::at(1, 0);
    if (meet(start)) return Interval{0, 0};
    deciding = features->deciding();
  }
  std::optional<Interval> first;
  for (const Polynomial& p : deciding) {
    if (p.is_zero()) continue;
    for (Root& root : roots(p)) {
      const Interval time = root.bounds();
      if (!sooner(time, first)) continue;
      const int verdict = certain(time);
      if (verdict == 0) root.narrow(time);
      if (verdict > 0 || (verdict == 0 && meet(root))) first = time;
    }
  }
  return first;
}

/// Whether on some axis one side stays below the other: the gap between hulls that move linearly is a concave function
/// of time, so that it is positive throughout if it is at both ends.
template <int kFirst>
bool stay_apart(const FourPoints& from, const FourPoints& to) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto gaps = [&](const FourPoints& p) {
      std::array<double, 4> x;
      for (int i = 0; i < 4; ++i) x[i] = component(p[i], axis);
      const auto [low_a, high_a] = std::minmax_element(x.begin(), x.begin() + kFirst);
      const auto [low_b, high_b] = std::minmax_element(x.begin() + kFirst, x.end());
      return std::array{*low_b > *high_a, *low_a > *high_b};
    };
    const auto start = gaps(from), end = gaps(to);
    if ((start[0] && end[0]) || (start[1] && end[1])) return true;
  }
  return false;
}

}  // namespace

std::optional<Interval> vertex_face_impact(const FourPoints& from, const FourPoints& to) {
  if (stay_apart<1>(from, to) || vertex_avoids_face(from, to)) return std::nullopt;
  return first_impact<VertexAndFace>(from, to, kFace,
                                     [&](const Interval& time) { return vertex_in_face(from, to, time); });
}

std::optional<Interval> edge_edge_impact(const FourPoints& from, const FourPoints& to) {
  if (stay_apart<2>(from, to) || edges_avoid(from, to)) return std::nullopt;
  return first_impact<TwoEdges>(from, to, kEdges, [&](const Interval& time) { return edges_cross(from, to, time); });
}

}  // namespace impinge::motion
