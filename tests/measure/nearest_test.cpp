// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "measure/nearest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "measure/pair_walk.hpp"
#include "pipeline/mesh_state.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/instruction_sets.hpp"
#include "tests/core/support.hpp"
#include "tests/measure/exact_distance.hpp"

namespace impinge {
namespace {

using hierarchy::PlacedTree;

/// Two bodies and the exact square of every triangle pair's distance.
class Bodies {
 public:
  Bodies(const scenes::PlacedScene& scene, std::uint32_t leaf_size = 4)
      : meshes_(test::meshes_of(scene, leaf_size)), objects_(scene.objects) {
    for (const int side : {0, 1})
      world_[side] = test::world_triangles(mesh(side), objects_[static_cast<std::size_t>(side)].pose);
    for (const Triangle& a : world_[0])
      for (const Triangle& b : world_[1]) squares_.push_back(oracle::square_distance(a, b));
  }

  [[nodiscard]] const Mesh& mesh(int side) const { return meshes_[objects_[static_cast<std::size_t>(side)].mesh]; }
  [[nodiscard]] const std::vector<Triangle>& world(int side) const { return world_[side]; }
  [[nodiscard]] PlacedTree placed(int side) const {
    const MeshState& state = mesh(side).state();
    return {&state.data, &state.wide_tree, objects_[static_cast<std::size_t>(side)].pose};
  }
  [[nodiscard]] const mpq_class& square(std::size_t a, std::size_t b) const {
    return squares_[a * world_[1].size() + b];
  }
  [[nodiscard]] const mpq_class& least() const { return *std::min_element(squares_.begin(), squares_.end()); }

