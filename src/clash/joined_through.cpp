// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <tuple>

#include "clash/grouping.hpp"
#include "exact/segment.hpp"

/// The surface of a body is cut into patches by the lines of contact. Where a patch lies inside the other body, its rim
/// is one region. What holds a patch together is found on its edges: pieces of edges between two points of contact join
/// these; pieces that end at a vertex join a point of contact and the vertex; whole edges join their vertices.
namespace impinge::clash {
namespace {

/// A point of contact on an edge of the body.
struct OnEdge {
  std::uint64_t edge;  ///< its two positions, the lower one first
  double along;        ///< grows from the first to the second
  std::uint32_t contact;
  Vec3 point;
};

std::uint64_t edge_key(std::uint32_t p, std::uint32_t q) {
  return std::uint64_t{std::min(p, q)} << 32 | std::max(p, q);
}

class Surface {
 public:
  Surface(const Side& side, std::span<const exact::Contact> contacts, DisjointSets& groups)
      : side_(side), contacts_(contacts), groups_(groups), vertex_(side.positions), patches_(side.positions) {
    for (std::size_t i = 0; i < side.position.size(); ++i) vertex_[side.position[i]] = side.body.world[i];
  }

  void put_points(bool first, const SharedParts& parts) {
    for (std::uint32_t i = 0; i < contacts_.size(); ++i) {
      const auto corners = side_.corners(first ? contacts_[i].a : contacts_[i].b);
      for (const Corner& corner : parts[i])
        for (int e = 0; e < 3; ++e)
          if ((corner.edges >> (first ? e : 3 + e) & 1) != 0) put(corners[e], corners[(e + 1) % 3], corner.point, i);
    }
    std::sort(points_.begin(), points_.end(), [](const OnEdge& x, const OnEdge& y) {
      return std::tie(x.edge, x.along, x.contact) < std::tie(y.edge, y.along, y.contact);
    });
  }

  /// Vertices that no point of contact parts are on one side of the other body. Of a triangle without area it is not
  /// known which points of contact are on its edges.
  void join_vertices() {
    for (std::uint32_t t = 0; t < side_.body.size(); ++t) {
      const auto corners = side_.corners(t);
      const Triangle triangle = side_.body.triangle(t);
      if (exact::find_projection(triangle[0], triangle[1], triangle[2]) < 0) continue;
      for (int e = 0; e < 3; ++e) {
        const std::uint32_t p = corners[e], q = corners[(e + 1) % 3];
        if (patches_.find(p) != patches_.find(q) && !has_points(edge_key(p, q))) patches_.join(p, q);
      }
    }
  }

  /// Asks whether a point is inside only where the answer joins two groups.
  void join_along_edges(const std::function<bool(const Vec3&)>& inside) {
    for (std::size_t begin = 0, end = 0; begin < points_.size(); begin = end) {
      for (end = begin; end < points_.size() && points_[end].edge == points_[begin].edge; ++end) {
        if (end == begin || points_[end].along == points_[end - 1].along) continue;
        const OnEdge &x = points_[end - 1], &y = points_[end];
        if (groups_.find(x.contact) != groups_.find(y.contact) && inside(middle(x.point, y.point)))
          groups_.join(x.contact, y.contact);
      }
      reach(points_[begin], static_cast<std::uint32_t>(points_[begin].edge >> 32));
      reach(points_[end - 1], static_cast<std::uint32_t>(points_[begin].edge));
    }
    join_rims(inside);
  }

 private:
  static Vec3 middle(const Vec3& p, const Vec3& q) { return 0.5 * p + 0.5 * q; }

  /// Points are rounded once, and rounding keeps the order: a coordinate in which the edge is not constant orders them.
  void put(std::uint32_t p, std::uint32_t q, const Vec3& point, std::uint32_t contact) {
    if (p == q) return;
    const Vec3 step = vertex_[std::max(p, q)] - vertex_[std::min(p, q)], size = abs(step);
    const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
    const double along = component(point, axis);
    points_.push_back({edge_key(p, q), component(step, axis) < 0 ? -along : along, contact, point});
  }
  [[nodiscard]] bool has_points(std::uint64_t edge) const {
    const auto at = std::lower_bound(points_.begin(), points_.end(), edge,
                                     [](const OnEdge& point, std::uint64_t key) { return point.edge < key; });
    return at != points_.end() && at->edge == edge;
  }
  /// Nothing lies between a point of contact and the vertex. A vertex that is itself in contact is in no patch.
  void reach(const OnEdge& point, std::uint32_t vertex) {
    if (point.point != vertex_[vertex]) rims_.emplace_back(patches_.find(vertex), point.contact);
  }
  void join_rims(const std::function<bool(const Vec3&)>& inside) {
    std::sort(rims_.begin(), rims_.end());
    for (std::size_t begin = 0, end = 0; begin < rims_.size(); begin = end) {
      bool several = false;
      for (end = begin; end < rims_.size() && rims_[end].first == rims_[begin].first; ++end)
        several |= groups_.find(rims_[end].second) != groups_.find(rims_[begin].second);
      if (!several || !inside(vertex_[rims_[begin].first])) continue;
      for (std::size_t i = begin + 1; i < end; ++i) groups_.join(rims_[i].second, rims_[begin].second);
    }
  }

  const Side& side_;
  std::span<const exact::Contact> contacts_;
  DisjointSets& groups_;
  std::vector<Vec3> vertex_;  ///< per position
  DisjointSets patches_;      ///< of positions
  std::vector<OnEdge> points_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rims_;  ///< a patch and a contact that it reaches
};

}  // namespace

void join_through(const Side& side, const Side& other, bool first, std::span<const exact::Contact> contacts,
                  const SharedParts& parts, DisjointSets& groups) {
  if (!other.holds) return;
  Surface surface(side, contacts, groups);
  surface.put_points(first, parts);
  surface.join_vertices();
  surface.join_along_edges(other.holds);
}

}  // namespace impinge::clash
