// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/passing.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>

#include "clash/local_frame.hpp"
#include "clash/slab.hpp"
#include "core/disjoint_sets.hpp"
#include "measure/nearest.hpp"

namespace impinge::clash {
namespace {

/// The triangles of one part that are near the other's; which of them hang together over edges, in pieces; and to which
/// side each looks, +1 or -1, so that neighbours look the same way.
struct NearTriangles {
  std::vector<std::uint32_t> ids;  ///< sorted
  std::vector<int> side;
  std::vector<std::uint32_t> piece;

  [[nodiscard]] std::uint32_t index(std::uint32_t id) const {
    return static_cast<std::uint32_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
  }
};

struct EdgeUse {
  std::uint32_t low, high;  ///< positions
  std::uint32_t triangle;   ///< index among the near ones
  int way;
};

/// Sorted: those of one edge are next to each other.
std::vector<EdgeUse> edge_uses(const solid::Part& part, const std::vector<std::uint32_t>& ids) {
  std::vector<EdgeUse> uses;
  for (std::uint32_t i = 0; i < ids.size(); ++i) {
    const auto& corners = part.body.placed.mesh->triangles[ids[i]];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = part.topology.position[corners[k]], to = part.topology.position[corners[(k + 1) % 3]];
      if (from != to) uses.push_back({std::min(from, to), std::max(from, to), i, from < to ? 1 : -1});
    }
  }
  std::sort(uses.begin(), uses.end(),
            [](const EdgeUse& p, const EdgeUse& q) { return std::pair(p.low, p.high) < std::pair(q.low, q.high); });
  return uses;
}

NearTriangles near_triangles(const solid::Part& part, std::vector<std::uint32_t> ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  struct Neighbor {
    std::uint32_t index;
    int turn;  ///< +1 where both run through the common edge in opposite ways
  };
  std::vector<std::vector<Neighbor>> neighbors(ids.size());
  const std::vector<EdgeUse> uses = edge_uses(part, ids);
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    while (last < uses.size() && uses[last].low == uses[first].low && uses[last].high == uses[first].high) ++last;
    if (last - first != 2) continue;
    const EdgeUse &one = uses[first], &two = uses[first + 1];
    neighbors[one.triangle].push_back({two.triangle, -one.way * two.way});
    neighbors[two.triangle].push_back({one.triangle, -one.way * two.way});
  }
  NearTriangles result{std::move(ids), {}, {}};
  result.side.assign(result.ids.size(), 0);
  result.piece.assign(result.ids.size(), 0);
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < result.ids.size(); ++i) {
    if (result.side[i] != 0) continue;
    result.side[i] = 1, result.piece[i] = i, open.push_back(i);
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      for (const Neighbor& next : neighbors[at])
        if (result.side[next.index] == 0)
          result.side[next.index] = next.turn * result.side[at], result.piece[next.index] = i,
          open.push_back(next.index);
    }
  }
  return result;
}

constexpr std::uint8_t kAbove = 1, kBelow = 2;

/// On which sides of a triangle's slab, within its sides, another triangle has points.
std::uint8_t sides_of(const Slab& slab, const Triangle& triangle) {
  if (!slab.has_plane) return 0;
  Polygon piece(triangle);
  for (std::size_t i = 0; i < slab.size; ++i) {
    piece = cut(piece, slab.sides[i]).within;
    if (piece.size() == 0) return 0;
  }
  const auto beyond = [&](const HalfSpace& half_space) {
    return std::any_of(piece.begin(), piece.end(),
                       [&](const Vec3& p) { return dot(half_space.normal, p) > half_space.offset; });
  };
  return static_cast<std::uint8_t>((beyond(slab.top) ? kAbove : 0) | (beyond(slab.bottom) ? kBelow : 0));
}

std::uint8_t turned(std::uint8_t sides, int way) {
  if (way > 0) return sides;
  return static_cast<std::uint8_t>(((sides & kAbove) != 0 ? kBelow : 0) | ((sides & kBelow) != 0 ? kAbove : 0));
}

/// Every near pair, those that the encounter left out too.
void each_near(const LinkedPart& a, const LinkedPart& b, double tolerance, const Encounter& encounter,
               const measure::TakePair& take, const std::stop_token& stop) {
  if (!encounter.is_whole) return measure::near_pairs(a.part.body.placed, b.part.body.placed, tolerance, take, stop);
  for (const TrianglePair& pair : encounter.near)
    if (stop.stop_requested() || !take(pair)) return;
}

}  // namespace

bool pass_through(const LinkedPart& a, const LinkedPart& b, double tolerance, const Encounter& encounter,
                  const std::stop_token& stop) {
  const std::vector<exact::Contact>& contacts = encounter.contacts;
  const auto is_crossing = [](const exact::Contact& contact) { return contact.kind == Kind::crossing; };
  if (std::none_of(contacts.begin(), contacts.end(), is_crossing)) return false;
  std::vector<std::uint32_t> ids_a, ids_b;
  for (const TrianglePair& pair : encounter.near) ids_a.push_back(pair.a), ids_b.push_back(pair.b);
  const NearTriangles of_a = near_triangles(a.part, std::move(ids_a)), of_b = near_triangles(b.part, std::move(ids_b));
  const auto count_a = static_cast<std::uint32_t>(of_a.ids.size());
  DisjointSets groups(of_a.ids.size() + of_b.ids.size());
  const auto join = [&](const TrianglePair& pair) {
    groups.join(of_a.index(pair.a), count_a + of_b.index(pair.b));
    return true;
  };
  each_near(a, b, tolerance, encounter, join, stop);

  // A place is where one piece meets one piece: sides of different pieces have nothing to do with each other.
  struct Place {
    std::uint8_t a_at_b = 0, b_at_a = 0;
  };
  std::map<std::array<std::uint32_t, 3>, Place> places;
  const auto key_of = [&](std::uint32_t a_triangle, std::uint32_t b_triangle) {
    const std::uint32_t i = of_a.index(a_triangle), j = of_b.index(b_triangle);
    return std::array{groups.find(i), of_a.piece[i], of_b.piece[j]};
  };
  for (const exact::Contact& contact : contacts)
    if (is_crossing(contact)) places.try_emplace(key_of(contact.a, contact.b));

  const LocalFrame frame = local_frame(a.part.body.box, b.part.body.box);
  bool pass = false;
  const auto look_at = [&](const TrianglePair& pair) {
    const auto found = places.find(key_of(pair.a, pair.b));
    if (found == places.end()) return true;
    Place& place = found->second;
    const Triangle triangle_a = frame.to_local(a.part.body.triangle(pair.a));
    const Triangle triangle_b = frame.to_local(b.part.body.triangle(pair.b));
    const auto slab_a = make_slab(triangle_a, frame.unit * tolerance, frame.scale);
    const auto slab_b = make_slab(triangle_b, frame.unit * tolerance, frame.scale);
    if (slab_a) place.b_at_a |= turned(sides_of(*slab_a, triangle_b), of_a.side[of_a.index(pair.a)]);
    if (slab_b) place.a_at_b |= turned(sides_of(*slab_b, triangle_a), of_b.side[of_b.index(pair.b)]);
    pass = place.a_at_b == (kAbove | kBelow) && place.b_at_a == (kAbove | kBelow);
    return !pass;
  };
  each_near(a, b, tolerance, encounter, look_at, stop);
  return pass;
}

}  // namespace impinge::clash
