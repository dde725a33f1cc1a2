// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/shared_part.hpp"

#include "clash/regions/rounded_point.hpp"
#include "exact/segment.hpp"

namespace impinge::clash {
namespace {

/// A proper triangle, or the segment or point that a degenerate one is.
struct Shape {
  Triangle corner;
  int corners = 3;

  explicit Shape(const Triangle& t) : corner(t) {
    if (exact::is_proper(t)) return;
    const Segment ends = exact::extremes(t);
    corner = {ends[0], ends[1], ends[1]};
    corners = ends[0] == ends[1] ? 1 : 2;
  }
  [[nodiscard]] bool proper() const { return corners == 3; }
  [[nodiscard]] int edges() const { return std::array{0, 0, 1, 3}[static_cast<std::size_t>(corners)]; }
  [[nodiscard]] Segment edge(int i) const { return {corner[i], corner[(i + 1) % 3]}; }
  [[nodiscard]] bool holds(const Vec3& p) const {
    return proper() ? exact::intersects(Segment{p, p}, corner) : exact::intersects(p, Segment{corner[0], corner[1]});
  }
};

/// On which sides of a plane the corners of a shape lie.
using Sides = std::array<int, 3>;

/// Whether the interior of an edge passes through the interior of a triangle, if its ends are on either side of the
/// plane.
bool pierces(const Segment& edge, const Triangle& t) {
  const int first = exact::orient3d(edge[0], edge[1], t[0], t[1]);
  return first != 0 && first == exact::orient3d(edge[0], edge[1], t[1], t[2]) &&
         first == exact::orient3d(edge[0], edge[1], t[2], t[0]);
}

/// A projection in which the two edges' interiors cross in one point, as they do in space; -1 if they do not.
int crossing_projection(const Segment& e, const Segment& f) {
  if (exact::orient3d(e[0], e[1], f[0], f[1]) != 0) return -1;
  int found = exact::find_projection(e[0], e[1], f[0]);
  if (found < 0) found = exact::find_projection(e[0], e[1], f[1]);
  if (found < 0) return -1;  // on one line
  const exact::Projection& p = exact::kProjections[found];
  const auto strictly_between = [&](const Segment& ends, const Segment& line) {
    return exact::orient2d(p, line[0], line[1], ends[0]) * exact::orient2d(p, line[0], line[1], ends[1]) < 0;
  };
  return strictly_between(f, e) && strictly_between(e, f) ? found : -1;
}

/// The corners of what two convex shapes share are the points in which the interiors of a face of either meet and do
/// nothing else: a corner and whatever holds it, an edge and a triangle that it pierces, two edges that cross. (Were
/// such a point inside a segment of the common part, that segment would lie in both faces.)
class Sharing {
 public:
  Sharing(const Triangle& a, const Triangle& b) : shape_{Shape(a), Shape(b)} {
    for (const int s : {0, 1})
      if (shape_[1 - s].proper()) learn_sides(s);
  }
  SharedPart found() {
    if (is_apart(0) || is_apart(1)) return {};
    for (const int s : {0, 1}) corners_held(s);
    for (const int s : {0, 1}) edges_through(s);
    edges_across();
    return in_order();
  }

 private:
  void learn_sides(int s) {
    const Triangle& plane = shape_[1 - s].corner;
    for (int i = 0; i < 3; ++i) side_[s][i] = exact::orient3d(plane[0], plane[1], plane[2], shape_[s].corner[i]);
  }
  /// Whether all of a shape is on one side of the other's plane.
  [[nodiscard]] bool is_apart(int s) const {
    const Sides& side = side_[s];
    return side[0] != 0 && side[0] == side[1] && side[0] == side[2];
  }
  void corners_held(int s) {
    const Shape &shape = shape_[s], &other = shape_[1 - s];
    for (int i = 0; i < shape.corners; ++i) {
      const Vec3& corner = shape.corner[i];
      if (side_[s][i] != 0) continue;
      if (s == 1 && std::find(other.corner.begin(), other.corner.end(), corner) != other.corner.end()) continue;
      if (other.holds(corner)) add(corner, edges_at(s, i) | edges_holding(1 - s, corner));
    }
  }
  void edges_through(int s) {
    const Shape &shape = shape_[s], &other = shape_[1 - s];
    if (!other.proper()) return;
    for (int i = 0; i < shape.edges(); ++i) {
      if (side_[s][i] * side_[s][(i + 1) % 3] >= 0 || !pierces(shape.edge(i), other.corner)) continue;
      add(where_through(shape.edge(i), other.corner), bit(s, i));
    }
  }
  void edges_across() {
    for (int i = 0; i < shape_[0].edges(); ++i)
      for (int j = 0; j < shape_[1].edges(); ++j) {
        const Segment e = shape_[0].edge(i), f = shape_[1].edge(j);
        const int projection = crossing_projection(e, f);
        if (projection >= 0) add(where_across(e, f, exact::kProjections[projection]), bit(0, i) | bit(1, j));
      }
  }

