// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// One number decides a pair at every tolerance: properties of public verdicts on solids, damaged solids and surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "core/vec3.hpp"
#include "impinge/clash.hpp"
#include "judged_at_once.hpp"
#include "scenes/damaged.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solid_pairs.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"
#include "tests/solid/plain_winding.hpp"

namespace impinge {
namespace {

using scenes::MeshData;
using scenes::Random;
using test::fails, test::judged_at_once, test::Pair;

struct Extent {
  double largest = 0;  ///< |world coordinate|
  double diagonal = 0;
};
Extent extent_of(const Pair& pair) {
  Vec3 low{kInfinity, kInfinity, kInfinity}, high = -1.0 * low;
  for (const auto& [mesh, pose] : {std::pair(pair.a, pair.pose_a), std::pair(pair.b, pair.pose_b)})
    for (const Point& vertex : mesh.vertices()) {
      const Vec3 world = world_vertex(pose, vertex);
      low = min(low, world), high = max(high, world);
    }
  return {max_component(max(abs(low), abs(high))), norm(high - low)};
}

/// 0, what rounding leaves of the coordinates, and so on to a tenth of both parts.
std::vector<double> ladder(const Extent& extent) {
  constexpr int kSteps = 11;
  const double least = 0x1p-42 * extent.largest, most = extent.diagonal / 10;
  std::vector<double> tolerances{0};
  for (int i = 0; i < kSteps; ++i)
    tolerances.push_back(std::max(least, least * std::pow(most / least, i / (kSteps - 1.0))));
  return tolerances;
}

Clash judged(const Pair& pair, std::optional<double> tolerance, double precision = 0.05) {
  const ClashOptions options{.tolerance = tolerance, .depth_precision = precision, .threads = 1};
  return judge(pair.a, pair.pose_a, pair.b, pair.pose_b, options).value();
}

void expect_monotone(const std::vector<double>& tolerances, const std::vector<Clash>& clashes) {
  for (std::size_t i = 0; i < clashes.size(); ++i) {
    EXPECT_EQ(fails(clashes[i]), tolerances[i] < clashes[i].fails_below) << "at " << tolerances[i];
    if (i > 0) {
      EXPECT_LE(fails(clashes[i]), fails(clashes[i - 1])) << "at " << tolerances[i];
    }
  }
}

/// An interval that holds the tolerance below which a pair fails.
Interval number_of(const Clash& clash) {
  const double most =
      clash.overlap_depth ? std::max(clash.overlap_depth->a_in_b.hi, clash.overlap_depth->b_in_a.hi) : 0;
  return {clash.fails_below, std::max(clash.fails_below, most)};
}

/// Returns how many tolerances were decided as failing.
int expect_one_number(const Pair& pair) {
  const testing::ScopedTrace trace(__FILE__, __LINE__, pair.name);
  const std::vector<double> tolerances = ladder(extent_of(pair));
  const std::vector<Clash> at_once = judged_at_once(pair, {tolerances.begin(), tolerances.end()}).value();
  expect_monotone(tolerances, at_once);
  for (std::size_t i = 2; i < at_once.size(); ++i)
    EXPECT_TRUE(!fails(at_once[i]) || at_once[i].fails_below == at_once[1].fails_below);
  std::vector<Clash> alone;
  for (const double tolerance : tolerances) alone.push_back(judged(pair, tolerance));
  expect_monotone(tolerances, alone);

  // What is between the ends of the finer interval may be decided either way.
  const Clash fine = judged(pair, tolerances[1], 1e-3);
  const Interval number = number_of(fine);
  int failing = 0;
  for (std::size_t i = 1; i < tolerances.size(); ++i) {
    failing += fails(alone[i]) ? 1 : 0;
    if (tolerances[i] >= number.lo && tolerances[i] < number.hi) continue;
    const bool expected = tolerances[i] < number.lo;
    for (const auto* clash : {&std::as_const(at_once)[i], &std::as_const(alone)[i]})
      EXPECT_TRUE(fails(*clash) == expected || clash->note == Note::undecided)
          << "at " << tolerances[i] << ", fails below " << number.lo << " to " << number.hi;
  }
  return failing;
}

/// Of each family every so many-th.
std::vector<Pair> sound_pairs(std::size_t stride) {
  std::vector<Pair> pairs;
  const auto add = [&](const std::vector<scenes::SolidPair>& family, std::size_t every) {
    for (std::size_t i = 0; i < family.size(); i += every)
      pairs.push_back({family[i].name, test::mesh_of(family[i].a), test::mesh_of(family[i].b)});
  };
  add(scenes::voxel_pairs(5, 60), stride);
  add(scenes::convex_pairs(5, 60), stride);
  add(scenes::interval_pairs(5), 6 * stride);
  return pairs;
}

/// Both turned at random about places within each other's reach.
Pair pair_of(const std::string& name_a, const MeshData& a, const std::string& name_b, const MeshData& b,
             Random& random) {
  return {name_a + " and " + name_b, test::mesh_of(a), test::mesh_of(b), scenes::random_motion(random, 0.1),
          scenes::random_motion(random, 0.5)};
}

/// Damaged solids of no more than 1000 triangles.
class DamagedPairs {
 public:
  explicit DamagedPairs(std::uint64_t seed) : solids_(scenes::damaged_solids(seed)) {
    std::erase_if(solids_, [](const scenes::DamagedSolid& solid) { return solid.damaged.triangle_count() > 1000; });
  }
  [[nodiscard]] const scenes::DamagedSolid& draw(Random& random) const {
    return solids_[static_cast<std::size_t>(random.integer(0, static_cast<int>(solids_.size()) - 1))];
  }
  [[nodiscard]] Pair draw_pair(Random& random) const {
    const scenes::DamagedSolid &a = draw(random), &b = draw(random);
    return pair_of(a.name, a.damaged, b.name, b.damaged, random);
  }

