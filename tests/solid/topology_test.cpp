// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/topology.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "scenes/hard.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/solid/placed.hpp"

namespace impinge {
namespace {

using Key = std::array<double, 3>;
Key key(const Vec3& v) { return {v.x + 0.0, v.y + 0.0, v.z + 0.0}; }  // -0 + 0 is 0

struct Examined {
  Mesh mesh;
  solid::Body body;
  solid::Topology topology;
  explicit Examined(const scenes::MeshData& shape, const Pose& pose = {})
      : mesh(test::mesh_of(shape)), body(solid::make_body(mesh.state().placed(pose))), topology(solid::examine(body)) {}
};

/// Each triangle a set of its own vertices, edges counted in a map, shells by joining until nothing changes.
void expect_as_by_the_book(const scenes::MeshData& shape) {
  const Examined found(shape);
  const auto& [mesh, body, topology] = found;
  std::map<Key, std::set<std::uint32_t>> numbers;
  for (std::size_t v = 0; v < body.world.size(); ++v) numbers[key(body.world[v])].insert(topology.position[v]);
  ASSERT_EQ(numbers.size(), topology.positions);
  for (const auto& [position, given] : numbers) ASSERT_EQ(given.size(), 1u);

  struct Edge {
    int balance = 0;
    std::vector<std::pair<std::uint32_t, int>> proper;
  };
  std::map<std::pair<Key, Key>, Edge> edges;
  std::uint64_t degenerate = 0;
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    const Triangle triangle = body.triangle(t);
    const bool is_proper = !is_degenerate(triangle);
    degenerate += is_proper ? 0 : 1;
    ASSERT_EQ(topology.shell[t] != solid::Topology::kNoShell, is_proper);
    for (std::size_t i = 0; i < 3; ++i) {
      const Key from = key(triangle[i]), to = key(triangle[(i + 1) % 3]);
      if (from == to) continue;
      const int way = from < to ? 1 : -1;
      Edge& edge = edges[std::minmax(from, to)];
      edge.balance += way;
      if (is_proper) edge.proper.push_back({t, way});
    }
  }
  ASSERT_EQ(topology.degenerate, degenerate);

  std::set<std::pair<Key, Key>> open, found_open;
  std::vector<std::uint32_t> shell(body.size());
  for (std::uint32_t t = 0; t < body.size(); ++t) shell[t] = t;
  for (const auto& [ends, edge] : edges) {
    if (edge.balance != 0) open.insert(ends);
    if (edge.proper.size() != 2 || edge.proper[0].second == edge.proper[1].second) continue;
    const std::uint32_t from = shell[edge.proper[0].first], to = shell[edge.proper[1].first];
    std::replace(shell.begin(), shell.end(), from, to);
  }
  std::map<std::uint32_t, Key> place;
  for (std::size_t v = 0; v < body.world.size(); ++v) place[topology.position[v]] = key(body.world[v]);
  for (const auto& [low, high] : topology.open_edges) found_open.insert(std::minmax(place[low], place[high]));
  ASSERT_EQ(found_open, open);
  ASSERT_EQ(found_open.size(), topology.open_edges.size());
  ASSERT_EQ(topology.closed, open.empty() && degenerate < body.size());

  std::map<std::uint32_t, std::uint32_t> renumbered;  // in the order of the first triangles
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    if (topology.shell[t] == solid::Topology::kNoShell) continue;
    const auto number = renumbered.try_emplace(shell[t], static_cast<std::uint32_t>(renumbered.size())).first->second;
    ASSERT_EQ(topology.shell[t], number);
  }
  ASSERT_EQ(topology.shells, renumbered.size());

  ASSERT_EQ(topology.fan_offsets.size(), topology.positions + std::size_t{1});
  std::vector<std::vector<std::uint32_t>> rows(topology.positions);
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    std::set<std::uint32_t> corners;
    for (const std::uint32_t v : body.placed.mesh->triangles[t]) corners.insert(topology.position[v]);
    for (const std::uint32_t position : corners) rows[position].push_back(t);
  }
  for (std::uint32_t p = 0; p < topology.positions; ++p)
    ASSERT_EQ(std::vector<std::uint32_t>(topology.fan(p).begin(), topology.fan(p).end()), rows[p]);
}

TEST(Topology, IsWhatMapsAndSetsCount) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    ASSERT_NO_FATAL_FAILURE(expect_as_by_the_book(scenes::integer_soup(random, random.integer(1, 60), 2)));
    const scenes::MeshData cubes =
        scenes::joined(scenes::cube(), scenes::shifted(scenes::cube(), 1, random.integer(0, 1), random.integer(0, 1)));
    ASSERT_NO_FATAL_FAILURE(expect_as_by_the_book(scenes::joined(cubes, scenes::degenerate_soup(random, 20, 1))));
  }
  expect_as_by_the_book({});
  expect_as_by_the_book(scenes::box({-1, -1, -1}, {1, 1, 1}, 4));
}

}  // namespace
}  // namespace impinge
