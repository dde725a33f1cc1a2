// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/contact_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "clash/vertex_contact.hpp"
#include "pipeline/mesh_state.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"
#include "tests/exact/pairs.hpp"
#include "tests/measure/exact_distance.hpp"

/// What is left out where triangles meet in one corner, against the oracle's cuts and distances in rationals.
namespace impinge {
namespace {

using clash::ContactPairs;
using clash::find_contact_pairs;

oracle::Corners shared_by(const Triangle& a, const Triangle& b) {
  const auto corners = [](const Triangle& t) {
    return oracle::simplified({oracle::vec(t[0]), oracle::vec(t[1]), oracle::vec(t[2])});
  };
  return oracle::common_part(corners(a), oracle::half_spaces(corners(b)));
}

/// Whether it is true what is said of two triangles.
void expect_true(const clash::VertexContact& vertex_contact, const Triangle& a, const Triangle& b, double tolerance) {
  const oracle::Vec v = oracle::vec(a[vertex_contact.corner_a]), w = oracle::vec(b[vertex_contact.corner_b]);
  const mpq_class near = mpq_class(tolerance) / 8, apart = oracle::square(v, w);
  EXPECT_EQ(vertex_contact.is_one_point, apart == 0);
  EXPECT_LE(apart, 4 * near * near);
  for (const oracle::Vec& p : shared_by(a, b)) {
    EXPECT_LE(oracle::square(p, v), vertex_contact.is_one_point ? mpq_class(0) : mpq_class(near * near));
    EXPECT_LE(oracle::square(p, w), vertex_contact.is_one_point ? mpq_class(0) : mpq_class(near * near));
  }
}

TEST(VertexContact, HoldsAllThatTrianglesShare) {
  test::Seeded seeded(1);
  scenes::Random& random = seeded.random;
  const auto point = [&](double size) {
    return Point{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
  };
  int found = 0, apart = 0;
  for (int i = 0; i < 20000; ++i) {
    const double tolerance = std::pow(2.0, random.uniform(-30, -3));
    const double gap = i % 2 == 0 ? 0 : tolerance * std::pow(2.0, random.uniform(-20, 0));
    const Point v = point(1);
    Triangle a{v, v + point(1), v + point(1)}, b{v + point(gap), v + point(1), v + point(1)};
    if (i % 3 == 0) b[1] = v + random.uniform(0, 1) * (a[1] - v) + point(std::pow(2.0, random.uniform(-50, -10)));
    if (i % 5 == 0)
      for (Point* const p : {&a[1], &a[2], &b[1], &b[2]}) p->z = v.z;
    std::swap(a[0], a[static_cast<std::size_t>(i) % 3]);
    const auto vertex_contact = clash::find_vertex_contact(a, b, tolerance);
    if (!vertex_contact) continue;
    ++found, apart += vertex_contact->is_one_point ? 0 : 1;
    ASSERT_NO_FATAL_FAILURE(expect_true(*vertex_contact, a, b, tolerance)) << test::written({a, b});
    EXPECT_TRUE(clash::find_vertex_contact(b, a, tolerance)) << "the other way round";
  }
  EXPECT_GT(found, 5000);
  EXPECT_GT(apart, 1000);
}

TEST(VertexContact, HoldsAllThatHardTrianglesShare) {
  test::Seeded seeded(2);
  int found = 0;
  for (const test::PairFamily& family : test::pair_families()) {
    SCOPED_TRACE(family.name);
    for (int i = 0; i < 200; ++i) {
      const test::Pair pair = test::varied(family.make(seeded.random), seeded.random);
      const double size = norm(pair[0][1] - pair[0][0]);
      for (const double tolerance : {0.0, 0x1p-20 * size, 0.1 * size}) {
        const auto vertex_contact = clash::find_vertex_contact(pair[0], pair[1], tolerance);
        if (!vertex_contact) continue;
        ++found;
        ASSERT_NO_FATAL_FAILURE(expect_true(*vertex_contact, pair[0], pair[1], tolerance)) << test::written(pair);
      }
    }
  }
  EXPECT_GT(found, 200);
}

/// A disc about its middle, or a cone: its rim at some height over the middle.
scenes::MeshData fan(int sides, double radius, double turn, double height) {
  scenes::MeshData mesh{{0, 0, 0}, {}};
  const auto n = static_cast<std::uint32_t>(sides);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * (i + turn) / n;
    mesh.xyz.insert(mesh.xyz.end(), {radius * std::cos(angle), radius * std::sin(angle), height});
    mesh.triangles.insert(mesh.triangles.end(), {0, 1 + i, 1 + (i + 1) % n});
  }
  return mesh;
}

struct Fan {
  Mesh mesh;
  Pose pose;
  [[nodiscard]] solid::Body body() const {
    return solid::make_body({&mesh.state().data, &mesh.state().wide_tree, pose});
  }
};

double longest_edge(const Triangle& t) { return std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])}); }