 private:
  std::vector<scenes::DamagedSolid> solids_;
};

/// Surfaces with each other and with damaged solids.
Pair draw_surfaces(const DamagedPairs& solids, Random& random) {
  static const std::vector<scenes::OpenShape> shapes = scenes::open_shapes();
  const auto draw = [&]() -> const scenes::OpenShape& {
    return shapes[static_cast<std::size_t>(random.integer(0, static_cast<int>(shapes.size()) - 1))];
  };
  const scenes::OpenShape &a = draw(), &b = draw();
  const scenes::DamagedSolid& solid = solids.draw(random);
  return random.integer(0, 1) == 0 ? pair_of(a.name, a.mesh, b.name, b.mesh, random)
                                   : pair_of(a.name, a.mesh, solid.name, solid.damaged, random);
}

TEST(OneNumber, DecidesRandomSolidsAtEveryTolerance) {
  int failing = 0;
  for (const Pair& pair : sound_pairs(3)) failing += expect_one_number(pair);
  EXPECT_GT(failing, 100);
}

TEST(OneNumber, DecidesDamagedSolidsAtEveryTolerance) {
  const DamagedPairs solids(21);
  int failing = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Seeded seeded(seed);
    failing += expect_one_number(solids.draw_pair(seeded.random));
  }
  EXPECT_GT(failing, 50);
}

TEST(OneNumber, DecidesSurfacesAtEveryTolerance) {
  const DamagedPairs solids(22);
  int failing = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    test::Seeded seeded(seed);
    failing += expect_one_number(draw_surfaces(solids, seeded.random));
  }
  EXPECT_GT(failing, 50);
}

Pair moved(const Pair& pair, const Pose& motion) {
  const scenes::PlacedScene scene = scenes::moved({{}, {{.pose = pair.pose_a}, {.pose = pair.pose_b}}}, motion);
  return {pair.name, pair.a, pair.b, scene.objects[0].pose, scene.objects[1].pose};
}

Pair baked(const Pair& pair) {
  const auto bake = [](const Mesh& mesh, const Pose& pose) {
    return mesh.transformed({.m = pose.R, .t = pose.t}).value();
  };
  return {pair.name, bake(pair.a, pair.pose_a), bake(pair.b, pair.pose_b)};
}

std::array<double, 2> radii_of(const Pair& pair) {
  return {examine(pair.a, pair.pose_a)->radius, examine(pair.b, pair.pose_b)->radius};
}

