// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <tuple>

#include "clash/regions/connected_patches.hpp"
#include "clash/regions/grouping.hpp"
#include "core/stopped.hpp"

/// The lines of contact cut the surface of a part into patches. Where a patch lies inside the other part, all contacts
/// on its rim are one region. Edges of the mesh connect a patch: a piece of an edge between two points of contact
/// connects these, a piece that ends at a vertex connects a point of contact and the vertex, and a whole edge connects
/// its vertices. Contacts in the interior of a triangle, which reach none of its edges, are connected by lines of sight
/// (regions/connected_patches.hpp).
namespace impinge::clash {
namespace {

/// A point of contact on an edge of the part.
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
  Surface(const solid::Part& part, bool first, std::span<const exact::Contact> contacts, const SharedParts& parts,
          DisjointSets& groups, const std::stop_token& stop)
      : part_(part),
        shift_(first ? 0 : 3),
        parts_(parts),
        groups_(groups),
        stop_(stop),
        vertex_(part.topology.positions),
        patches_(part.topology.positions) {
    for (std::uint32_t i = 0; i < contacts.size(); ++i) touched_.emplace_back(first ? contacts[i].a : contacts[i].b, i);
    std::sort(touched_.begin(), touched_.end(), until_stopped(stop, std::less<>()));
    for (std::size_t i = 0; i < part.body.world.size(); ++i) vertex_[part.topology.position[i]] = part.body.world[i];
  }

  void put_points() {
    for (const auto& [triangle, contact] : touched_) {
      const auto corners = part_.corners(triangle);
      for (const Corner& corner : parts_[contact])
        for (int e = 0; e < 3; ++e)
          if ((edges_of(corner) >> e & 1) != 0) put(corners[e], corners[(e + 1) % 3], corner.point, contact);
    }
    const auto before = [](const OnEdge& x, const OnEdge& y) {
      return std::tie(x.edge, x.along, x.contact) < std::tie(y.edge, y.along, y.contact);
    };
    std::sort(points_.begin(), points_.end(), until_stopped(stop_, before));
  }

  /// Joins the vertices of each edge without a point of contact: both are on one side of the other part. Degenerate
  /// triangles are left out, since the points of contact on their edges are not known.
  void join_vertices() {
    for (std::uint32_t t = 0; t < part_.body.size(); ++t) {
      const auto corners = part_.corners(t);
      if (!part_.topology.is_proper(t)) continue;
      for (int e = 0; e < 3; ++e) {
        const std::uint32_t p = corners[e], q = corners[(e + 1) % 3];
        if (patches_.find(p) != patches_.find(q) && !has_points(edge_key(p, q))) patches_.join(p, q);
      }
    }
  }

  /// Joins neighbouring points of contact on an edge if the edge is inside between them. That is asked only where it
  /// joins two groups.
  void join_along_edges(const IsInside& inside) {
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
  }

  void join_patches(const IsInside& inside) {
    std::vector<Mark> marks;
    for (std::size_t begin = 0, end = 0; begin < touched_.size(); begin = end) {
      const std::uint32_t triangle = touched_[begin].first;
      marks.clear();
      for (end = begin; end < touched_.size() && touched_[end].first == triangle; ++end)
        mark(touched_[end].second, marks);
      if (!part_.topology.is_proper(triangle) ||
          std::all_of(marks.begin(), marks.end(), [](const Mark& m) { return m.on_border; }))
        continue;
      for (const Sight& sight : sights(part_.body.triangle(triangle), marks))
        if (!is_joined(sight) && inside(middle(sight.from, sight.to))) join(sight, part_.corners(triangle));
    }
  }

  void join_rims(const IsInside& inside) {
    std::sort(rims_.begin(), rims_.end());
    for (std::size_t begin = 0, end = 0; begin < rims_.size(); begin = end) {
      bool several = false;
      for (end = begin; end < rims_.size() && rims_[end].first == rims_[begin].first; ++end)
        several |= groups_.find(rims_[end].second) != groups_.find(rims_[begin].second);
      if (!several || !inside(vertex_[rims_[begin].first])) continue;
      for (std::size_t i = begin + 1; i < end; ++i) groups_.join(rims_[i].second, rims_[begin].second);
    }
  }

