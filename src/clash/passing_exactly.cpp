// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "clash/flaps.hpp"
#include "clash/flat_line.hpp"
#include "clash/passing.hpp"
#include "clash/sheets.hpp"
#include "core/disjoint_sets.hpp"
#include "core/shapes.hpp"
#include "exact/triangle_pair.hpp"

/// Where no two triangles cross, surfaces pass through each other only along an edge of one of them: over each piece of
/// it, both have flaps around one line. Those that lie in both surfaces belong to a common area, which is left on one
/// side here and perhaps on the other elsewhere.
namespace impinge::clash {
namespace {

/// A part's triangles in contact.
struct Side {
  const solid::Part& part;
  Sheets sheets;
  std::vector<std::vector<std::uint32_t>> touching;  ///< per triangle, by its index: the other part's, by theirs
  std::vector<bool> flat;                            ///< per triangle: whether all of these lie in its plane

  [[nodiscard]] Triangle triangle(std::uint32_t index) const { return part.body.triangle(sheets.ids[index]); }
};

/// Triangles by their boxes' places along an axis.
class Row {
 public:
  Row(const Side& side, const std::vector<std::uint32_t>& triangles) {
    for (const std::uint32_t t : triangles) entries_.push_back({box_of(side.triangle(t)), 0, t});
    std::sort(entries_.begin(), entries_.end(), [](const Entry& p, const Entry& q) { return p.box.lo.x < q.box.lo.x; });
    for (std::size_t i = 0; i < entries_.size(); ++i)
      entries_[i].reach = i == 0 ? entries_[i].box.hi.x : std::max(entries_[i].box.hi.x, entries_[i - 1].reach);
  }
  void find(const Box& box, std::vector<std::uint32_t>& found) const {
    auto entry = std::upper_bound(entries_.begin(), entries_.end(), box.hi.x,
                                  [](double x, const Entry& e) { return x < e.box.lo.x; });
    while (entry != entries_.begin() && std::prev(entry)->reach >= box.lo.x) {
      --entry;
      if (overlap(entry->box, box)) found.push_back(entry->triangle);
    }
  }

 private:
  struct Entry {
    Box box;
    double reach;  ///< of all until this one
    std::uint32_t triangle;
  };
  std::vector<Entry> entries_;
};

/// Where two sheets share an area: on which sides of either the other one is.
struct Place {
  SidesSeen a_at_b, b_at_a;
};

using Ray = std::vector<Flap>;

// Flaps are numbered by twice their triangle's index, and 1 for those of b.
bool is_of_a(const Flap& flap) { return flap.triangle % 2 == 0; }
bool has(const Ray& ray, bool a) {
  return std::any_of(ray.begin(), ray.end(), [&](const Flap& flap) { return is_of_a(flap) == a; });
}

class Passing {
 public:
  Passing(Side a, Side b) : a_(std::move(a)), b_(std::move(b)), areas_(a_.sheets.ids.size()) {
    join_areas();
    for (std::uint32_t t = 0; t < a_.touching.size(); ++t) rows_of_b_.emplace_back(b_, a_.touching[t]);
    for (std::uint32_t t = 0; t < b_.touching.size(); ++t) rows_of_a_.emplace_back(a_, b_.touching[t]);
  }

  bool find() {
    if (look_along_edges(a_, true) || look_along_edges(b_, false)) return true;
    std::map<std::array<std::uint32_t, 3>, Place> places;
    for (const Seen& seen : seen_) {
      const std::uint32_t of_a = (seen.is_a ? seen.own : seen.from).triangle / 2;
      const std::uint32_t of_b = (seen.is_a ? seen.from : seen.own).triangle / 2;
      Place& place = places[{areas_.find(seen.area), a_.sheets.cluster[of_a], b_.sheets.cluster[of_b]}];
      if (seen.is_a)
        place.a_at_b.add(b_.sheets, of_b, seen.sides);
      else
        place.b_at_a.add(a_.sheets, of_a, seen.sides);
    }
    return std::any_of(places.begin(), places.end(), [](const auto& entry) {
      return entry.second.a_at_b.has_both() && entry.second.b_at_a.has_both();
    });
  }

 private:
  /// That a flap in one part alone is beside one of the other, where a common area ends.
  struct Seen {
    std::uint32_t area;  ///< a triangle of a that is of it
    Flap own, from;
    bool is_a;  ///< the part that `own` is of
    std::uint8_t sides;
  };

