// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// First contact in a planner's loop: whether a place is free is a yes or no, so `Find::first` ends a query at the first
// contact. The answer is as exact as that of a whole query.
//
// A robot of side 1 goes from (0, 0) to (5, 0) on a grid of 6 x 6 places. A thin wall at x = 2.5, up to y = 3.2, blocks
// x = 2 and x = 3 where the robot's lower side is below it: y - 0.5 <= 3.2, so y = 0 to 3. Free are 36 - 8 places, and
// the way round is 4 up, 5 across and 4 down. (Surfaces are compared: a robot that fitted within the wall would touch
// nothing there. `impinge/clash.hpp` compares solids.)
//
// prints: 28 places are free, the shortest way has 13 steps
#include <array>
#include <deque>

#include "shapes.hpp"

int main() {
  const auto robot = box({-0.5, -0.5, 0}, {0.5, 0.5, 1}), wall = box({2.4, -1, 0}, {2.6, 3.2, 1});
  impinge::Workspace workspace;  // one for each thread of a planner
  const auto is_free = [&](int x, int y) {
    const impinge::Pose place{.t{double(x), double(y), 0}};
    auto contacts = value_of(
        impinge::collide(robot, place, wall, {}, {.find = impinge::Options::Find::first, .threads = 1}, &workspace));
    const bool touches = !contacts.objects.empty();
    workspace.recycle(std::move(contacts));
    return !touches;
  };

  constexpr int kSide = 6, kUnknown = -1, kBlocked = -2;
  std::array<std::array<int, kSide>, kSide> steps{};
  int free_places = 0;
  for (int x = 0; x < kSide; ++x) {
    for (int y = 0; y < kSide; ++y) {
      steps[x][y] = is_free(x, y) ? kUnknown : kBlocked;
      free_places += steps[x][y] == kUnknown;
    }
  }
  std::deque<std::array<int, 2>> queue{{0, 0}};  // breadth first
  for (steps[0][0] = 0; !queue.empty(); queue.pop_front()) {
    const auto [x, y] = queue.front();
    for (const auto& [u, v] : {std::array{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}}) {
      if (u < 0 || v < 0 || u >= kSide || v >= kSide || steps[u][v] != kUnknown) continue;
      steps[u][v] = steps[x][y] + 1;
      queue.push_back({u, v});
    }
  }
  std::cout << free_places << " places are free, the shortest way has " << steps[5][0] << " steps\n";
}