 private:
  std::vector<Mesh> meshes_;
  std::vector<scenes::PlacedObject> objects_;
  std::vector<Triangle> world_[2];
  std::vector<mpq_class> squares_;
};

/// The largest coordinate as seen from some corner: what rounding is a part of.
double extent(const Bodies& bodies) {
  double most = 0;
  for (const int side : {0, 1})
    for (const Triangle& t : bodies.world(side))
      for (const Vec3& corner : t) most = std::max(most, max_component(abs(corner - bodies.world(0)[0][0])));
  return most;
}

void expect_nearest(const Bodies& bodies, double error_limit) {
  const auto found = measure::nearest_pair(bodies.placed(0), bodies.placed(1), kInfinity);
  ASSERT_TRUE(found);
  const mpq_class& exact = bodies.least();
  EXPECT_TRUE(oracle::is_within(exact, found->distance, found->error))
      << found->distance << " +- " << found->error << ", not " << std::sqrt(exact.get_d());
  EXPECT_EQ(found->distance == 0, exact == 0);
  EXPECT_LE(found->error, error_limit);
  EXPECT_TRUE(oracle::is_within(bodies.square(found->triangle_a, found->triangle_b), found->distance, found->error));
  // The points are where they are said to be, up to the rounding of their own coordinates.
  double largest = 0;
  for (const Vec3& p : {found->a, found->b}) largest = std::max(largest, max_component(abs(p)));
  const double slack = 0x1p-50 * largest + 0x1p-44 * extent(bodies);
  EXPECT_NEAR(norm((1 / slack) * (found->b - found->a)), found->distance / slack, 4);
  EXPECT_TRUE(oracle::is_within(
      oracle::square_distance({found->a, found->a, found->a}, bodies.world(0)[found->triangle_a]), 0, slack));
  EXPECT_TRUE(oracle::is_within(
      oracle::square_distance({found->b, found->b, found->b}, bodies.world(1)[found->triangle_b]), 0, slack));
}

void expect_near_pairs(const Bodies& bodies, double within) {
  std::vector<TrianglePair> pairs;
  const auto take = [&](const TrianglePair& pair) { return pairs.push_back(pair), true; };
  measure::near_pairs(bodies.placed(0), bodies.placed(1), within, take);
  std::vector<char> has(bodies.world(0).size() * bodies.world(1).size());
  const mpq_class limit = mpq_class(within) * mpq_class(within);
  const mpq_class wide = mpq_class(within) + mpq_class(0x1p-33 * extent(bodies));
  for (const TrianglePair& pair : pairs) {
    char& there = has[pair.a * bodies.world(1).size() + pair.b];
    EXPECT_FALSE(there) << "twice";
    there = true;
    EXPECT_LE(bodies.square(pair.a, pair.b), wide * wide) << "too far";
  }
  for (std::size_t a = 0; a < bodies.world(0).size(); ++a)
    for (std::size_t b = 0; b < bodies.world(1).size(); ++b)
      if (bodies.square(a, b) <= limit) {
        EXPECT_TRUE(has[a * bodies.world(1).size() + b]) << a << ' ' << b;
      }
}

void expect_limits_are_kept(const Bodies& bodies) {
  const auto found = measure::nearest_pair(bodies.placed(0), bodies.placed(1), kInfinity);
  const double d = found->distance;
  const auto ask = [&](double within) { return measure::nearest_pair(bodies.placed(0), bodies.placed(1), within); };
  EXPECT_TRUE(ask(d + 2 * found->error));
  if (d > 4 * found->error) {
    EXPECT_FALSE(ask(d - 2 * found->error));
  }
  const auto quick = measure::nearest_pair(bodies.placed(0), bodies.placed(1), kInfinity, 2 * d + 1e-3);
  ASSERT_TRUE(quick);
  EXPECT_LT(quick->distance, 2 * d + 1e-3);
}

/// Of every two leaves: a pair of triangles that are the nearest is listed, and no bound is above the exact distance.
void expect_nearest_of_leaves(const Bodies& bodies) {
  const PlacedTree first = bodies.placed(0), second = bodies.placed(1);
  const measure::PairWalk walk(first, second);
  const auto is_bound = [&](double lower, const mpq_class& square) {
    return lower <= 0 || mpq_class(lower) * mpq_class(lower) <= square;
  };
  std::vector<measure::NearTriangles> near;
  std::vector<measure::NodePair> open{walk.roots()};
  while (!open.empty()) {
    measure::NodePair pair = open.back();
    open.pop_back();
    walk.reach(pair);
    if (!pair.a.is_leaf() || !pair.b.is_leaf()) {
      walk.open(pair, kInfinity, open);
      continue;
    }
    const auto &a = pair.a.leaf(), &b = pair.b.leaf();
    const auto square = [&](std::uint32_t i, std::uint32_t j) -> const mpq_class& {
      return walk.is_swapped() ? bodies.square(b.ids()[j], a.ids()[i]) : bodies.square(a.ids()[i], b.ids()[j]);
    };
    mpq_class least = square(0, 0);
    for (std::uint32_t i = 0; i < a.count; ++i)
      for (std::uint32_t j = 0; j < b.count; ++j) least = std::min(least, square(i, j));
    EXPECT_TRUE(is_bound(pair.lower, least)) << pair.lower << " above " << std::sqrt(least.get_d());
    for (const double limit : {std::sqrt(least.get_d()) * (1 + 0x1p-40), kInfinity}) {
      walk.open_leaves(pair, limit, measure::Wanted::nearest, near);
      bool has_nearest = false;
      for (const auto& [lower, i, j] : near) {
        EXPECT_TRUE(is_bound(walk.world_length(lower), square(i, j)))
            << walk.world_length(lower) << " above " << std::sqrt(square(i, j).get_d());
        has_nearest |= square(i, j) == least;
      }
      EXPECT_TRUE(has_nearest) << "within " << limit << " none of " << near.size() << " is the nearest";
    }
  }
}

/// Everything on a scene, on every instruction set.
void expect_all(const scenes::PlacedScene& scene, std::uint32_t leaf_size) {
  const Bodies bodies(scene, leaf_size);
  const double d = std::sqrt(bodies.least().get_d()), size = extent(bodies);
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    ASSERT_NO_FATAL_FAILURE(expect_nearest(bodies, 0x1p-33 * size));
    ASSERT_NO_FATAL_FAILURE(expect_limits_are_kept(bodies));
    expect_nearest_of_leaves(bodies);
    ASSERT_FALSE(testing::Test::HasFailure());
    for (const double within : {0.0, d, 1.1 * d, d + 0.01 * size, d + 0.2 * size})
      ASSERT_NO_FATAL_FAILURE(expect_near_pairs(bodies, within));
  }
}

TEST(NearestPair, IsTheExactOneOfHardScenes) {
  test::Seeded seeded(1);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 14)) {
    SCOPED_TRACE(named.name);
    ASSERT_NO_FATAL_FAILURE(expect_all(named.scene, 3));
  }
}

scenes::PlacedScene apart(scenes::PlacedScene scene, const Vec3& by) {
  scene.objects[1].pose.t[0] += by.x, scene.objects[1].pose.t[1] += by.y, scene.objects[1].pose.t[2] += by.z;
  return scene;
}

