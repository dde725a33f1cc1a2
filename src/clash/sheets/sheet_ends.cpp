// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/sheet_ends.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "clash/sheets/common_corners.hpp"
#include "measure/triangle_distance.hpp"

namespace impinge::clash {
namespace {

/// Whether all boundary triangles that use an edge go the same way from it as the given one does.
bool is_end(const std::array<std::uint32_t, 2>& edge, const TriangleEdge& of, const solid::Part& part) {
  bool ends = true;
  part.topology.for_each_use(part.body, edge[0], edge[1], [&](std::uint32_t t, std::uint32_t corner) {
    ends = ends && (t == of.triangle || !part.is_boundary(t) || go_one_way(part, of, {t, corner}));
  });
  return ends;
}

/// Whether the surface ends there too as the whole part has it, which may go on in triangles that the sheets leave out.
bool is_end(const Sheets::End& end, const solid::Part& part) {
  const auto corners = part.corners(end.of.triangle);
  return is_end(end.positions, end.of, part) &&
         is_end({corners[end.of.corner], corners[(end.of.corner + 1) % 3]}, end.of, part);
}

Box united(const Box& p, const Box& q) { return {min(p.lo, q.lo), max(p.hi, q.hi)}; }

Box widened(const Box& box, double by) {
  const Vec3 margin{by, by, by};
  return {box.lo - margin, box.hi + margin};
}

/// A part's open edges within a box. Where one runs along another the surface goes on, cut differently.
class Borders {
 public:
  Borders(const solid::Part& part, const Box& box, const CornerReach& reach) : part_(part), reach_(reach) {
    std::vector<broad::BoxTree::Entry> entries;
    for (const auto& edge : part.topology.open_edges)
      part.topology.for_each_use(part.body, edge[0], edge[1], [&](std::uint32_t id, std::uint32_t corner) {
        const Triangle t = part.body.triangle(id);
        const Segment at{t[corner], t[(corner + 1) % 3]};
        if (!part.is_boundary(id) || !overlap(box_of(at), box)) return;
        entries.emplace_back(box_of(at), static_cast<std::uint32_t>(edges_.size()));
        edges_.push_back({at, {id, corner}});
      });
    tree_.build(entries);
  }

  /// The pieces of an end along which no other triangle goes on.
  [[nodiscard]] std::vector<Segment> left_of(const Sheets::End& end) const {
    const Vec3 &from = end.piece[0], &to = end.piece[1];
    const double length = norm(to - from), within = reach_.beside(length);
    std::vector<std::array<double, 2>> covered;
    const std::array<std::uint32_t, 1> asked{0};
    const std::array<Box, 1> boxes{widened(box_of(end.piece), within)};
    broad::BoxTree::Search search;
    tree_.find(asked, boxes, search);
    for (const std::uint64_t key : search.found) {
      const auto& [at, use] = edges_[static_cast<std::uint32_t>(key)];
      if (use.triangle != end.of.triangle && !go_one_way(part_, end.of, use))
        add_covered(end.piece, at, std::min(within, reach_.beside(norm(at[1] - at[0]))), covered);
    }
    std::sort(covered.begin(), covered.end());
    std::vector<Segment> left;
    double done = 0;
    const auto add = [&](double lo, double hi) {
      if (hi - lo > within || covered.empty())
        left.push_back({from + (lo / length) * (to - from), from + (hi / length) * (to - from)});
    };
    for (const auto& [lo, hi] : covered) add(done, lo), done = std::max(done, hi);
    add(done, length);
    return left;
  }

 private:
  struct Border {
    Segment at;
    TriangleEdge use;
  };

  /// Where along a piece, in lengths from its beginning, an edge runs within a distance of it.
  static void add_covered(const Segment& piece, const Segment& edge, double within,
                          std::vector<std::array<double, 2>>& covered) {
    const double length = norm(piece[1] - piece[0]);
    const Vec3 along = (1 / length) * (piece[1] - piece[0]);
    double a = dot(edge[0] - piece[0], along), b = dot(edge[1] - piece[0], along);
    Segment at = edge;
    if (a > b) std::swap(a, b), std::swap(at[0], at[1]);
    const double lo = std::max(a, 0.0), hi = std::min(b, length);
    if (!(hi > lo)) return;
    for (const double place : {lo, hi}) {
      const Vec3 point = at[0] + ((place - a) / (b - a)) * (at[1] - at[0]);
      if (norm(point - piece[0] - place * along) > within) return;
    }
    covered.push_back({lo, hi});
  }

  const solid::Part& part_;
  CornerReach reach_;
  std::vector<Border> edges_;
  broad::BoxTree tree_;  ///< over them
};

}  // namespace

SheetEnds::SheetEnds(const solid::Part& part, const Sheets& sheets, const LocalFrame& frame, double tolerance) {
  std::vector<Sheets::End> open;
  Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const Sheets::End& end : sheets.ends)
    if (is_end(end, part)) open.push_back(end), box = united(box, box_of(end.piece));
  const Borders borders(part, widened(box, tolerance), {part, tolerance});
  std::vector<broad::BoxTree::Entry> entries;
  for (const Sheets::End& end : open)
    for (const Segment& piece : borders.left_of(end)) {
      ends_.push_back({frame.to_local(piece[0]), frame.to_local(piece[1])});
      entries.emplace_back(box_of(ends_.back()), static_cast<std::uint32_t>(entries.size()));
    }
  tree_.build(entries);
}

bool SheetEnds::are_near(const Vec3& point, double distance) const {
  const Vec3 margin{distance, distance, distance};
  const std::array<std::uint32_t, 1> asked{0};
  const std::array<Box, 1> boxes{Box{point - margin, point + margin}};
  broad::BoxTree::Search search;
  tree_.find(asked, boxes, search);
  return std::any_of(search.found.begin(), search.found.end(), [&](std::uint64_t key) {
    const Segment& end = ends_[static_cast<std::uint32_t>(key)];
    return measure::point_distance(point, {end[0], end[1], end[1]}, distance).distance <= distance;
  });
}

}  // namespace impinge::clash