  /// Triangles of a that lie over a common one of b are in one area. (The areas may be apart; then the sheet is there
  /// in both.)
  void join_areas() {
    for (std::uint32_t j = 0; j < b_.touching.size(); ++j) {
      const Triangle other = b_.triangle(j);
      std::optional<std::uint32_t> first;
      for (const std::uint32_t i : b_.touching[j]) {
        if (!exact::share_area(a_.triangle(i), other)) continue;
        if (first) areas_.join(*first, i);
        first = i;
      }
    }
  }

  /// Whether somewhere along an edge of one part's the surfaces pass through each other.
  bool look_along_edges(const Side& side, bool is_a) {
    std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>> edges;
    for (std::uint32_t t = 0; t < side.sheets.ids.size(); ++t) {
      const auto& corners = side.part.body.placed.mesh->triangles[side.sheets.ids[t]];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t p = side.part.topology.position[corners[k]];
        const std::uint32_t q = side.part.topology.position[corners[(k + 1) % 3]];
        edges[{std::min(p, q), std::max(p, q)}].push_back(3 * t + static_cast<std::uint32_t>(k));
      }
    }
    for (const auto& [positions, uses] : edges) {
      const Triangle first = side.triangle(uses[0] / 3);
      const Line line(first[uses[0] % 3], first[(uses[0] % 3 + 1) % 3]);
      if (look_along(line, uses, is_a)) return true;
    }
    return false;
  }

  /// A use is three times a triangle's index, and which of its edges.
  bool look_along(const Line& line, const std::vector<std::uint32_t>& uses, bool is_a) {
    const Box box{min(line.from(), line.to()), max(line.from(), line.to())};
    std::vector<std::uint32_t> own, other;
    for (const std::uint32_t use : uses) (is_a ? rows_of_b_ : rows_of_a_)[use / 3].find(box, other);
    if (is_flat(uses, other, is_a)) return join_across(line, other, is_a), false;
    std::vector<Stretch> stretches = stretches_of(line, other, !is_a);
    if (stretches.empty()) return false;
    for (const Stretch& stretch : stretches)
      (is_a ? rows_of_a_ : rows_of_b_)[stretch.flaps[0].triangle >> 1].find(box, own);
    for (Stretch& stretch : stretches_of(line, own, is_a)) stretches.push_back(std::move(stretch));
    bool passing = false;
    each_section(std::move(stretches),
                 [&](const std::vector<Flap>& flaps) { return !(passing = look_around(line, flaps)); });
    return passing;
  }

  /// Whether all that may have flaps over a common piece of an edge, of which these are the uses, is in one plane.
  [[nodiscard]] bool is_flat(const std::vector<std::uint32_t>& uses, const std::vector<std::uint32_t>& other,
                             bool is_a) const {
    const Side &own = is_a ? a_ : b_, &others = is_a ? b_ : a_;
    return std::all_of(uses.begin(), uses.end(), [&](std::uint32_t use) { return own.flat[use / 3]; }) &&
           std::all_of(other.begin(), other.end(), [&](std::uint32_t t) { return others.flat[t]; });
  }

  /// In one plane there are two half-planes around a line, so that nothing passes and nothing is on one side of the
  /// other: what is left of `look_around` is that areas are joined. What is in one half-plane is in one area already,
  /// and so is all that a triangle on both sides of the line shares an area with. Areas are joined anew where all end.
  void join_across(const Line& line, std::vector<std::uint32_t>& other, bool is_a) {
    std::vector<EdgeOnLine> edges;
    const auto list = [&](std::vector<std::uint32_t>& triangles, bool of_a) {
      std::sort(triangles.begin(), triangles.end());
      triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
      for (const std::uint32_t t : triangles)
        if (const auto edge = edge_on_line(line, (of_a ? a_ : b_).triangle(t), t, of_a)) edges.push_back(*edge);
    };
    list(other, !is_a);
    const Box box{min(line.from(), line.to()), max(line.from(), line.to())};
    std::vector<std::uint32_t> own;
    for (const EdgeOnLine& edge : edges) (is_a ? rows_of_a_ : rows_of_b_)[edge.triangle].find(box, own);
    list(own, is_a);
    for (const std::vector<std::uint32_t>& of_a : where_all_meet(edges))
      for (const std::uint32_t t : of_a) areas_.join(of_a[0], t);
  }