/// A rounded motion moves vertices by no more than some units of their last place. Inner radii, half of which tells
/// what goes through, are those of the mesh's own frame: another pose leaves them as they are; in baked meshes they are
/// found anew, and may tell otherwise. Returns whether they tell the same.
bool expect_stable(const Pair& pair, Random& random) {
  const testing::ScopedTrace trace(__FILE__, __LINE__, pair.name);
  const Pair there = moved(pair, scenes::random_motion(random, 10 * extent_of(pair).diagonal));
  const double delta = 0x1p-48 * extent_of(there).largest;
  const std::vector<double> tolerances = ladder(extent_of(there));
  const Interval number = number_of(judged(pair, tolerances[1], 1e-3));
  const auto expect_same_number = [&](const Pair& other) {
    const Interval moved_number = number_of(judged(other, tolerances[1], 1e-3));
    EXPECT_LE(moved_number.lo, number.hi + 2 * delta);
    EXPECT_LE(number.lo, moved_number.hi + 2 * delta);
    for (std::size_t i = 1; i < tolerances.size(); i += 2) {
      if (tolerances[i] >= number.lo - 2 * delta && tolerances[i] < number.hi + 2 * delta) continue;
      const Clash clash = judged(other, tolerances[i]);
      EXPECT_TRUE(fails(clash) == (tolerances[i] < number.lo) || clash.note == Note::undecided)
          << "at " << tolerances[i] << ", failed below " << number.lo << " to " << number.hi;
    }
  };
  const auto radii = radii_of(pair);
  EXPECT_EQ(radii_of(there), radii);
  expect_same_number(there);
  const Pair anew = baked(there);
  if (std::isinf(number.lo) != std::isinf(judged(anew, tolerances[1], 1e-3).fails_below)) return false;
  expect_same_number(anew);
  return true;
}

TEST(OneNumber, OfSolidsStaysAfterARigidMotion) {
  std::uint64_t seed = 0;
  int baked_alike = 0;
  for (const Pair& pair : sound_pairs(6)) {
    test::Seeded seeded(++seed);
    baked_alike += expect_stable(pair, seeded.random) ? 1 : 0;
  }
  EXPECT_GT(baked_alike, 27);
}

TEST(OneNumber, OfDamagedSolidsAndSurfacesStaysAfterARigidMotion) {
  const DamagedPairs solids(23);
  int baked_alike = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    test::Seeded seeded(seed);
    const Pair pair = seed % 2 == 0 ? solids.draw_pair(seeded.random) : draw_surfaces(solids, seeded.random);
    baked_alike += expect_stable(pair, seeded.random) ? 1 : 0;
  }
  EXPECT_GT(baked_alike, 27);
}

// The oracle for depths: points, dense where they are deep, winding by the plain sum, distance by all triangles.

bool is_inside(const std::vector<Triangle>& triangles, const Vec3& p) {
  return std::abs(test::plain_winding(triangles, p)) > 0.5;
}

/// A part of a triangle, and a box: where deep points are looked for.
struct TrianglePart {
  Triangle corners;
  [[nodiscard]] Vec3 middle() const { return (1.0 / 3) * (corners[0] + corners[1] + corners[2]); }
  [[nodiscard]] double radius() const {
    const Vec3 m = middle();
    return std::max({norm(corners[0] - m), norm(corners[1] - m), norm(corners[2] - m)});
  }
  [[nodiscard]] std::vector<TrianglePart> parts() const {
    const auto& [a, b, c] = corners;
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    return {{{a, ab, ca}}, {{ab, b, bc}}, {{ca, bc, c}}, {{ab, bc, ca}}};
  }
};
struct BoxPart {
  Vec3 low, high;
  [[nodiscard]] Vec3 middle() const { return 0.5 * (low + high); }
  [[nodiscard]] double radius() const { return 0.5 * norm(high - low); }
  [[nodiscard]] std::vector<BoxPart> parts() const {
    const Vec3 m = middle();
    std::vector<BoxPart> result;
    for (int i = 0; i < 8; ++i) {
      const bool x = (i & 1) != 0, y = (i & 2) != 0, z = (i & 4) != 0;
      result.push_back({{x ? m.x : low.x, y ? m.y : low.y, z ? m.z : low.z},
                        {x ? high.x : m.x, y ? high.y : m.y, z ? high.z : m.z}});
    }
    return result;
  }
};

BoxPart box_of(const std::vector<Triangle>& triangles) {
  BoxPart box{triangles.front()[0], triangles.front()[0]};
  for (const Triangle& t : triangles)
    for (const Vec3& p : t) box = {min(box.low, p), max(box.high, p)};
  return box;
}

constexpr double kOracleWidth = 0.01;

