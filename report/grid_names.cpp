// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/grid_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "report/text.hpp"

namespace impinge::report {
namespace {

// Axes that end at each other may miss each other by rounding, or by the care of who drew them: each piece is so much
// longer at both ends.
constexpr double kSlack = 1e-3;
// Two axes at a smaller angle, as its sine, do not cross.
constexpr double kParallel = 1e-3;
// Two axes of a building cross once or twice; more often than this is a drawing of something else.
constexpr std::size_t kMostCrossings = 16;
// Crossings of an axis are in one place if they are no further apart, as a part of what is between its first and last.
constexpr double kSamePlace = 1e-6;

double cross_product(const auto& a, const auto& b) { return a.x * b.y - a.y * b.x; }
double length_in_plan(const auto& v) { return std::sqrt(v.x * v.x + v.y * v.y); }
template <class Flat>
double distance(const Flat& a, const Flat& b) {
  return length_in_plan(Flat{a.x - b.x, a.y - b.y});
}

/// "B/3": letters stand before numbers, and else the axis of the earlier family first.
std::string name_of(const std::string& first, const std::string& second) {
  const auto is_number = [](const std::string& tag) { return tag[0] >= '0' && tag[0] <= '9'; };
  return is_number(first) && !is_number(second) ? second + '/' + first : first + '/' + second;
}

}  // namespace

GridNames::GridNames(std::span<const io::Grid> grids, bool y_up, const std::stop_token& stop) : y_up_(y_up) {
  for (const io::Grid& grid : grids) {
    PlanGrid plan{grid.storey, {}, {}};
    for (const io::GridAxis& axis : grid.axes) {
      Axis& flat = plan.axes.emplace_back(Axis{axis.tag, axis.family, false, {}, {}, {}});
      for (const Point& p : axis.points) {
        const Flat at{p.x, y_up ? p.z : p.y};
        flat.along.push_back(flat.points.empty() ? 0 : flat.along.back() + distance(flat.points.back(), at));
        flat.points.push_back(at);
      }
      const Flat &first = flat.points.front(), &last = flat.points.back();
      flat.is_closed = flat.points.size() > 3 && first.x == last.x && first.y == last.y;
    }
    bool is_grid = true;
    for (std::uint32_t i = 0; i < plan.axes.size() && is_grid; ++i)
      for (std::uint32_t j = i + 1; j < plan.axes.size() && is_grid && !stop.stop_requested(); ++j)
        is_grid = plan.axes[i].family == plan.axes[j].family || cross(plan, i, j);
    if (!is_grid) {
      warnings_.push_back(fmt::format("no axes are named by the grid '{}': two of them cross more than {} times",
                                      printable(grid.name), kMostCrossings));
      plan = {grid.storey, {}, {}};
    }
    std::ranges::sort(plan.crossings, {}, [](const Crossing& crossing) { return crossing.at.x; });
    for (Axis& axis : plan.axes)
      for (auto& list : axis.crossings) std::ranges::sort(list, {}, [](const auto& one) { return one.first; });
    grids_.push_back(std::move(plan));
  }
}

/// Adds where the axes `i` and `j` cross. False: more often than axes do.
bool GridNames::cross(PlanGrid& grid, std::uint32_t i, std::uint32_t j) {
  Axis &a = grid.axes[i], &b = grid.axes[j];
  const std::size_t first = grid.crossings.size();
  for (std::size_t k = 1; k < a.points.size(); ++k) {
    const Flat &p = a.points[k - 1], r{a.points[k].x - p.x, a.points[k].y - p.y};
    const double r_length = length_in_plan(r);
    for (std::size_t m = 1; m < b.points.size(); ++m) {
      const Flat &q = b.points[m - 1], s{b.points[m].x - q.x, b.points[m].y - q.y};
      const double sine = cross_product(r, s);
      const Flat between{q.x - p.x, q.y - p.y};
      const double t = cross_product(between, s) / sine, u = cross_product(between, r) / sine;
      const auto is_on = [](double part) { return part >= -kSlack && part <= 1 + kSlack; };
      if (!is_on(t) || !is_on(u)) continue;
      const double s_length = length_in_plan(s);
      if (!(std::abs(sine) > kParallel * r_length * s_length)) continue;
      const Flat at{p.x + t * r.x, p.y + t * r.y};
      // At a joint both pieces cross.
      const double near = 4 * kSlack * std::max(a.points.size() > 2 ? r_length : 0, b.points.size() > 2 ? s_length : 0);
      const auto is_same = [&](const Crossing& other) { return distance(other.at, at) <= near; };
      if (std::any_of(grid.crossings.begin() + static_cast<std::ptrdiff_t>(first), grid.crossings.end(), is_same))
        continue;
      if (grid.crossings.size() - first == kMostCrossings) return false;
      grid.crossings.push_back({at,
                                {i, j},
                                {a.along[k - 1] + t * r_length, b.along[m - 1] + u * s_length},
                                {Flat{r.x / r_length, r.y / r_length}, Flat{s.x / s_length, s.y / s_length}}});
    }
  }
  for (std::size_t c = first; c < grid.crossings.size(); ++c) {
    const Crossing& crossing = grid.crossings[c];
    a.crossings[b.family].emplace_back(crossing.along[0], crossing.at);
    b.crossings[a.family].emplace_back(crossing.along[1], crossing.at);
  }
  return true;
}

/// Adds the grid's crossing that is nearest, if the place is within half a bay of it.
void GridNames::consider(const PlanGrid& grid, const Flat& at, std::vector<Nearest>& found) {
  // Outwards from the place, as long as crossings may be nearer by x alone.
  const Crossing* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](const Crossing& crossing) {
    if (std::abs(crossing.at.x - at.x) > least) return false;
    const double far = distance(crossing.at, at);
    if (far < least || (far == least && crossing.axes < nearest->axes)) least = far, nearest = &crossing;
    return true;
  };
  const auto middle = std::ranges::lower_bound(grid.crossings, at.x, {}, [](const Crossing& one) { return one.at.x; });
  for (auto next = middle; next != grid.crossings.end() && look_at(*next);) ++next;
  for (auto next = middle; next != grid.crossings.begin() && look_at(*std::prev(next));) --next;
  if (nearest == nullptr) return;