  [[nodiscard]] unsigned bit(int s, int edge) const { return shape_[s].proper() ? 1U << (3 * s + edge) : 0; }
  [[nodiscard]] unsigned edges_at(int s, int corner) const { return bit(s, corner) | bit(s, (corner + 2) % 3); }
  [[nodiscard]] unsigned edges_holding(int s, const Vec3& point) const {
    unsigned edges = 0;
    if (!shape_[s].proper()) return edges;
    for (int i = 0; i < 3; ++i)
      if (exact::intersects(point, shape_[s].edge(i))) edges |= bit(s, i);
    return edges;
  }
  void add(const Vec3& point, unsigned edges) {
    // Of the two zeros the positive one, so that equal points are equal bit for bit.
    part_.corners[part_.size++] = {{point.x + 0.0, point.y + 0.0, point.z + 0.0}, static_cast<std::uint8_t>(edges)};
  }

  /// Each side of the polygon is part of an edge, and no other corner lies on the line of that edge: consecutive
  /// corners are those with an edge in common.
  [[nodiscard]] SharedPart in_order() {
    for (std::size_t i = 1; i + 1 < part_.size; ++i) {
      const auto begin = part_.corners.begin() + static_cast<std::ptrdiff_t>(i),
                 end = part_.corners.begin() + part_.size;
      const unsigned edges = part_.corners[i - 1].edges;
      const auto next = std::find_if(begin, end, [&](const Corner& c) { return (c.edges & edges) != 0; });
      if (next != end) std::swap(*begin, *next);
    }
    return part_;
  }

  std::array<Shape, 2> shape_;
  std::array<Sides, 2> side_{};  ///< of the other's plane; 0 also where the other is degenerate
  SharedPart part_;
};

/// The vectors from a corner of a triangle to the two others.
using Ways = std::array<Vec3, 2>;

Ways ways_from(const Triangle& t, std::size_t corner) {
  return {t[(corner + 1) % 3] - t[corner], t[(corner + 2) % 3] - t[corner]};
}

// Each vector is off by 2^-53 of each coordinate, to which products and sums add a few roundings; an underflow is far
// below the second bound, since `d` has coordinates up to 4.
bool is_certain(double sum, double of_sizes) { return sum > 0x1p-48 * of_sizes && sum > 0x1p-900; }

bool is_ahead(const Ways& ways, const Vec3& d) {
  return is_certain(dot(ways[0], d), dot(abs(ways[0]), abs(d))) &&
         is_certain(dot(ways[1], d), dot(abs(ways[1]), abs(d)));
}

bool has_area(const Ways& ways) {
  const Vec3 sum = cross(ways[0], ways[1]), u = abs(ways[0]), v = abs(ways[1]);
  return is_certain(std::abs(sum.x), u.y * v.z + u.z * v.y) || is_certain(std::abs(sum.y), u.z * v.x + u.x * v.z) ||
         is_certain(std::abs(sum.z), u.x * v.y + u.y * v.x);
}

/// A vector roughly along the bisector: the sum of the two vectors, each scaled to a length near 1.
Vec3 middle_of(const Ways& ways) {
  const auto shortened = [](const Vec3& v) { return (1 / max_component(abs(v))) * v; };
  return shortened(ways[0]) + shortened(ways[1]);
}

}  // namespace

// Proves it by a plane through the corner that separates the two triangles.
std::optional<Corner> common_vertex(const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (a[i] != b[j]) continue;
      const Ways of_a = ways_from(a, i), of_b = ways_from(b, j);
      const Vec3 across = middle_of(of_a) - middle_of(of_b);
      if (!is_ahead(of_a, across) || !is_ahead(of_b, -1.0 * across) || !has_area(of_a) || !has_area(of_b)) return {};
      const unsigned edges = (1U << i | 1U << (i + 2) % 3) | (8U << j | 8U << (j + 2) % 3);
      return Corner{{a[i].x + 0.0, a[i].y + 0.0, a[i].z + 0.0}, static_cast<std::uint8_t>(edges)};
    }
  return {};
}

SharedPart shared_part(const Triangle& a, const Triangle& b) { return Sharing(a, b).found(); }

}  // namespace impinge::clash