  /// What triangles have of the line between its points. Numbers are twice a triangle's index, and 1 for those of b.
  std::vector<Stretch> stretches_of(const Line& line, std::vector<std::uint32_t>& triangles, bool of_a) const {
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    const exact::Rational from = line.along(line.from()), to = line.along(line.to());
    std::vector<Stretch> stretches;
    for (const std::uint32_t t : triangles) {
      auto stretch = stretch_of(line, of_a ? a_.triangle(t) : b_.triangle(t), 2 * t + (of_a ? 0 : 1));
      if (!stretch) continue;
      stretch->lo = std::max(stretch->lo, from), stretch->hi = std::min(stretch->hi, to);
      if (stretch->lo < stretch->hi) stretches.push_back(*std::move(stretch));
    }
    return stretches;
  }

  /// Whether the surfaces pass through each other at a piece of a line. Where they have flaps in common, it is noted
  /// what the others are to their area.
  bool look_around(const Line& line, const std::vector<Flap>& flaps) {
    if (flaps.size() < 4 || !has(flaps, true) || !has(flaps, false)) return false;
    const std::vector<Ray> rays = in_order(line, flaps);
    std::optional<std::uint32_t> area;
    for (const Ray& ray : rays) {
      if (!has(ray, true) || !has(ray, false)) continue;
      for (const Flap& flap : ray) {
        if (!is_of_a(flap)) continue;
        if (area) areas_.join(*area, flap.triangle / 2);
        area = flap.triangle / 2;
      }
    }
    if (!area) return alternate(rays);
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (has(rays[i], true) != has(rays[i], false)) note_sides(rays, i, *area);
    return false;
  }

  [[nodiscard]] std::uint32_t cluster_of(const Flap& flap) const {
    return (is_of_a(flap) ? a_ : b_).sheets.cluster[flap.triangle / 2];
  }

  /// Whether around a line there is, of some sheets, one, the other, the one and the other again.
  [[nodiscard]] bool alternate(const std::vector<Ray>& rays) const {
    std::set<std::uint32_t> clusters_a, clusters_b;
    for (const Ray& ray : rays)
      for (const Flap& flap : ray) (is_of_a(flap) ? clusters_a : clusters_b).insert(cluster_of(flap));
    for (const std::uint32_t cluster_a : clusters_a) {
      for (const std::uint32_t cluster_b : clusters_b) {
        std::vector<bool> order;
        for (const Ray& ray : rays)
          if (std::any_of(ray.begin(), ray.end(),
                          [&](const Flap& f) { return cluster_of(f) == (is_of_a(f) ? cluster_a : cluster_b); }))
            order.push_back(is_of_a(ray[0]));
        int changes = 0;
        for (std::size_t i = 0; i < order.size(); ++i) changes += int{order[i] != order[(i + 1) % order.size()]};
        if (changes >= 4) return true;
      }
    }
    return false;
  }

  /// Of a ray that is in one part alone: it is between two of the other's, behind the one and ahead of the next. Beside
  /// a single one it is on neither side: the other part ends there.
  void note_sides(const std::vector<Ray>& rays, std::size_t at, std::uint32_t area) {
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
      for (const Flap& from : rays[i])
        if (is_of_a(from) != is_a)
          for (const Flap& own : rays[at])
            seen_.push_back({area, own, from, is_a, from.ahead_is_front == (i == before) ? kAbove : kBelow});
  }

  Side a_, b_;
  DisjointSets areas_;
  std::vector<Row> rows_of_a_, rows_of_b_;  ///< those that touch each triangle of the other part
  std::vector<Seen> seen_;
};

}  // namespace

bool pass_exactly(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts) {
  if (std::any_of(contacts.begin(), contacts.end(), [](const auto& c) { return c.kind == Kind::crossing; }))
    return true;
  std::vector<std::uint32_t> ids_a, ids_b;
  for (const exact::Contact& contact : contacts) ids_a.push_back(contact.a), ids_b.push_back(contact.b);
  Side side_a{a, sheets_of(a, std::move(ids_a)), {}, {}}, side_b{b, sheets_of(b, std::move(ids_b)), {}, {}};
  side_a.touching.resize(side_a.sheets.ids.size()), side_b.touching.resize(side_b.sheets.ids.size());
  side_a.flat.resize(side_a.sheets.ids.size(), true), side_b.flat.resize(side_b.sheets.ids.size(), true);
  for (const exact::Contact& contact : contacts) {
    if (!a.is_boundary(contact.a) || !b.is_boundary(contact.b)) continue;
    const std::uint32_t i = side_a.sheets.index(contact.a), j = side_b.sheets.index(contact.b);
    side_a.touching[i].push_back(j), side_b.touching[j].push_back(i);
    if (contact.kind != Kind::coplanar) side_a.flat[i] = side_b.flat[j] = false;
  }
  return Passing(std::move(side_a), std::move(side_b)).find();
}

}  // namespace impinge::clash
