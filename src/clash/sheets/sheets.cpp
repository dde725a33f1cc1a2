// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/sheets.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "clash/sheets/edge_cuts.hpp"
#include "core/disjoint_sets.hpp"

namespace impinge::clash {
namespace {

/// A piece of an edge, as a triangle uses it.
struct EdgeUse {
  std::uint32_t low, high;  ///< positions
  std::uint32_t triangle;   ///< index among the ids
  std::uint32_t corner;     ///< at which the edge begins
  int way;
};

/// Which triangle stands for one, and whether the two look the same way. Where a surface has both windings of each
/// triangle, so that it is seen from either side, the two are one: one is above where the other is below.
struct Stand {
  std::uint32_t index;
  int way;
};

/// The first of all that have the same corners.
std::vector<Stand> stands_of(const solid::Part& part, const std::vector<std::uint32_t>& ids) {
  struct Entry {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t index;
    int way;
  };
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < ids.size(); ++i) {
    auto corners = part.corners(ids[i]);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    const int way = corners[1] < corners[2] ? 1 : -1;
    std::sort(corners.begin(), corners.end());
    entries.push_back({corners, i, way});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& p, const Entry& q) {
    return std::pair(p.corners, p.index) < std::pair(q.corners, q.index);
  });
  std::vector<Stand> stands(ids.size());
  for (std::size_t i = 0, first = 0; i < entries.size(); ++i) {
    if (entries[i].corners != entries[first].corners) first = i;
    stands[entries[i].index] = {entries[first].index, entries[i].way * entries[first].way};
  }
  return stands;
}

void sort(std::vector<EdgeUse>& uses) {
  std::sort(uses.begin(), uses.end(),
            [](const EdgeUse& p, const EdgeUse& q) { return std::pair(p.low, p.high) < std::pair(q.low, q.high); });
}

/// Calls `take` with the uses of each edge, or piece of one.
template <class Take>
void each_edge(const std::vector<EdgeUse>& uses, const Take& take) {
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    while (last < uses.size() && uses[last].low == uses[first].low && uses[last].high == uses[first].high) ++last;
    take(std::span(uses).subspan(first, last - first));
  }
}

/// Of whole edges, sorted: those of one edge are next to each other. Of triangles that others stand for there are none.
std::vector<EdgeUse> edge_uses(const solid::Part& part, const std::vector<std::uint32_t>& ids,
                               const std::vector<Stand>& stands) {
  std::vector<EdgeUse> uses;
  for (std::uint32_t i = 0; i < ids.size(); ++i) {
    if (stands[i].index != i) continue;
    const auto corners = part.corners(ids[i]);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = corners[k], to = corners[(k + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), i, k, from < to ? 1 : -1});
    }
  }
  sort(uses);
  return uses;
}

CommonCorners common_corners(const std::vector<EdgeUse>& uses, const EdgeCuts& cuts, const CornerReach& reach) {
  std::vector<CommonCorners::Edge> edges;
  each_edge(uses, [&](std::span<const EdgeUse> edge) {
    const auto [low, high] = std::pair(edge[0].low, edge[0].high);
    edges.push_back({low, high, {cuts.at(low), cuts.at(high)}, edge.size() == 1});
  });
  return {edges, reach};
}

/// Edges between the corners that stand for theirs; none where these are one.
void join_corners(std::vector<EdgeUse>& uses, const CommonCorners& common) {
  for (EdgeUse& use : uses) {
    const std::uint32_t from = common.of(use.way > 0 ? use.low : use.high);
    const std::uint32_t to = common.of(use.way > 0 ? use.high : use.low);
    use.low = std::min(from, to), use.high = std::max(from, to), use.way = from < to ? 1 : -1;
  }
  std::erase_if(uses, [](const EdgeUse& use) { return use.low == use.high; });
  sort(uses);
}

