// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/regions.hpp"

#include <algorithm>
#include <tuple>

#include "clash/regions/grouping.hpp"
#include "clash/regions/region_measures.hpp"
#include "clash/regions/shared_parts.hpp"
#include "clash/regions/welded.hpp"
#include "core/local_frame.hpp"
#include "core/stopped.hpp"
#include "measure/nearest.hpp"
#include "solid/locate.hpp"

namespace impinge::clash {
namespace {

/// The indices of each group's contacts, ascending; groups are in the order of their first contacts.
std::vector<std::vector<std::uint32_t>> members_of(DisjointSets& groups, std::size_t contacts) {
  std::vector<std::vector<std::uint32_t>> members;
  std::vector<std::uint32_t> number(contacts);
  for (std::uint32_t i = 0; i < contacts; ++i) {
    const std::uint32_t group = groups.find(i);
    if (group == i) {
      number[i] = static_cast<std::uint32_t>(members.size());
      members.emplace_back();
    }
    members[number[group]].push_back(i);
  }
  return members;
}

bool are_all_one(DisjointSets& groups, std::size_t contacts) {
  for (std::uint32_t i = 0; i < contacts; ++i)
    if (groups.find(i) != 0) return false;
  return true;
}

/// The radius of the inscribed circle: 2 area / perimeter, as the wall of a solid is 2 volume / area.
double width(const Triangle& t) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const double perimeter = norm(u) + norm(v) + norm(t[2] - t[1]);
  return perimeter > 0 ? norm(cross(u, v)) / perimeter : 0;
}

/// The median width of the triangles, since a few slivers say nothing of the others.
double median_width(const solid::Body& body, std::vector<std::uint32_t> triangles, const LocalFrame& frame) {
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  std::vector<double> widths;
  widths.reserve(triangles.size());
  for (const std::uint32_t t : triangles) widths.push_back(width(frame.to_local(body.triangle(t))));
  if (widths.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  return *middle;
}

Reach reach_of(const solid::Body& a, const solid::Body& b, std::span<const exact::Contact> contacts, double tolerance) {
  if (tolerance == 0) return {};
  const LocalFrame frame = local_frame(a.box, b.box);
  std::vector<std::uint32_t> of_a, of_b;
  for (const exact::Contact& pair : contacts) of_a.push_back(pair.a), of_b.push_back(pair.b);
  const double width = std::min(median_width(a, std::move(of_a), frame), median_width(b, std::move(of_b), frame));
  // However narrow the triangles are, the resolution stays above rounding.
  const double least = std::max(0x1p-8 * tolerance, kLeastTolerance * frame.scale / frame.unit);
  return {tolerance, std::min(tolerance, std::max(width / (4 * frame.unit), least))};
}

/// The test for points in a solid's interior. A point within the tolerance of the boundary counts as on it.
IsInside inside_of(const solid::Part& part, double tolerance, const std::stop_token& stop) {
  return [&part, tolerance, &stop](const Vec3& p) {
    throw_if_stopped(stop);
    return solid::winding_number(part.body.placed, p).value_or(0) != 0 &&
           !(tolerance > 0 && measure::nearest_point(part.body.placed, p, tolerance, tolerance));
  };
}

bool is_small(const Triangle& triangle, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i)
    if (norm(triangle[(i + 1) % 3] - triangle[i]) > 4 * tolerance) return false;
  return true;
}

}  // namespace

std::vector<Region> regions_of(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts,
                               double tolerance, const ForEach& for_each, const std::stop_token& stop) {
  const Reach reach = reach_of(a.body, b.body, contacts, tolerance);
  SharedParts parts = shared_parts(a.body, b.body, contacts, reach, for_each, stop);
  // Twice the distance over which points were moved, since lines have moved too.
  const double within_line = tolerance > 0 ? 2 * welding_distance(parts, reach) : 0;
  if (tolerance > 0) parts = welded(a.body, b.body, contacts, parts, reach, stop);
  DisjointSets groups(contacts.size());
  if (tolerance > 0) join_near_corners(parts, contacts.size(), tolerance, groups, stop);
  join_neighbours(a, b, contacts, parts, groups, stop);
  for (const bool first : {true, false}) {
    const solid::Part &part = first ? a : b, &other = first ? b : a;
    if (other.solid && !are_all_one(groups, contacts.size()))
      join_through(part, first, contacts, parts, inside_of(other, tolerance, stop), groups, stop);
  }
  const auto members = members_of(groups, contacts.size());
  std::vector<Region> regions(members.size());
  run_each(for_each, members.size(), [&](std::size_t i) {
    throw_if_stopped(stop);
    regions[i] = measured(a, b, contacts, parts, members[i], within_line, stop);
  });
  // Groups are in the order of their first pairs, which decides between equal regions.
  std::stable_sort(regions.begin(), regions.end(), [](const Region& x, const Region& y) {
    return std::tie(x.area, x.length, x.pairs) > std::tie(y.area, y.length, y.pairs);
  });
  return regions;
}

std::size_t most_small_pairs(const solid::Body& a, const solid::Body& b) {
  return (1 << 20) + 64 * (a.size() + b.size());
}

std::optional<std::vector<exact::Contact>> contacts_within(const solid::Body& a, const solid::Body& b, double tolerance,
                                                           std::size_t most, const std::stop_token& stop) {
  std::vector<exact::Contact> contacts;
  std::size_t small = 0;
  const auto take = [&](const TrianglePair& pair) {
    contacts.push_back({pair.a, pair.b, Kind::touching});
    if (is_small(a.triangle(pair.a), tolerance) && is_small(b.triangle(pair.b), tolerance)) ++small;
    return small <= most;
  };
  measure::near_pairs(a.placed, b.placed, tolerance, take, stop);
  if (small > most) return std::nullopt;
  const auto before = [](const auto& x, const auto& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); };
  std::sort(contacts.begin(), contacts.end(), until_stopped(stop, before));
  return contacts;
}

}  // namespace impinge::clash
