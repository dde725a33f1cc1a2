// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/around_lines.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace impinge::clash {
namespace {

/// Where two sheets share an area: on which sides of either the other one is.
struct Place {
  SidesSeen a_at_b, b_at_a;
};

bool has(const Ray& ray, bool a) {
  return std::any_of(ray.begin(), ray.end(), [&](const HalfPlane& half_plane) { return is_of_a(half_plane) == a; });
}

/// Which sheets a ray is in.
struct Membership {
  bool a, b;
};

/// Whether there are, in this order, one of a, of b, of a and of b, each another ray.
bool alternate_from(const std::vector<Membership>& order, std::size_t start) {
  int found = 0;
  for (std::size_t step = 0; step < order.size() && found < 4; ++step) {
    const Membership& in = order[(start + step) % order.size()];
    if (found % 2 == 0 ? in.a : in.b) ++found;
  }
  return found == 4;
}

}  // namespace

AlongEdge::AlongEdge(const MetSide& side, const MetSide& other)
    : side_(side), other_(other), is_asked_(other.sheets.ids.size()) {
  boxes_.reserve(side.sheets.ids.size());
  for (std::uint32_t t = 0; t < side.sheets.ids.size(); ++t) boxes_.push_back(box_of(side.triangle(t)));
}

/// Many that meet as many others, such as those around the hub of a flat fan, would name each other once for each pair:
/// then each of them is looked at once.
std::vector<std::uint32_t> AlongEdge::find(const Box& box, const std::vector<std::uint32_t>& others) {
  constexpr std::size_t kFew = 64;
  std::size_t pairs = 0;
  for (const std::uint32_t other : others) pairs += other_.met[other].size();
  std::vector<std::uint32_t> found;
  if (pairs <= kFew) {
    for (const std::uint32_t other : others)
      for (const std::uint32_t t : other_.met[other])
        if (overlap(boxes_[t], box)) found.push_back(t);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }
  for (const std::uint32_t other : others) is_asked_[other] = true;
  for (const std::uint32_t t : find_all(box))
    if (std::any_of(side_.met[t].begin(), side_.met[t].end(), [&](std::uint32_t other) { return is_asked_[other]; }))
      found.push_back(t);
  for (const std::uint32_t other : others) is_asked_[other] = false;
  return found;
}