/// The same of pieces of edges, cut where other corners lie on them. Of edges along one line that all overlap there
/// would be as many pieces as their number squared: too many are left uncut.
std::vector<EdgeUse> cut_up(const std::vector<EdgeUse>& uses, const solid::Part& part,
                            const std::vector<std::uint32_t>& ids, const EdgeCuts& cuts, const CommonCorners& common) {
  constexpr std::size_t kMost = 8;
  std::vector<EdgeUse> pieces;
  each_edge(uses, [&](std::span<const EdgeUse> edge) {
    std::vector<std::uint32_t> along{edge[0].low, edge[0].high};
    if (pieces.size() < kMost * uses.size()) along = cuts.along(edge[0].low, edge[0].high);
    for (std::uint32_t& position : along) position = common.of(position);
    // A triangle may be so narrow that its third corner is on the edge but for the tolerance.
    for (const EdgeUse& use : edge)
      if (along.size() > 2) std::erase(along, common.of(part.corners(ids[use.triangle])[(use.corner + 2) % 3]));
    along.erase(std::unique(along.begin(), along.end()), along.end());
    for (EdgeUse use : edge) {
      const int way = use.way;
      for (std::size_t i = 1; i < along.size(); ++i) {
        use.low = std::min(along[i - 1], along[i]), use.high = std::max(along[i - 1], along[i]);
        use.way = along[i - 1] < along[i] ? way : -way;
        pieces.push_back(use);
      }
    }
  });
  sort(pieces);
  return pieces;
}

/// The way from an edge to the triangle's third corner, at a right angle.
Vec3 away_from(const TriangleEdge& edge, const solid::Part& part) {
  const Triangle t = part.body.triangle(edge.triangle);
  const Vec3 &from = t[edge.corner], along = t[(edge.corner + 1) % 3] - from, way = t[(edge.corner + 2) % 3] - from;
  return way - (dot(way, along) / dot(along, along)) * along;
}

/// Of two triangles at an edge: +1 if what is above the one is above the other, as the surface goes on. A surface that
/// is folded up flat is two layers of one sheet: what is above the one is below the other.
int turn_between(const EdgeUse& p, const EdgeUse& q, const solid::Part& part, const std::vector<std::uint32_t>& ids) {
  const bool is_folded_up = go_one_way(part, {ids[p.triangle], p.corner}, {ids[q.triangle], q.corner});
  return (is_folded_up ? 1 : -1) * p.way * q.way;
}

struct Neighbor {
  std::uint32_t index;
  int turn;
};

void find_pieces(const std::vector<EdgeUse>& uses, const solid::Part& part, Sheets& sheets) {
  std::vector<std::vector<Neighbor>> neighbors(sheets.ids.size());
  each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2) return;
    const int turn = turn_between(edge[0], edge[1], part, sheets.ids);
    neighbors[edge[0].triangle].push_back({edge[1].triangle, turn});
    neighbors[edge[1].triangle].push_back({edge[0].triangle, turn});
  });
  sheets.side.assign(sheets.ids.size(), 0);
  sheets.piece.assign(sheets.ids.size(), 0);
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < sheets.ids.size(); ++i) {
    if (sheets.side[i] != 0) continue;
    sheets.side[i] = 1, sheets.piece[i] = i, open.push_back(i);
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      for (const Neighbor& next : neighbors[at])
        if (sheets.side[next.index] == 0)
          sheets.side[next.index] = next.turn * sheets.side[at], sheets.piece[next.index] = i,
          open.push_back(next.index);
    }
  }
}

/// Of very many triangles at an edge some: the next ones of each.
void find_links(const std::vector<EdgeUse>& uses, const solid::Part& part, Sheets& sheets) {
  constexpr std::size_t kMost = 16;
  sheets.links.resize(sheets.ids.size());
  each_edge(uses, [&](std::span<const EdgeUse> edge) {
    for (std::size_t i = 0; edge.size() > 2 && i < edge.size(); ++i)
      for (std::size_t j = i + 1; j < std::min(edge.size(), i + kMost); ++j) {
        const std::uint32_t p = edge[i].triangle, q = edge[j].triangle;
        const int turn = turn_between(edge[i], edge[j], part, sheets.ids) * sheets.side[p] * sheets.side[q];
        sheets.links[sheets.piece[p]].push_back({sheets.piece[q], turn});
        sheets.links[sheets.piece[q]].push_back({sheets.piece[p], turn});
      }
  });
}

void find_ends(const std::vector<EdgeUse>& uses, const solid::Part& part, const EdgeCuts& cuts, Sheets& sheets) {
  each_edge(uses, [&](std::span<const EdgeUse> edge) {
    const auto of = [&](const EdgeUse& use) { return TriangleEdge{sheets.ids[use.triangle], use.corner}; };
    const auto goes_too = [&](const EdgeUse& use) { return go_one_way(part, of(edge[0]), of(use)); };
    if (!std::all_of(edge.begin() + 1, edge.end(), goes_too)) return;
    const auto [low, high] = std::pair(edge[0].low, edge[0].high);
    sheets.ends.push_back({{cuts.at(low), cuts.at(high)}, {low, high}, of(edge[0])});
  });
}