/// By brute force: all counts, all that is not left out, and that what stands for the others is there.
void expect_all(const Fan& fan_a, const Fan& fan_b, double within) {
  const solid::Body a = fan_a.body(), b = fan_b.body();
  const ContactPairs met = find_contact_pairs(a, b, {within});
  const ContactPairs full = find_contact_pairs(a, b, {.within = within, .all_contacts = true});
  std::set<std::tuple<std::uint32_t, std::uint32_t>> near, contacts;
  for (const TrianglePair& pair : met.near) EXPECT_TRUE(near.emplace(pair.a, pair.b).second);
  for (const exact::Contact& contact : met.contacts) EXPECT_TRUE(contacts.emplace(contact.a, contact.b).second);
  std::vector<test::Contact> expected;
  std::array<std::uint64_t, 3> counts{};
  bool is_whole = true;
  const std::set<std::uint32_t> near_a(met.near_a.begin(), met.near_a.end()),
      near_b(met.near_b.begin(), met.near_b.end());
  EXPECT_TRUE(std::is_sorted(met.near_a.begin(), met.near_a.end()) &&
              std::is_sorted(met.near_b.begin(), met.near_b.end()));
  std::set<std::uint32_t> expected_a, expected_b;
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    for (std::uint32_t j = 0; j < b.size(); ++j) {
      const auto vertex_contact = clash::find_vertex_contact(a.triangle(i), b.triangle(j), within);
      if (const auto kind = test::kind_of({a.triangle(i), b.triangle(j)})) {
        ++counts[static_cast<std::size_t>(*kind)];
        expected.push_back({0, 1, i, j, static_cast<std::uint32_t>(*kind)});
        if (!vertex_contact || !vertex_contact->is_one_point) {
          EXPECT_TRUE(contacts.contains({i, j})) << i << ' ' << j;
        }
      }
      const bool is_near =
          oracle::square_distance(a.triangle(i), b.triangle(j)) <= mpq_class(within) * mpq_class(within);
      if (is_near) expected_a.insert(i), expected_b.insert(j);
      if (!is_near || near.contains({i, j})) continue;
      is_whole = false;
      if (longest_edge(a.triangle(i)) <= 4 * within && longest_edge(b.triangle(j)) <= 4 * within) continue;
      ASSERT_TRUE(vertex_contact) << i << ' ' << j;
      EXPECT_TRUE(met.of_a.at(i, vertex_contact->corner_a) && met.of_b.at(j, vertex_contact->corner_b));
    }
  }
  EXPECT_EQ(near_a, expected_a);
  EXPECT_EQ(near_b, expected_b);
  EXPECT_EQ(met.is_whole, is_whole);
  EXPECT_EQ(met.counts, counts);
  EXPECT_EQ(full.counts, counts);
  std::vector<test::Contact> all;
  for (const exact::Contact& c : full.contacts) all.push_back({0, 1, c.a, c.b, static_cast<std::uint32_t>(c.kind)});
  EXPECT_EQ(all, expected);
}