TEST(NearestPair, IsTheExactOneOfBodiesApart) {
  test::Seeded seeded(2);
  scenes::Random& random = seeded.random;
  const double gaps[] = {1e-9, 1e-3, 0.3, 3, 40, 1e4, 1e7, 1e12, 1e19};
  for (const double gap : gaps)
    for (int family = 0; family < 5; ++family) {
      SCOPED_TRACE(testing::Message() << "gap " << gap << ", family " << family);
      const auto soup = [&] {
        switch (family) {
          case 0:
            return scenes::triangle_soup(random, 15, 0.5);
          case 1:
            return scenes::sliver_soup(random, 15);
          case 2:
            return scenes::degenerate_soup(random, 15, 2);
          case 3:
            return scenes::flat_grid(3, 2);
          default:
            return scenes::cube();
        }
      };
      const auto direction = [&] { return family >= 3 ? Vec3{0, 0, 1} : Vec3{0.6, 0.64, 0.48}; };
      const scenes::PlacedScene scene = apart(scenes::pair_scene(soup(), soup()), (1.5 + gap) * direction());
      ASSERT_NO_FATAL_FAILURE(expect_all(scene, 2));
    }
}

/// Few large triangles, which are one leaf, and many small ones beside the inside of one of them: nodes of the small
/// mesh are held against the large triangles themselves.
TEST(NearestPair, IsTheExactOneOfSmallTrianglesNearLargeOnes) {
  test::Seeded seeded(4);
  scenes::Random& random = seeded.random;
  for (int i = 0; i < 60; ++i) {
    const double width = std::ldexp(1.0, -random.integer(0, 24)), size = std::ldexp(1.0, -random.integer(1, 20));
    const scenes::MeshData large =
        i % 2 == 0 ? scenes::sliver_soup(random, 8, width) : scenes::triangle_soup(random, 8, 1);
    scenes::MeshData small = i % 3 == 0 ? scenes::sliver_soup(random, 30) : scenes::triangle_soup(random, 30, 0.5);
    small = scenes::scaled(std::move(small), size, size, size);
    scenes::PlacedScene scene = i % 5 < 3 ? scenes::pair_scene(large, small) : scenes::pair_scene(small, large);
    for (auto& object : scene.objects) object.pose = scenes::random_motion(random, i % 4 == 0 ? 1e6 : 1);
    // The small one's origin comes to a point of a large triangle, and off it by a part of its size or by nothing.
    const std::size_t of_large = i % 5 < 3 ? 0 : 1;
    const Mesh mesh = test::mesh_of(large);
    const Triangle t = test::world_triangles(mesh, scene.objects[of_large].pose)[i % 8];
    const double s = random.unit(), r = random.unit() * (1 - s), off = i % 7 == 0 ? 0 : size * random.uniform(-3, 3);
    const Vec3 at = t[0] + s * (t[1] - t[0]) + r * (t[2] - t[0]) + off * Vec3{0.6, 0.64, 0.48};
    scene.objects[1 - of_large].pose.t = {at.x, at.y, at.z};
    SCOPED_TRACE(testing::Message() << "case " << i << ", width " << width << ", size " << size);
    ASSERT_NO_FATAL_FAILURE(expect_all(scene, 8));
  }
}

TEST(NearestPair, IsTheExactOneOfOneTriangleEach) {
  test::Seeded seeded(3);
  for (int i = 0; i < 150; ++i) {
    const double width = std::pow(10.0, seeded.random.uniform(-14, 0));
    const scenes::PlacedScene scene = apart(
        scenes::pair_scene(scenes::sliver_soup(seeded.random, 1, width), scenes::triangle_soup(seeded.random, 1, 1)),
        {seeded.random.uniform(0, 2), 0, 0});
    const Bodies bodies(scene);
    ASSERT_NO_FATAL_FAILURE(expect_nearest(bodies, 1e-11));
  }
}

