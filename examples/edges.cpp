// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// A planner that knows its edges to be free: `time_of_impact` follows the robot from place to place, where samples of
// the way could step over something thin. No answer is a proof; an answer is a contact, or nearer than the tolerance.
//
// A robot of side 0.5 goes from (0, 0) to (5, 0) on a grid of 6 x 6 places. A thin wall at x = 2.4 to 2.6, up to y
// = 3.2, is between places: at x = 2 the robot ends at 2.25, at x = 3 it begins at 2.75, so all 36 places are free. Of
// the 60 edges those from x = 2 to 3 are blocked where the robot's lower side is below the wall's end: y - 0.25 <= 3.2,
// so y = 0 to 3. The way by places alone is 5 across; by edges it is 4 up, 5 across and 4 down. On an edge at y = 0 the
// robot's front, at 2.25, meets the wall's side after 0.15.
//
// prints: 36 places and 56 of 60 edges are free
// prints: the shortest way has 13 steps, not 5
// prints: on the straight way the robot hits the wall at t = 0.15 of its third step
#include <array>
#include <deque>
#include <iomanip>

#include "impinge/sweeps.hpp"
#include "shapes.hpp"

namespace {

constexpr int kSide = 6;
using Place = std::array<int, 2>;

impinge::Pose pose(const Place& place) { return {.t{double(place[0]), double(place[1]), 0}}; }

/// Steps from (0, 0) to (5, 0) along edges for which `is_free(from, to)`.
template <class IsFree>
int steps_to_goal(const IsFree& is_free) {
  std::array<std::array<int, kSide>, kSide> steps{};
  for (auto& column : steps) column.fill(-1);
  std::deque<Place> queue{{0, 0}};  // breadth first
  for (steps[0][0] = 0; !queue.empty(); queue.pop_front()) {
    const auto [x, y] = queue.front();
    for (const Place& next : {Place{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}}) {
      const auto [u, v] = next;
      if (u < 0 || v < 0 || u >= kSide || v >= kSide || steps[u][v] >= 0 || !is_free(Place{x, y}, next)) continue;
      steps[u][v] = steps[x][y] + 1;
      queue.push_back(next);
    }
  }
  return steps[kSide - 1][0];
}

}  // namespace

int main() {
  const auto robot = box({-0.25, -0.25, 0}, {0.25, 0.25, 1}), wall = box({2.4, -1, 0}, {2.6, 3.2, 1});
  impinge::Workspace workspace;  // one for each thread of a planner
  const auto hit = [&](const Place& from, const Place& to) {
    return value_of(impinge::time_of_impact(robot, {pose(from), pose(to)}, wall, impinge::at_rest({}), 1e-6,
                                            {.threads = 1}, &workspace));
  };
  const auto is_free_place = [&](const Place& place) { return !hit(place, place); };
  const auto is_free_edge = [&](const Place& from, const Place& to) { return !hit(from, to); };

  int places = 0, edges = 0;
  for (int x = 0; x < kSide; ++x)
    for (int y = 0; y < kSide; ++y) {
      places += is_free_place({x, y});
      edges += x + 1 < kSide && is_free_edge({x, y}, {x + 1, y});
      edges += y + 1 < kSide && is_free_edge({x, y}, {x, y + 1});
    }
  std::cout << places << " places and " << edges << " of 60 edges are free\n";
  std::cout << "the shortest way has " << steps_to_goal(is_free_edge) << " steps, not "
            << steps_to_goal([&](const Place&, const Place& to) { return is_free_place(to); }) << '\n';
  std::cout << "on the straight way the robot hits the wall at t = " << std::setprecision(3)
            << hit({2, 0}, {3, 0})->time.hi << " of its third step\n";
}