  // How far the place is from the crossing in the directions of both axes, and how long the bay is there: nothing
  // where the axis crosses no other.
  const auto& [a, b] = nearest->direction;
  const Flat way{at.x - nearest->at.x, at.y - nearest->at.y};
  const double sine = cross_product(a, b);
  const std::array<double, 2> step{cross_product(way, b) / sine, cross_product(a, way) / sine};
  std::array<std::optional<double>, 2> bay;
  std::array<bool, 2> is_between{};
  const auto along_of = [](const auto& one) { return one.first; };
  for (std::size_t k = 0; k < 2; ++k) {
    const Axis &axis = grid.axes[nearest->axes[k]], &other = grid.axes[nearest->axes[1 - k]];
    const auto& line = axis.crossings[other.family];
    // Axes that lie on each other cross it in one place, but for rounding; the bay is to the next one beyond.
    const double near = kSamePlace * (line.back().first - line.front().first);
    const auto before = std::ranges::lower_bound(line, nearest->along[k] - near, {}, along_of);
    const auto after = std::ranges::upper_bound(line, nearest->along[k] + near, {}, along_of);
    const auto bay_to = [&](auto neighbour) { return distance(neighbour->second, nearest->at); };
    const bool is_last = after == line.end(), is_first = before == line.begin();
    is_between[k] = (axis.is_closed && !(is_last && is_first)) || !(step[k] > 0 ? is_last : is_first);
    if (!is_last && (step[k] > 0 || is_first))
      bay[k] = bay_to(after);
    else if (!is_first)
      bay[k] = bay_to(std::prev(before));
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const std::optional<double> size = bay[k] ? bay[k] : bay[1 - k];
    if (!is_between[k] && !(size && std::abs(step[k]) <= *size / 2)) return;
  }
  const std::string &first = grid.axes[nearest->axes[0]].tag, &second = grid.axes[nearest->axes[1]].tag;
  found.push_back({!is_between[0] || !is_between[1], least,
                   first.empty() || second.empty() ? std::string() : name_of(first, second)});
}

/// The name of the nearest crossing of all grids that are wanted; those that the place is between come first. Nothing:
/// the place is by none.
template <class IsWanted>
std::optional<std::string> GridNames::name_by(const Flat& at, IsWanted is_wanted) const {
  std::vector<Nearest> found;
  for (const PlanGrid& grid : grids_)
    if (is_wanted(grid.storey)) consider(grid, at, found);
  const auto best = std::ranges::min_element(
      found, {}, [](const Nearest& one) { return std::tie(one.is_outside, one.distance, one.name); });
  return best == found.end() ? std::nullopt : std::optional(best->name);
}

std::string GridNames::name_at(const Point& at, std::span<const std::string_view> storeys) const {
  const Flat flat{at.x, y_up_ ? at.z : at.y};
  const auto is_of_storeys = [&](const std::string& storey) {
    return !storey.empty() && std::ranges::find(storeys, storey) != storeys.end();
  };
  if (auto name = name_by(flat, is_of_storeys)) return *name;
  if (auto name = name_by(flat, [](const std::string& storey) { return storey.empty(); })) return *name;
  // Many files hold the building's grid once, in its lowest storey.
  std::set<std::string> others, names;
  for (const PlanGrid& grid : grids_) {
    if (is_of_storeys(grid.storey)) return {};
    if (!grid.storey.empty()) others.insert(grid.storey);
  }
  for (const std::string& other : others)
    if (auto name = name_by(flat, [&](const std::string& storey) { return storey == other; })) names.insert(*name);
  return names.size() == 1 ? *names.begin() : std::string();
}

}  // namespace impinge::report
