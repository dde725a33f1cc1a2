// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// A roadmap planner for an arm of seven joints that reaches into a shelf (Bohlin and Kavraki, "Path planning using lazy
// PRM", 2000). `collide_configurations` says of thousands of random configurations which are free; neighbours among
// those are joined. The shortest way is sought as if every edge were free, then `first_touching` looks along its edges:
// one that touches something is taken out, and the search begins again.
//
// How many are free depends on the numbers drawn. That the path that comes out is free is asked once more by the other
// call, at steps a fourth as wide.
//
// prints: # of 4000 configurations are free, # of 40000 reach into the shelf and are free
// prints: # edges join them
// prints: # edges looked at, # of them touch
// prints: the path has # edges and # steps, 0 of which touch:
// prints:   0 0 0 0 0 0 0
// prints: ...
// prints: the hand is in the shelf
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <random>
#include <span>
#include <utility>

#include "impinge/scene.hpp"
#include "shapes.hpp"

namespace {

constexpr std::size_t kJoints = 7;
constexpr double kLength = 0.25, kStep = 0.04;  // of a link; the widest turn of a joint between two poses of an edge
using Angles = std::array<double, kJoints>;
using Poses = std::vector<impinge::Pose>;

/// Joints turn about z and y in turns; each link stands on the one before. Returns the hand's place.
std::array<double, 3> append_arm(const Angles& angles, Poses& poses) {
  impinge::Pose at;
  for (std::size_t i = 0; i < kJoints; ++i) {
    const double c = std::cos(angles[i]), s = std::sin(angles[i]);
    const auto turn = i % 2 == 0 ? std::array{c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0}
                                 : std::array{c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c};
    const auto before = at.R;
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t k = 0; k < 3; ++k)
        at.R[3 * row + k] =
            before[3 * row] * turn[k] + before[3 * row + 1] * turn[3 + k] + before[3 * row + 2] * turn[6 + k];
    poses.push_back(at);
    for (std::size_t row = 0; row < 3; ++row) at.t[row] += kLength * at.R[3 * row + 2];
  }
  return at.t;
}

