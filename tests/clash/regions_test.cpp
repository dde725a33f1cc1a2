// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/regions.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "clash/regions/regions.hpp"
#include "clash/regions/shared_part.hpp"
#include "core/stopped.hpp"
#include "impinge/collide.hpp"
#include "pipeline/mesh_state.hpp"
#include "region_scenes.hpp"
#include "same_clashes.hpp"
#include "scenes/motion.hpp"
#include "scenes/solids.hpp"

/// What holds of the regions between any two meshes.
namespace impinge {
namespace {

using test::regions_between;

void expect_same(const std::vector<Region>& expected, const std::vector<Region>& found) {
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < found.size(); ++i) test::expect_same(expected[i], found[i]);
}

/// Which triangles make up each region, in an order of their own.
using Partition = std::multiset<std::array<std::vector<std::uint32_t>, 2>>;

Partition partition_of(const std::vector<Region>& regions) {
  Partition partition;
  for (const Region& r : regions) partition.insert({r.triangles_a, r.triangles_b});
  return partition;
}

/// By trying every two pairs. For meshes that are not closed, which join nothing through their insides.
Partition brute_force(const std::vector<Triangle>& as, const std::vector<Triangle>& bs,
                      const std::vector<TrianglePair>& pairs) {
  const auto are_near = [](const Triangle& s, const Triangle& t) {
    return std::any_of(s.begin(), s.end(), [&](const Point& p) { return std::find(t.begin(), t.end(), p) != t.end(); });
  };
  const auto corners = [&](const TrianglePair& pair) {
    std::vector<Point> points;
    const clash::SharedPart part = clash::shared_part(as[pair.a], bs[pair.b]);
    for (std::size_t i = 0; i < part.size; ++i) points.push_back(part.corners[i].point);
    return points;
  };
  std::vector<std::vector<Point>> shared;
  for (const TrianglePair& pair : pairs) shared.push_back(corners(pair));
  std::vector<std::size_t> group(pairs.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const bool near = are_near(as[pairs[i].a], as[pairs[j].a]) && are_near(bs[pairs[i].b], bs[pairs[j].b]);
      const bool touch =
          std::find_first_of(shared[i].begin(), shared[i].end(), shared[j].begin(), shared[j].end()) != shared[i].end();
      if (near || touch) std::replace(group.begin(), group.end(), std::size_t{group[i]}, std::size_t{group[j]});
    }
  Partition partition;
  for (std::size_t g = 0; g < pairs.size(); ++g) {
    std::array<std::set<std::uint32_t>, 2> members;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (group[i] == g) members[0].insert(pairs[i].a), members[1].insert(pairs[i].b);
    if (members[0].empty()) continue;
    partition.insert({std::vector(members[0].begin(), members[0].end()), {members[1].begin(), members[1].end()}});
  }
  return partition;
}

void expect_sound(const std::vector<Region>& regions, std::size_t pairs) {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const Region& r = regions[i];
    sum += r.pairs;
    EXPECT_TRUE(std::isfinite(r.area) && std::isfinite(r.length) && r.area >= 0 && r.length >= 0);
    const double size = norm(r.normal);
    EXPECT_TRUE(size == 0 || std::abs(size - 1) < 1e-14) << size;
    EXPECT_TRUE(!is_empty(Box{r.box[0], r.box[1]}));
    for (const auto& line : r.lines) {
      EXPECT_GE(line.size(), 2u);
      for (const Point& p : line) EXPECT_TRUE(overlap(Box{p, p}, {r.box[0], r.box[1]}));
    }
    EXPECT_GE(regions[i == 0 ? 0 : i - 1].area, r.area);
  }
  EXPECT_EQ(sum, pairs);
}

/// Lines are made by the points alone, so they are the same bit for bit; sums are taken in another order.
void expect_exchanged(std::vector<Region> found, std::vector<Region> exchanged) {
  ASSERT_EQ(found.size(), exchanged.size());
  for (Region& r : exchanged) std::swap(r.triangles_a, r.triangles_b);
  const auto by_triangles = [](const Region& x, const Region& y) {
    return std::tie(x.triangles_a, x.triangles_b, x.pairs) < std::tie(y.triangles_a, y.triangles_b, y.pairs);
  };
  std::sort(found.begin(), found.end(), by_triangles);
  std::sort(exchanged.begin(), exchanged.end(), by_triangles);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Region &x = found[i], &y = exchanged[i];
    EXPECT_EQ(x.triangles_a, y.triangles_a);
    EXPECT_EQ(x.triangles_b, y.triangles_b);
    EXPECT_EQ(x.box, y.box);
    const double size = norm(x.box[1] - x.box[0]);
    EXPECT_NEAR(x.area, y.area, 1e-11 * (x.area + size * size));
    EXPECT_NEAR(x.length, y.length, 1e-12 * (x.length + size));
    EXPECT_TRUE(x.lines == y.lines);
  }
}

TEST(Regions, HoldOfHardMeshesWhatBruteForceSays) {
  test::Seeded seeded(31);
  for (const auto& [name, scene] : test::hard_scenes(seeded.random, 40)) {
    SCOPED_TRACE(name);
    const Mesh a = test::mesh_of(scene.meshes[scene.objects[0].mesh]),
               b = test::mesh_of(scene.meshes[scene.objects[1].mesh]);
    const Pose &pose_a = scene.objects[0].pose, &pose_b = scene.objects[1].pose;
    const Contacts contacts = collide(a, pose_a, b, pose_b).value();
    const auto regions = contact_regions(a, pose_a, b, pose_b).value();
    expect_sound(regions, contacts.triangles.size());
    expect_exchanged(regions, contact_regions(b, pose_b, a, pose_a).value());
    for (const int threads : {1, 2, 5})
      expect_same(regions, contact_regions(a, pose_a, b, pose_b, {.threads = threads}).value());
    const Partition expected =
        brute_force(test::world_triangles(a, pose_a), test::world_triangles(b, pose_b), contacts.triangles);
    EXPECT_TRUE(partition_of(regions) == expected);
    if (testing::Test::HasFailure()) return;
  }
}