void find_clusters(const solid::Part& part, const std::vector<EdgeUse>& uses, const CommonCorners& common,
                   Sheets& sheets) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> corners;
  for (std::uint32_t i = 0; i < sheets.ids.size(); ++i)
    for (const std::uint32_t position : part.corners(sheets.ids[i])) corners.emplace_back(common.of(position), i);
  for (const EdgeUse& use : uses)
    corners.emplace_back(use.low, use.triangle), corners.emplace_back(use.high, use.triangle);
  std::sort(corners.begin(), corners.end());
  DisjointSets clusters(sheets.ids.size());
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (corners[i].first == corners[i - 1].first) clusters.join(corners[i].second, corners[i - 1].second);
  for (std::uint32_t i = 0; i < sheets.ids.size(); ++i) sheets.cluster.push_back(clusters.find(i));
}

}  // namespace

bool go_one_way(const solid::Part& part, const TriangleEdge& p, const TriangleEdge& q) {
  constexpr double kFlat = 0x1p-6;  // what the tolerance parts is folded up flat as well
  const Vec3 u = away_from(p, part), v = away_from(q, part);
  const double along = dot(u, v);
  return along > 0 && norm(cross(u, v)) <= kFlat * along;
}

Sheets sheets_of(const solid::Part& part, std::vector<std::uint32_t> ids, double tolerance) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  const auto is_degenerate = [&](std::uint32_t t) { return part.topology.shell[t] == solid::Topology::kNoShell; };
  ids.erase(std::remove_if(ids.begin(), ids.end(), is_degenerate), ids.end());
  Sheets sheets{.ids = std::move(ids), .cluster = {}, .piece = {}, .side = {}, .links = {}, .ends = {}};
  const std::vector<Stand> stands = stands_of(part, sheets.ids);
  const CornerReach reach(part, tolerance);
  const EdgeCuts cuts(part, sheets.ids, reach);
  std::vector<EdgeUse> uses = edge_uses(part, sheets.ids, stands);
  const CommonCorners common = common_corners(uses, cuts, reach);
  join_corners(uses, common);
  uses = cut_up(uses, part, sheets.ids, cuts, common);
  find_pieces(uses, part, sheets);
  for (std::uint32_t i = 0; i < sheets.ids.size(); ++i) {
    const auto [index, way] = stands[i];
    sheets.piece[i] = sheets.piece[index], sheets.side[i] = way * sheets.side[index];
  }
  find_links(uses, part, sheets);
  find_ends(uses, part, cuts, sheets);
  find_clusters(part, uses, common, sheets);
  return sheets;
}

std::uint8_t SidesSeen::from(const Sheets& sheets, std::uint32_t triangle) const {
  const auto found = of_piece_.find(sheets.piece[triangle]);
  return found == of_piece_.end() ? std::uint8_t{0} : turned(found->second, sheets.side[triangle]);
}

void SidesSeen::add(const Sheets& sheets, std::uint32_t triangle, std::uint8_t sides) {
  constexpr std::uint8_t kBoth = kAbove | kBelow;
  const std::uint32_t piece = sheets.piece[triangle];
  std::uint8_t& known = of_piece_[piece];
  const std::uint8_t before = known;
  known |= turned(sides, sheets.side[triangle]);
  if (known == before || has_both_) return;
  has_both_ = known == kBoth;
  for (const Sheets::Link& link : sheets.links[piece]) look_at(piece, link);
}

void SidesSeen::add_between(const Sheets& sheets, std::uint32_t triangle, std::uint8_t sides,
                            const std::vector<std::uint32_t>& on) {
  const std::uint32_t piece = sheets.piece[triangle];
  for (const Sheets::Link& link : sheets.links[piece]) {
    if (link.piece == piece || std::find(on.begin(), on.end(), link.piece) != on.end()) continue;
    of_two_[{piece, link.piece}] |= turned(sides, sheets.side[triangle]);
    look_at(piece, link);
  }
}

/// Whether there is something on both sides of two pieces that are one sheet.
void SidesSeen::look_at(std::uint32_t piece, const Sheets::Link& link) {
  const auto of = [](const auto& sides, const auto& key) {
    const auto found = sides.find(key);
    return found == sides.end() ? std::uint8_t{0} : found->second;
  };
  const auto own = static_cast<std::uint8_t>(of(of_piece_, piece) | of(of_two_, Pieces{piece, link.piece}));
  const auto other = static_cast<std::uint8_t>(of(of_piece_, link.piece) | of(of_two_, Pieces{link.piece, piece}));
  has_both_ |= (own | turned(other, link.turn)) == (kAbove | kBelow);
}

}  // namespace impinge::clash