double distance(const Angles& a, const Angles& b) {
  double most = 0;
  for (std::size_t i = 0; i < kJoints; ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

/// From a to b, both among them.
Poses along(const Angles& a, const Angles& b, double step) {
  Poses poses;
  const int steps = std::max(1, static_cast<int>(std::ceil(distance(a, b) / step)));
  for (int s = 0; s <= steps; ++s) {
    Angles between;
    for (std::size_t i = 0; i < kJoints; ++i) between[i] = a[i] + (b[i] - a[i]) * s / steps;
    append_arm(between, poses);
  }
  return poses;
}

/// An arm on the floor before a shelf of three compartments, x from 0.55 to 0.9.
struct Robot {
  Robot() {
    const auto stand = [&](const impinge::Mesh& mesh) { value_of(scene.add(mesh, {}, 1)); };  // one group: untested
    stand(box({-2, -2, -0.12}, {2, 2, -0.02}));
    for (const double z : {0.2, 0.55, 0.9, 1.25}) stand(box({0.55, -0.5, z}, {0.9, 0.5, z + 0.02}));
    for (const double y : {-0.52, 0.5}) stand(box({0.55, y, 0}, {0.9, y + 0.02, 1.27}));
    stand(box({0.9, -0.52, 0}, {0.92, 0.52, 1.27}));
    const auto link = box({-0.035, -0.035, 0}, {0.035, 0.035, kLength});
    for (std::size_t i = 0; i < kJoints; ++i) links.push_back(value_of(scene.add(link)));
    for (std::size_t i = 0; i + 1 < kJoints; ++i) value_of(scene.ignore(links[i], links[i + 1]));
    value_of(scene.update());
  }
  static bool reaches(const std::array<double, 3>& hand) {  // well into the middle compartment
    return hand[0] > 0.65 && hand[0] < 0.85 && std::abs(hand[1]) < 0.4 && hand[2] > 0.62 && hand[2] < 0.85;
  }
  [[nodiscard]] std::vector<std::uint8_t> touching(const Poses& poses) const {
    return value_of(scene.collide_configurations(links, poses)).touches;
  }

  impinge::Scene scene;
  std::vector<impinge::ObjectId> links;
};

/// Those of these that are free.
std::vector<Angles> free_of(const Robot& robot, const std::vector<Angles>& asked) {
  Poses poses;
  for (const Angles& angles : asked) append_arm(angles, poses);
  const auto touches = robot.touching(poses);
  std::vector<Angles> free;
  for (std::size_t i = 0; i < asked.size(); ++i)
    if (touches[i] == 0) free.push_back(asked[i]);
  return free;
}

struct Edge {
  std::uint32_t to;
  double length;
  bool is_known = false;  ///< to be free
};
using Roadmap = std::vector<std::vector<Edge>>;

/// Dijkstra's way from 0 to 1; empty if there is none.
std::vector<std::uint32_t> shortest(const Roadmap& map) {
  std::vector<double> length(map.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> before(map.size());
  std::priority_queue<std::pair<double, std::uint32_t>> open;
  length[0] = 0, open.push({0, 0});
  while (!open.empty()) {
    const auto [minus, at] = open.top();
    open.pop();
    if (at == 1) break;
    if (-minus > length[at]) continue;
    for (const Edge& edge : map[at])
      if (length[at] + edge.length < length[edge.to]) {
        length[edge.to] = length[at] + edge.length, before[edge.to] = at;
        open.push({-length[edge.to], edge.to});
      }
  }
  std::vector<std::uint32_t> way;
  if (std::isinf(length[1])) return way;
  for (std::uint32_t at = 1; at != 0; at = before[at]) way.push_back(at);
  way.push_back(0);
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace

int main() {
  const Robot robot;
  std::mt19937 engine(7);
  const auto drawn = [&](double least, double most) {
    return least + (most - least) * (static_cast<double>(engine()) * 0x1p-32);
  };
  const auto random_angles = [&](const Angles& about, double reach) {
    Angles angles;
    for (std::size_t i = 0; i < kJoints; ++i) angles[i] = about[i] + drawn(-reach, reach);
    return angles;
  };
  std::vector<Angles> asked, reaching;
  for (int i = 0; i < 40000; ++i) {
    const Angles angles = random_angles({}, 2);
    Poses poses;
    if (Robot::reaches(append_arm(angles, poses))) reaching.push_back(angles);
    if (i % 10 == 0) asked.push_back(angles);
  }
  const std::vector<Angles> goals = free_of(robot, reaching);
  std::vector<Angles> nodes = free_of(robot, asked);
  std::cout << nodes.size() << " of " << asked.size() << " configurations are free, " << goals.size()
            << " of 40000 reach into the shelf and are free\n";
  if (goals.empty()) return 1;
  // The start, upright; the goal; and more about the goal, where it is narrow.
  asked.clear();
  for (int i = 0; i < 2000; ++i) asked.push_back(random_angles(goals[0], 0.6));
  const std::vector<Angles> near_goal = free_of(robot, asked);
  nodes.insert(nodes.begin(), {Angles{}, goals[0]});
  nodes.insert(nodes.end(), near_goal.begin(), near_goal.end());

  constexpr std::size_t kNeighbours = 10;
  Roadmap map(nodes.size());
  std::size_t edges = 0;
  std::vector<std::pair<double, std::uint32_t>> near;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    near.clear();
    for (std::uint32_t k = 0; k < nodes.size(); ++k)
      if (k != i) near.push_back({distance(nodes[i], nodes[k]), k});
    std::partial_sort(near.begin(), near.begin() + kNeighbours, near.end());
    for (std::size_t n = 0; n < kNeighbours; ++n) {
      const auto [length, k] = near[n];
      const auto is_to = [&](const Edge& edge) { return edge.to == k; };
      if (std::any_of(map[i].begin(), map[i].end(), is_to)) continue;
      map[i].push_back({k, length}), map[k].push_back({i, length});
      ++edges;
    }
  }
  std::cout << edges << " edges join them\n";

  int looked_at = 0, touching = 0;
  const auto edge_of = [&](std::uint32_t from, std::uint32_t to) {
    return std::find_if(map[from].begin(), map[from].end(), [&](const Edge& edge) { return edge.to == to; });
  };
  std::vector<std::uint32_t> way;
  for (bool is_free = false; !is_free;) {
    way = shortest(map);
    is_free = true;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      const std::uint32_t a = way[i], b = way[i + 1];
      if (edge_of(a, b)->is_known) continue;
      ++looked_at;
      if (!value_of(robot.scene.first_touching(robot.links, along(nodes[a], nodes[b], kStep)))) {
        edge_of(a, b)->is_known = edge_of(b, a)->is_known = true;
        continue;
      }
      ++touching;
      map[a].erase(edge_of(a, b)), map[b].erase(edge_of(b, a));
      is_free = false;
    }
  }
  std::cout << looked_at << " edges looked at, " << touching << " of them touch\n";
  if (way.empty()) return 1;

  std::size_t steps = 0, wrong = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const auto touches = robot.touching(along(nodes[way[i]], nodes[way[i + 1]], kStep / 4));
    steps += touches.size();
    wrong += static_cast<std::size_t>(std::count(touches.begin(), touches.end(), 1));
  }
  std::cout << "the path has " << way.size() - 1 << " edges and " << steps << " steps, " << wrong
            << " of which touch:\n";
  for (const std::uint32_t node : way) {
    std::cout << ' ';
    for (const double angle : nodes[node]) std::cout << ' ' << angle;
    std::cout << '\n';
  }
  Poses last;
  std::cout << (Robot::reaches(append_arm(nodes[way.back()], last)) ? "the hand is in the shelf\n" : "");
}