 private:
  static Vec3 middle(const Vec3& p, const Vec3& q) { return 0.5 * p + 0.5 * q; }

  /// Orders points along an edge by the coordinate in which the edge is longest: points are rounded once, which keeps
  /// their order.
  [[nodiscard]] double along(std::uint32_t p, std::uint32_t q, const Vec3& point) const {
    const Vec3 step = vertex_[std::max(p, q)] - vertex_[std::min(p, q)], size = abs(step);
    const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
    return component(step, axis) < 0 ? -component(point, axis) : component(point, axis);
  }
  void put(std::uint32_t p, std::uint32_t q, const Vec3& point, std::uint32_t contact) {
    if (p == q) return;
    points_.push_back({edge_key(p, q), along(p, q, point), contact, point});
  }
  [[nodiscard]] bool has_points(std::uint64_t edge) const {
    const auto at = std::lower_bound(points_.begin(), points_.end(), edge,
                                     [](const OnEdge& point, std::uint64_t key) { return point.edge < key; });
    return at != points_.end() && at->edge == edge;
  }
  /// Adds a point of contact to the rim of the patch of a vertex, if no other point lies between them. A vertex that is
  /// itself in contact is in no patch.
  void reach(const OnEdge& point, std::uint32_t vertex) {
    if (point.point != vertex_[vertex]) rims_.emplace_back(patches_.find(vertex), point.contact);
  }
  /// Adds the sides of the polygon, segment or point that a pair shares.
  void mark(std::uint32_t contact, std::vector<Mark>& marks) const {
    const std::span<const Corner> corners = parts_[contact];
    const std::size_t sides = corners.size() > 2 ? corners.size() : 1;
    for (std::size_t i = 0; i < sides && !corners.empty(); ++i) {
      const Corner &p = corners[i], &q = corners[(i + 1) % corners.size()];
      marks.push_back({p.point, q.point, contact, (edges_of(p) | edges_of(q)) != 0});
    }
  }
  [[nodiscard]] bool is_joined(const Sight& sight) {
    return sight.seen < Sight::kBorder && groups_.find(sight.seen) == groups_.find(sight.patch);
  }
  /// Joins a patch to a contact in its sight, or, at the border, to the next point of contact or the vertex on that
  /// edge.
  void join(const Sight& sight, const std::array<std::uint32_t, 3>& corners) {
    if (sight.seen < Sight::kBorder) return static_cast<void>(groups_.join(sight.seen, sight.patch));
    const std::uint32_t e = sight.seen - Sight::kBorder, p = corners[e], q = corners[(e + 1) % 3];
    const std::pair at{edge_key(p, q), along(p, q, sight.to)};
    const auto next = std::lower_bound(points_.begin(), points_.end(), at, [](const OnEdge& x, const auto& key) {
      return std::pair(x.edge, x.along) < key;
    });
    if (next != points_.end() && next->edge == at.first) {
      groups_.join(next->contact, sight.patch);
    } else {
      rims_.emplace_back(patches_.find(static_cast<std::uint32_t>(at.first)), sight.patch);
    }
  }

  [[nodiscard]] unsigned edges_of(const Corner& corner) const { return corner.edges >> shift_ & 7U; }

  const solid::Part& part_;
  int shift_;  ///< the place of this part's edges among the bits of a corner
  const SharedParts& parts_;
  DisjointSets& groups_;
  const std::stop_token& stop_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> touched_;  ///< triangles with their contacts, sorted
  std::vector<Vec3> vertex_;                                      ///< per position
  DisjointSets patches_;                                          ///< sets of positions
  std::vector<OnEdge> points_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rims_;  ///< patches with the contacts on their rims
};

}  // namespace

void join_through(const solid::Part& part, bool first, std::span<const exact::Contact> contacts,
                  const SharedParts& parts, const IsInside& is_inside, DisjointSets& groups,
                  const std::stop_token& stop) {
  Surface surface(part, first, contacts, parts, groups, stop);
  surface.put_points();
  surface.join_vertices();
  surface.join_along_edges(is_inside);
  surface.join_patches(is_inside);
  surface.join_rims(is_inside);
}

}  // namespace impinge::clash