/// Normals turn round with the arguments.
TEST(Regions, TurnRoundWhenExchanged) {
  test::Seeded seeded(32);
  const scenes::MeshData knot = scenes::torus_knot_of(3162), sphere = scenes::uv_sphere(30, 20, 1.2);
  for (int i = 0; i < 10; ++i) {
    const Pose pose = scenes::random_motion(seeded.random, 2);
    const auto found = regions_between(knot, sphere, {}, pose), exchanged = regions_between(sphere, knot, pose, {});
    expect_exchanged(found, exchanged);
    ASSERT_EQ(found.size(), exchanged.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      test::expect_near(found[k].normal, -1.0 * exchanged[k].normal, 1e-9);
      test::expect_near(found[k].centroid, exchanged[k].centroid, 1e-9);
    }
  }
}

/// A power of two carries everything along bit for bit.
TEST(Regions, ScaleWithTheirMeshes) {
  const scenes::MeshData a = scenes::uv_sphere(20, 15),
                         b = scenes::shifted(scenes::box({0, 0, 0}, {1, 1, 1}, 3), 0.5, 0.25, 0.1);
  const auto expected = regions_between(a, b);
  ASSERT_FALSE(expected.empty());
  for (const int power : {-200, -100, 100, 290}) {
    const double s = std::ldexp(1.0, power);
    std::vector<Region> found = regions_between(scenes::scaled(a, s, s, s), scenes::scaled(b, s, s, s));
    for (Region& r : found) {
      r.area = r.area / s / s, r.length /= s;
      for (Point* p : {&r.box[0], &r.box[1], &r.centroid}) *p = (1 / s) * *p;
      for (auto& line : r.lines)
        for (Point& p : line) p = (1 / s) * p;
    }
    SCOPED_TRACE(power);
    expect_same(expected, found);
  }
}

TEST(Regions, NamesWhatIsWrong) {
  const Mesh cube = test::mesh_of(scenes::cube()), none = test::mesh_of({});
  const auto code_of = [](const Result<std::vector<Region>>& result) {
    EXPECT_FALSE(result);
    return result.error().code;
  };
  Pose bad, far;
  bad.R[0] = 5;
  far.t = {0x1p301, 0, 0};
  EXPECT_EQ(code_of(contact_regions(cube, bad, cube, {})), Code::bad_pose);
  EXPECT_EQ(code_of(contact_regions(cube, {}, cube, far)), Code::out_of_range);
  const auto fine = contact_regions(cube, {}, cube, {.t = {0x1p-359, 0, 0}});
  EXPECT_EQ(code_of(fine), Code::out_of_range);
  EXPECT_TRUE(fine.error().message.starts_with("object 1 has coordinates on which this answer would not be exact"));
  EXPECT_EQ(code_of(contact_regions(cube, {}, cube, {}, {.threads = -1})), Code::bad_option);
  std::stop_source stopped;
  stopped.request_stop();
  EXPECT_EQ(code_of(contact_regions(cube, {}, cube, {}, {.stop = stopped.get_token()})), Code::cancelled);
  for (const auto& result : {contact_regions(none, {}, cube, {}), contact_regions(cube, {}, cube, {.t = {5, 0, 0}})})
    EXPECT_TRUE(result.value().empty());
}

/// Stopped at the start of the first step that threads share, and of the second.
TEST(Regions, AreNotFoundOnceStopped) {
  const scenes::MeshData sheet = scenes::flat_grid(12, 12);
  const Mesh sheets = test::mesh_of(scenes::joined(sheet, scenes::shifted(sheet, 0, 0, 1)));
  const solid::Body body = solid::make_body(sheets.state().placed({}));
  const solid::Part part = solid::make_part(body, solid::examine(body), false);
  const auto contacts = clash::contacts_within(body, body, 1e-6, 1 << 20);
  const auto regions_if_stopped_at = [&](int step) {
    std::stop_source stop;
    const ForEach in_turn = [&](std::size_t n, const auto& each) {
      if (step-- == 0) stop.request_stop();
      for (std::size_t i = 0; i < n; ++i) each(i);
    };
    return clash::regions_of(part, part, contacts.value(), 1e-6, in_turn, stop.get_token()).size();
  };
  EXPECT_THROW(regions_if_stopped_at(0), Stopped);
  EXPECT_THROW(regions_if_stopped_at(1), Stopped);
  EXPECT_EQ(regions_if_stopped_at(2), 2u);
}

TEST(Regions, OfAHundredThousandPairs) {
  const auto expect = [](const scenes::MeshData& a, const scenes::MeshData& b, const Pose& pose) {
    const Mesh mesh_a = test::mesh_of(a), mesh_b = test::mesh_of(b);
    expect_sound(contact_regions(mesh_a, {}, mesh_b, pose).value(),
                 collide(mesh_a, {}, mesh_b, pose).value().triangles.size());
  };
  expect(scenes::box({0, 0, 0}, {1, 1, 1}, 110), scenes::box({0.1, 0.2, 1}, {1.1, 1.2, 2}, 130), {});
  expect(scenes::uv_sphere(20000, 12), scenes::uv_sphere(17001, 12), {.t = {0, 0, 1}});
  expect(scenes::bumpy_grid(150, 150, 0.01), scenes::bumpy_grid(150, 150, 0.0101), {.t = {0.003, 0.001, 0.0005}});
}

}  // namespace
}  // namespace impinge