void expect_nearest(const Mesh& mesh, const Pose& pose, const std::vector<Triangle>& world, const Vec3& p) {
  std::vector<mpq_class> squares;
  for (const Triangle& t : world) squares.push_back(oracle::square_distance({p, p, p}, t));
  const mpq_class& least = *std::min_element(squares.begin(), squares.end());
  const hierarchy::PlacedTree placed{&mesh.state().data, &mesh.state().wide_tree, pose};
  const auto found = measure::nearest_point(placed, p, kInfinity);
  ASSERT_TRUE(found);
  EXPECT_TRUE(oracle::is_within(least, found->distance, found->error))
      << found->distance << " +- " << found->error << ", not " << std::sqrt(least.get_d());
  EXPECT_EQ(found->distance == 0, least == 0);
  EXPECT_TRUE(oracle::is_within(squares[found->triangle], found->distance, found->error));
  double size = 0;
  for (const Triangle& t : world)
    for (const Vec3& corner : t) size = std::max(size, max_component(abs(corner - p)));
  EXPECT_LE(found->error, 0x1p-33 * size);
  const Vec3& q = found->point;
  EXPECT_TRUE(oracle::is_within(oracle::square_distance({q, q, q}, world[found->triangle]), 0,
                                0x1p-44 * size + 0x1p-50 * max_component(abs(q))));
  EXPECT_TRUE(measure::nearest_point(placed, p, found->distance + 2 * found->error));
  if (found->distance > 4 * found->error) {
    EXPECT_FALSE(measure::nearest_point(placed, p, found->distance - 2 * found->error));
  }
  const auto quick = measure::nearest_point(placed, p, kInfinity, 2 * found->distance);
  ASSERT_TRUE(quick);
  EXPECT_LE(quick->distance, 2 * found->distance);
  const double within = 2 * found->distance + 2 * found->error;
  std::vector<std::uint32_t> near;
  measure::near_triangles(placed, p, within, [&](std::uint32_t t) { near.push_back(t); });
  std::sort(near.begin(), near.end());
  EXPECT_TRUE(std::adjacent_find(near.begin(), near.end()) == near.end());
  for (std::uint32_t t = 0; t < world.size(); ++t)
    if (oracle::is_within(squares[t], 0, within)) {
      EXPECT_TRUE(std::binary_search(near.begin(), near.end(), t));
    }
}

TEST(NearestPoint, IsTheExactOneOfHardScenes) {
  test::Seeded seeded(4);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 20)) {
    SCOPED_TRACE(named.name);
    const std::vector<Mesh> meshes = test::meshes_of(named.scene, 3);
    const auto& [a, b] = std::pair(named.scene.objects[0], named.scene.objects[1]);
    const auto world = test::world_triangles(meshes[a.mesh], a.pose);
    // Corners of the other, which often touch; points between; and points that are far.
    const auto others = test::world_triangles(meshes[b.mesh], b.pose);
    for (std::size_t i = 0; i < others.size(); i += 3) {
      const Vec3 corner = others[i][0], between = 0.5 * (corner + world[i % world.size()][1]);
      for (const Vec3& p : {corner, between, 3.0 * corner, world[i % world.size()][2]})
        ASSERT_NO_FATAL_FAILURE(expect_nearest(meshes[a.mesh], a.pose, world, p));
    }
  }
}

/// On its own corners a body is at 0, wherever it stands: far from the origin these are rounded to places outside of
/// the tree's boxes, and so is the point where it is brought into a box's frame in single precision.
TEST(NearestPoint, OnTheBodyIsNotPassedOver) {
  test::Seeded seeded(5);
  for (const double away : {0.0, 1.0, 1e3, 1e6, 1e9, 1e12}) {
    SCOPED_TRACE(away);
    const Mesh mesh = test::mesh_of(scenes::triangle_soup(seeded.random, 200, 0.3), 2);
    Pose pose = scenes::random_motion(seeded.random, 1);
    pose.t[0] += away, pose.t[1] -= 0.7 * away;
    const hierarchy::PlacedTree placed{&mesh.state().data, &mesh.state().wide_tree, pose};
    for (const Triangle& triangle : test::world_triangles(mesh, pose))
      for (const Vec3& corner : triangle) {
        const auto found = measure::nearest_point(placed, corner, 0);
        ASSERT_TRUE(found) << corner.x << ' ' << corner.y << ' ' << corner.z;
        EXPECT_EQ(found->distance, 0);
      }
  }
}

TEST(NearestPoint, OfAStoppedSearchIsNone) {
  const Mesh mesh = test::mesh_of(scenes::cube());
  std::stop_source source;
  source.request_stop();
  EXPECT_FALSE(measure::nearest_point({&mesh.state().data, &mesh.state().wide_tree, {}}, {0, 0, 0}, kInfinity, 0,
                                      source.get_token()));
}

TEST(NearestPoint, OfNoTriangleIsNone) {
  const Mesh mesh = test::mesh_of({});
  EXPECT_FALSE(measure::nearest_point({&mesh.state().data, &mesh.state().wide_tree, {}}, {0, 0, 0}, kInfinity));
}

}  // namespace
}  // namespace impinge
