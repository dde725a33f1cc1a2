// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/grouping.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "clash/point_grid.hpp"
#include "core/point_table.hpp"
#include "core/stopped.hpp"

namespace impinge::clash {
namespace {

/// The positions that triangles of part a with contacts use, in order.
std::vector<std::uint32_t> positions_of(const solid::Part& a, std::span<const exact::Contact> contacts) {
  std::vector<std::uint32_t> positions;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (i == 0 || contacts[i].a != contacts[i - 1].a)
      for (const std::uint32_t p : a.corners(contacts[i].a)) positions.push_back(p);
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

/// For each position or triangle of b, the last contact seen there while one position of a is visited (a turn).
class Last {
 public:
  explicit Last(std::size_t size) : seen_(size) {}
  /// Joins the contact to the last one seen here in this turn; false if it is the first one.
  bool join(std::size_t place, std::uint32_t turn, std::uint32_t contact, DisjointSets& groups) {
    auto& [last_turn, last] = seen_[place];
    const bool is_known = last_turn == turn + 1;
    if (is_known) groups.join(last, contact);
    last_turn = turn + 1, last = contact;
    return is_known;
  }

 private:
  std::vector<std::array<std::uint32_t, 2>> seen_;
};

/// Half of the steps from a cell to those around it up to two cells away; the other half are the reverse ones.
std::vector<Vec3> steps_to_neighbours() {
  std::vector<Vec3> steps;
  for (int i = 63; i < 125; ++i) {
    const int x = i / 25 - 2, y = i / 5 % 5 - 2, z = i % 5 - 2;
    steps.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
  }
  return steps;
}

bool are_near(const PointGrid& grid, const PointGrid::Cell& x, const PointGrid::Cell& y, double tolerance) {
  const auto is_within = [&](const Vec3& way) { return norm((1 / tolerance) * way) <= 1; };
  const Vec3 gap = max(max(x.box.lo - y.box.hi, y.box.lo - x.box.hi), Vec3{0, 0, 0});
  if (!is_within((1 - 0x1p-40) * gap)) return false;
  return grid.any_of(x, [&](const Vec3& p, std::uint32_t) {
    return grid.any_of(y, [&](const Vec3& q, std::uint32_t) { return is_within(q - p); });
  });
}

void join_at_corners(const SharedParts& parts, std::size_t contacts, DisjointSets& groups,
                     const std::stop_token& stop) {
  PointTable points;
  std::vector<std::uint32_t> first;  // contact of each point
  std::size_t last = 0;              // consecutive contacts may share a row, which holds the same points
  for (std::uint32_t i = 0; i < contacts; ++i) {
    throw_if_stopped(stop);
    if (i > 0 && parts[i].data() == parts[last].data() && parts[i].size() == parts[last].size()) {
      if (!parts[i].empty()) groups.join(i, static_cast<std::uint32_t>(last));
      continue;
    }
    last = i;
    for (const Corner& corner : parts[i]) {
      const std::uint32_t at = points.add(corner.point);
      if (at == first.size()) first.push_back(i);
      groups.join(first[at], i);
    }
  }
}

}  // namespace

// The diagonal of a cell is a little less than the tolerance, so that all points of a cell are near each other: many
// corners within one tolerance must not be compared each with each.
void join_near_corners(const SharedParts& parts, std::size_t contacts, double tolerance, DisjointSets& groups,
                       const std::stop_token& stop) {
  PointGrid grid(tolerance / 1.75);
  PointTable seen;
  for (std::uint32_t i = 0; i < contacts; ++i) {
    throw_if_stopped(stop);
    for (const Corner& corner : parts[i])
      if (const auto before = seen.size(); seen.add(corner.point) == before)
        groups.join(grid.first_number(grid.add(corner.point, i)), i);
  }
  grid.for_each_pair(steps_to_neighbours(), stop, [&](const PointGrid::Cell& cell, const PointGrid::Cell& other) {
    const std::uint32_t one = grid.first_number(cell), two = grid.first_number(other);
    if (groups.find(one) != groups.find(two) && are_near(grid, cell, other, tolerance)) groups.join(one, two);
  });
}

// Two pairs are neighbours if and only if their triangles of a have some position p in common and those of b some
// position q. All pairs are visited once for each p: pairs with a common triangle of b also have its three q in common.
void join_neighbours(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts,
                     const SharedParts& parts, DisjointSets& groups, const std::stop_token& stop) {
  Last at_triangle(b.body.size()), at_position(b.topology.positions);
  const auto visit = [&](std::uint32_t p, std::uint32_t contact) {
    throw_if_stopped(stop);
    const std::uint32_t t = contacts[contact].b;
    if (at_triangle.join(t, p, contact, groups)) return;
    for (const std::uint32_t q : b.corners(t)) at_position.join(q, p, contact, groups);
  };
  for (const std::uint32_t p : positions_of(a, contacts))
    for (const std::uint32_t t : a.topology.fan(p)) {
      const auto [first, last] = std::ranges::equal_range(contacts, t, {}, &exact::Contact::a);
      for (auto at = first; at != last; ++at) visit(p, static_cast<std::uint32_t>(at - contacts.begin()));
    }
  join_at_corners(parts, contacts.size(), groups, stop);
}

}  // namespace impinge::clash