TEST(ContactPairs, OfFansIsWhatBruteForceFinds) {
  test::Seeded seeded(3);
  const double heights[][2] = {{0, 0}, {1, -1}, {0.25, 0.25}, {0, 0x1p-10}};
  for (const auto& [height_a, height_b] : heights) {
    for (const double turn : {0.0, 0.37}) {
      for (const bool moved : {false, true}) {
        const Pose pose = moved ? scenes::random_motion(seeded.random, 10) : Pose{};
        // Turned and put off in two steps, so that the middles differ by a rounding.
        const Mesh a = test::mesh_of(fan(17, 1, 0, height_a)), b = test::mesh_of(fan(13, 1.25, turn, height_b));
        const Mesh turned = a.transformed({.m = pose.R}).value();
        for (const double within : {0.0, 0x1p-20, 0x1p-6})
          ASSERT_NO_FATAL_FAILURE(expect_all({turned, {.t = pose.t}}, {b, pose}, within));
      }
    }
  }
}

/// Of 90,000 pairs about one vertex, no more are kept than there are triangles, a few times.
TEST(ContactPairs, OfManyTrianglesAboutOneVertexKeepsFew) {
  const Mesh a = test::mesh_of(fan(300, 1, 0, 0)), b = test::mesh_of(fan(300, 0.8, 0.37, 0));
  const ContactPairs met = find_contact_pairs(Fan{a, {}}.body(), Fan{b, {}}.body(), {0x1p-20});
  EXPECT_EQ(met.counts, (std::array<std::uint64_t, 3>{0, 0, 90000}));
  EXPECT_LE(met.near.size(), 3600u);
  EXPECT_LE(met.contacts.size(), 3600u);
}

/// Sheets of cells of 1 and 1.25 and 6, small and large beside the tolerance.
TEST(ContactPairs, OfSmallTrianglesIsWhatBruteForceFinds) {
  test::Seeded seeded(5);
  const scenes::MeshData fine = scenes::flat_grid(4, 4), other = scenes::scaled(scenes::flat_grid(3, 3), 1.25, 1.25, 1),
                         coarse = scenes::scaled(scenes::flat_grid(1, 2), 6, 6, 1);
  for (const double within : {0.31, 0.5, 1.7}) {
    const Pose pose = scenes::random_motion(seeded.random, 10);
    for (const double height : {0.0, 0.3}) {
      const Mesh above = test::mesh_of(scenes::shifted(other, 0.37, 0.21, height));
      ASSERT_NO_FATAL_FAILURE(expect_all({test::mesh_of(fine), pose}, {above, pose}, within));
      ASSERT_NO_FATAL_FAILURE(expect_all({test::mesh_of(coarse), pose}, {above, pose}, within));
      ASSERT_NO_FATAL_FAILURE(expect_all({above, pose}, {test::mesh_of(coarse), pose}, within));
    }
  }
}

/// Of more than 500,000 pairs of triangles within a tolerance of four of their edges, none is kept.
TEST(ContactPairs, OfSmallTrianglesKeepsNoPairs) {
  const Mesh a = test::mesh_of(scenes::flat_grid(60, 60)),
             b = test::mesh_of(scenes::shifted(scenes::flat_grid(60, 60), 0.3, 0.2, 0.5));
  const ContactPairs met = find_contact_pairs(Fan{a, {}}.body(), Fan{b, {}}.body(), {4.0});
  EXPECT_TRUE(met.near.empty());
  EXPECT_EQ(met.near_a.size(), a.triangle_count());
  EXPECT_EQ(met.near_b.size(), b.triangle_count());
  EXPECT_FALSE(met.is_whole);
}

}  // namespace
}  // namespace impinge