/// The depth in a solid of the deepest of some points, from middles of parts that get smaller where deep points may be:
/// `lo` is that of a point, and depths of two points differ by no more than their distance. `material`: only points
/// inside of that too.
template <class Part>
Interval deepest(const std::vector<Part>& parts, const std::vector<Triangle>& outer,
                 const std::vector<Triangle>* material = nullptr) {
  struct Bounded {
    double most;
    Part part;
    bool operator<(const Bounded& other) const { return most < other.most; }
  };
  std::priority_queue<Bounded> open;
  const BoxPart box = box_of(outer);
  double least = 0;
  const auto take = [&](const Part& part) {
    const Vec3 middle = part.middle();
    const double radius = part.radius();
    if (max_component(max(box.low - middle, middle - box.high)) > radius) return;
    const double distance = test::plain_distance(outer, middle);
    if (distance + radius <= least + kOracleWidth) return;
    if (distance > std::min(least, radius)) {
      const bool in_outer = is_inside(outer, middle);
      if (!in_outer && distance > radius) return;
      const bool in_both = in_outer && (material == nullptr || is_inside(*material, middle));
      if (in_both) least = std::max(least, distance);
      if (in_outer && !in_both && test::plain_distance(*material, middle) > radius) return;
    }
    open.push({distance + radius, part});
  };
  for (const Part& part : parts) take(part);
  while (!open.empty() && open.top().most > least + kOracleWidth) {
    const Part part = open.top().part;
    open.pop();
    for (const Part& each : part.parts()) take(each);
  }
  return {least, least + kOracleWidth};
}

Interval depth_of_triangles(const std::vector<Triangle>& inner, const std::vector<Triangle>& outer) {
  std::vector<TrianglePart> parts;
  for (const Triangle& triangle : inner) parts.push_back({triangle});
  return deepest(parts, outer);
}
Interval depth_of_material(const std::vector<Triangle>& inner, const std::vector<Triangle>& outer) {
  return deepest(std::vector<BoxPart>{box_of(inner)}, outer, &inner);
}

/// As the oracle needs them, which takes winding numbers as they come: where triangles were only turned, or doubled,
/// those of the sound solid.
const MeshData& oriented(const scenes::DamagedSolid& solid) { return solid.is_open ? solid.damaged : solid.sound; }

TEST(OneNumber, HoldsTheDepthThatDensePointsFind) {
  const DamagedPairs solids(11);
  int deep = 0, by_inner_points = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const scenes::DamagedSolid &one = solids.draw(random), &other = solids.draw(random);
    const Pair pair = pair_of(one.name, one.damaged, other.name, other.damaged, random);
    SCOPED_TRACE(pair.name);
    const Clash clash = judged(pair, 1e-5);
    const std::vector<Triangle> a = test::world_triangles(test::mesh_of(oriented(one)), pair.pose_a),
                                b = test::world_triangles(test::mesh_of(oriented(other)), pair.pose_b);
    const Clash sound =
        judged({"", test::mesh_of(one.sound), test::mesh_of(other.sound), pair.pose_a, pair.pose_b}, 1e-5);
    const double moved = 2 * (one.damage + other.damage) + 1e-5;
    // What only touches has no depth, or one that the tolerance excuses.
    const OverlapDepth excused{{0, 1e-5}, {0, 1e-5}};
    const OverlapDepth depth = clash.overlap_depth.value_or(excused),
                       depth_of_sound = sound.overlap_depth.value_or(excused);
    const double most = std::max(depth.a_in_b.lo, depth.b_in_a.lo);  // the lesser may be known less precisely
    const auto expect_held = [&](const Interval& found, const std::vector<Triangle>& inner,
                                 const std::vector<Triangle>& outer, const Interval& of_sound) {
      const Interval expected = depth_of_triangles(inner, outer);
      EXPECT_LE(expected.lo, found.hi + 1e-9);
      EXPECT_TRUE(found.hi <= 1.06 * most + 1e-5) << found.lo << " to " << found.hi;
      if (found.lo > expected.hi) {
        // Inner points that count are deeper.
        EXPECT_LE(found.lo, depth_of_material(inner, outer).hi);
        ++by_inner_points;
        return;
      }
      EXPECT_LE(found.lo, of_sound.hi + moved);
      EXPECT_TRUE(of_sound.lo <= found.hi + moved || of_sound.lo > expected.hi);
    };
    expect_held(depth.a_in_b, a, b, depth_of_sound.a_in_b);
    expect_held(depth.b_in_a, b, a, depth_of_sound.b_in_a);
    deep += clash.fails_below > 0.05 ? 1 : 0;
  }
  EXPECT_GT(deep, 20);
  EXPECT_LT(by_inner_points, 25);
}

}  // namespace
}  // namespace impinge