std::vector<std::uint32_t> AlongEdge::find_all(const Box& box) {
  if (!tree_) {
    std::vector<broad::BoxTree::Entry> entries;
    entries.reserve(boxes_.size());
    for (std::uint32_t t = 0; t < boxes_.size(); ++t) entries.emplace_back(boxes_[t], t);
    tree_.emplace().build(entries);
  }
  const std::array<std::uint32_t, 1> asked{0};
  tree_->find(asked, {&box, 1}, search_);
  std::vector<std::uint32_t> found(search_.found.size());
  std::transform(search_.found.begin(), search_.found.end(), found.begin(),
                 [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::uint32_t> triangles_of(const Uses& uses) {
  std::vector<std::uint32_t> triangles;
  triangles.reserve(uses.size());
  for (const std::uint32_t use : uses) triangles.push_back(use / 3);
  return triangles;
}

std::vector<Uses> edges_of(const MetSide& side) {
  std::map<std::array<std::uint32_t, 2>, Uses> edges;
  for (std::uint32_t t = 0; t < side.sheets.ids.size(); ++t) {
    const auto corners = side.part.corners(side.sheets.ids[t]);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = corners[k], q = corners[(k + 1) % 3];
      edges[{std::min(p, q), std::max(p, q)}].push_back(3 * t + static_cast<std::uint32_t>(k));
    }
  }
  std::vector<Uses> uses;
  uses.reserve(edges.size());
  for (auto& [positions, of_edge] : edges) uses.push_back(std::move(of_edge));
  return uses;
}

bool AroundLines::look_around(const std::vector<Ray>& rays) {
  std::optional<std::uint32_t> area;
  for (const Ray& ray : rays) {
    if (!has(ray, true) || !has(ray, false)) continue;
    for (const HalfPlane& half_plane : ray) {
      if (!is_of_a(half_plane)) continue;
      if (area) areas_.join(*area, half_plane.triangle / 2);
      area = half_plane.triangle / 2;
    }
  }
  if (alternate(rays)) return true;
  for (std::size_t i = 0; area && i < rays.size(); ++i)
    if (has(rays[i], true) != has(rays[i], false)) note_sides(rays, i, *area);
  return false;
}

bool AroundLines::pass_at_areas() {
  std::map<std::array<std::uint32_t, 3>, Place> places;
  for (const Seen& seen : seen_) {
    const std::uint32_t of_a = (seen.is_a ? seen.own : seen.from).triangle / 2;
    const std::uint32_t of_b = (seen.is_a ? seen.from : seen.own).triangle / 2;
    Place& place = places[{areas_.find(seen.area), a_.cluster[of_a], b_.cluster[of_b]}];
    if (seen.is_a)
      place.a_at_b.add(b_, of_b, seen.sides);
    else
      place.b_at_a.add(a_, of_a, seen.sides);
  }
  return std::any_of(places.begin(), places.end(), [](const auto& entry) {
    return entry.second.a_at_b.has_both() && entry.second.b_at_a.has_both();
  });
}

std::uint32_t AroundLines::cluster_of(const HalfPlane& half_plane) const {
  return (is_of_a(half_plane) ? a_ : b_).cluster[half_plane.triangle / 2];
}

/// Whether around a line there is, of some sheets, one, the other, the one and the other again. A ray in both counts as
/// either: a plate that lies on the web of a T goes through the flange if it goes on behind it, and a plate on the web
/// of a cross does, whether or not the flange is cut where they meet.
bool AroundLines::alternate(const std::vector<Ray>& rays) const {
  std::set<std::uint32_t> clusters_a, clusters_b;
  for (const Ray& ray : rays)
    for (const HalfPlane& half_plane : ray)
      (is_of_a(half_plane) ? clusters_a : clusters_b).insert(cluster_of(half_plane));
  for (const std::uint32_t cluster_a : clusters_a)
    for (const std::uint32_t cluster_b : clusters_b)
      if (alternate(rays, cluster_a, cluster_b)) return true;
  return false;
}

bool AroundLines::alternate(const std::vector<Ray>& rays, std::uint32_t cluster_a, std::uint32_t cluster_b) const {
  std::vector<Membership> order;
  for (const Ray& ray : rays) {
    const auto has = [&](bool a) {
      return std::any_of(ray.begin(), ray.end(), [&](const HalfPlane& half_plane) {
        return is_of_a(half_plane) == a && cluster_of(half_plane) == (a ? cluster_a : cluster_b);
      });
    };
    const Membership in{has(true), has(false)};
    // Of rays of one part next to each other one counts; so there are few left, or the first start says yes.
    const bool repeats = in.a != in.b && !order.empty() && order.back().a == in.a && order.back().b == in.b;
    if ((in.a || in.b) && !repeats) order.push_back(in);
  }
  for (std::size_t start = 0; start < order.size(); ++start)
    if (alternate_from(order, start)) return true;
  return false;
}

/// Of a ray that is in one part alone: it is between two of the other's, behind the one and ahead of the next. Beside
/// a single one it is on neither side: the other part ends there.
void AroundLines::note_sides(const std::vector<Ray>& rays, std::size_t at, std::uint32_t area) {
  const bool is_a = has(rays[at], true);
  const auto next = [&](std::size_t step) {
    std::size_t i = at;
    do i = (i + step) % rays.size();
    while (!has(rays[i], !is_a));
    return i;
  };
  const std::size_t before = next(rays.size() - 1), after = next(1);
  if (before == after) return;
  for (const std::size_t i : {before, after})
    for (const HalfPlane& from : rays[i])
      if (is_of_a(from) != is_a)
        for (const HalfPlane& own : rays[at])
          seen_.push_back({area, own, from, is_a, from.ahead_is_front == (i == before) ? kAbove : kBelow});
}

}  // namespace impinge::clash
