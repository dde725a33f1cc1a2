// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "broad/may_touch.hpp"
#include "broad/near_pairs.hpp"
#include "paper/sweep_and_prune.hpp"
#include "tests/broad/bodies.hpp"
#include "tests/core/support.hpp"

namespace impinge {

/// By integers, so that borders tie and cases shrink well.
struct Place {
  std::array<int, 3> center, half;
  int radius;
  int group;
};
void showValue(const Place& p, std::ostream& os) {
  os << "center " << p.center[0] << ' ' << p.center[1] << ' ' << p.center[2] << " half " << p.half[0] << ' '
     << p.half[1] << ' ' << p.half[2] << " radius " << p.radius << " group " << p.group;
}

/// Moves the object there, adds it, or removes it (`there` is empty).
struct Placement {
  std::uint32_t object;
  std::optional<Place> there;
};
void showValue(const Placement& step, std::ostream& os) {
  os << step.object << ": ";
  if (step.there) showValue(*step.there, os);
}

}  // namespace impinge

namespace rc {
template <>
struct Arbitrary<impinge::Place> {
  static Gen<impinge::Place> arbitrary() {
    const auto coordinate = gen::inRange(-6, 7);
    const auto half = gen::inRange(0, 4);
    return gen::build<impinge::Place>(gen::set(&impinge::Place::center, gen::container<std::array<int, 3>>(coordinate)),
                                      gen::set(&impinge::Place::half, gen::container<std::array<int, 3>>(half)),
                                      gen::set(&impinge::Place::radius, gen::inRange(0, 6)),
                                      gen::set(&impinge::Place::group, gen::inRange(0, 4)));
  }
};
template <>
struct Arbitrary<impinge::Placement> {
  static Gen<impinge::Placement> arbitrary() {
    return gen::build<impinge::Placement>(
        gen::set(&impinge::Placement::object, gen::inRange<std::uint32_t>(0, 12)),
        gen::set(&impinge::Placement::there,
                 gen::map(gen::maybe(gen::arbitrary<impinge::Place>()), [](const Maybe<impinge::Place>& place) {
                   return place ? std::optional(*place) : std::nullopt;
                 })));
  }
};
}  // namespace rc

namespace impinge {
namespace {

using scene::PlacedObject;
using scene::SceneView;

using test::kSomething;

PlacedObject placed(const Place& place) {
  const auto vec = [](const std::array<int, 3>& v) {
    return Vec3{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  };
  PlacedObject object;
  object.mesh = &kSomething;
  object.group = static_cast<std::uint32_t>(place.group);
  object.sphere = {vec(place.center), static_cast<double>(place.radius)};
  object.box = {vec(place.center) - vec(place.half), vec(place.center) + vec(place.half)};
  return object;
}

/// By pairs of numbers that wrap around.
scene::IgnoredPairs ignoring(const std::vector<std::pair<std::uint8_t, std::uint8_t>>& pairs, std::uint32_t objects) {
  scene::IgnoredPairs ignored;
  for (const auto& [a, b] : pairs)
    if (a % objects != b % objects) ignored.insert(a % objects, b % objects);
  return ignored;
}

broad::ObjectPairs pairs_of(paper::SweepAndPrune& borders, const SceneView& view) {
  broad::ObjectPairs pairs;
  borders.update(view);
  borders.find(view, pairs);
  return pairs;
}

/// Frame by frame, as is and in a copy made before, all against brute force.
RC_GTEST_PROP(NearPairs, FindEveryPairThatBruteForceFinds,
              (const std::vector<std::vector<Placement>>& frames,
               const std::vector<std::pair<std::uint8_t, std::uint8_t>>& ignored_pairs)) {
  const scene::IgnoredPairs ignored = ignoring(ignored_pairs, 12);
  std::vector<PlacedObject> objects(12);
  broad::NearPairs near_pairs;
  paper::SweepAndPrune borders;
  for (const std::vector<Placement>& frame : frames) {
    for (const Placement& step : frame) objects[step.object] = step.there ? placed(*step.there) : PlacedObject{};
    const SceneView view{objects, &ignored};
    const broad::ObjectPairs expected = test::all_pairs(view);
    broad::NearPairs copy = near_pairs;
    test::update(near_pairs, objects);
    RC_ASSERT(test::pairs_of(near_pairs, view) == expected);
    RC_ASSERT(near_pairs.is_current());
    test::update(copy, objects);
    RC_ASSERT(test::pairs_of(copy, view) == expected);
    RC_ASSERT(pairs_of(borders, view) == expected);
  }
}

/// Without a place() for those that stay, and with several for one that moves more than once.
RC_GTEST_PROP(NearPairs, NeedToHearOfChangesOnly, (const std::vector<std::vector<Placement>>& frames)) {
  std::vector<PlacedObject> objects(12);
  broad::NearPairs near_pairs;
  near_pairs.reserve(objects.size());
  for (const std::vector<Placement>& frame : frames) {
    for (const Placement& step : frame) {
      objects[step.object] = step.there ? placed(*step.there) : PlacedObject{};
      near_pairs.place(step.object, objects[step.object]);
    }
    near_pairs.update();
    RC_ASSERT(test::pairs_of(near_pairs, {objects}) == test::all_pairs({objects}));
  }
}

/// What the twin itself promises, by its words.
RC_GTEST_PROP(AllPairs, HoldBoxesAndSpheresAndGroupsAndIgnoredPairs,
              (const std::vector<Place>& places, std::uint8_t ignored_a, std::uint8_t ignored_b)) {
  std::vector<PlacedObject> objects;
  for (const Place& place : places) objects.push_back(placed(place));
  scene::IgnoredPairs ignored;
  if (ignored_a % 8 != ignored_b % 8) ignored.insert(ignored_a % 8, ignored_b % 8);
  const broad::ObjectPairs pairs = test::all_pairs({objects, &ignored});
  auto next = pairs.begin();
  for (std::uint32_t a = 0; a < places.size(); ++a)
    for (std::uint32_t b = a + 1; b < places.size(); ++b) {
      const Place &p = places[a], &q = places[b];
      int square = 0;
      bool meet = p.group == 0 || p.group != q.group;
      for (std::size_t i = 0; i < 3; ++i) {
        const int d = p.center[i] - q.center[i];
        square += d * d;
        meet = meet && std::abs(d) <= p.half[i] + q.half[i];
      }
      meet = meet && square <= (p.radius + q.radius) * (p.radius + q.radius);
      meet = meet && !ignored.contains(a, b);
      const bool found = next != pairs.end() && next->a == a && next->b == b;
      RC_ASSERT(found == meet);
      if (found) ++next;
    }
  RC_ASSERT(next == pairs.end());
}

/// Many frames: slow drift, now and then a jump, an arrival or a departure, at sizes where the borders' insertion sort
/// and its retreat to sorting anew both happen.
TEST(SweepAndPrune, StaysRightOverManyFrames) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    std::vector<PlacedObject> objects(400);
    std::vector<Vec3> velocities(objects.size());
    const auto put = [&](PlacedObject& object, const Vec3& center) { object = test::box_at(center, {0.4, 0.7, 0.2}); };
    const auto anywhere = [&] { return Vec3{random.uniform(0, 8), random.uniform(0, 8), random.uniform(0, 8)}; };
    for (std::size_t i = 0; i < objects.size(); ++i) {
      put(objects[i], anywhere());
      velocities[i] = 0.002 * (anywhere() - Vec3{4, 4, 4});
    }
    paper::SweepAndPrune borders;
    for (int frame = 0; frame < 60; ++frame) {
      for (std::size_t i = 0; i < objects.size(); ++i) {
        if (objects[i].mesh != nullptr) put(objects[i], objects[i].sphere.center + velocities[i]);
        if (random.integer(0, 200) == 0) put(objects[i], anywhere());
        if (random.integer(0, 200) == 0) objects[i] = {};
      }
      if (frame % 20 == 19)  // everything at once
        for (PlacedObject& object : objects) put(object, anywhere());
      const SceneView view{objects, nullptr};
      const broad::ObjectPairs pairs = pairs_of(borders, view);
      ASSERT_TRUE(pairs == test::all_pairs(view)) << "frame " << frame;
      ASSERT_GT(pairs.size(), 20u);
    }
  }
}

/// By hand: four unit boxes in a row on X, a gap of one between them, all in one place on Y and Z.
TEST(SweepAndPrune, CountsWhatItDoes) {
  std::vector<PlacedObject> objects;
  for (int i = 0; i < 4; ++i) objects.push_back(placed({{4 * i, 0, 0}, {1, 1, 1}, 2, 0}));
  paper::SweepAndPrune borders;
  const auto counts_after = [&](int object, int x) {
    objects[static_cast<std::size_t>(object)] = placed({{x, 0, 0}, {1, 1, 1}, 2, 0});
    (void)pairs_of(borders, {objects, nullptr});
    return borders.counts();
  };
  (void)counts_after(0, 0);
  struct Case {
    const char* what;
    int object, x;
    std::uint64_t moves, sphere_tests;
  };
  const Case cases[] = {{"all at rest", 0, 0, 0, 0},
                        {"into the next one: its end passes a start", 0, 3, 1, 1},
                        {"through its middle: a start passes a start, an end an end", 0, 5, 2, 1},
                        {"until it touches two: its end meets a start, which comes first", 0, 6, 1, 2}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const paper::SweepAndPrune::Counts counts = counts_after(c.object, c.x);
    EXPECT_EQ(counts.updated, 4u);
    EXPECT_EQ(counts.moves, c.moves);
    EXPECT_EQ(counts.sphere_tests, c.sphere_tests);
  }
}

TEST(SweepAndPrune, CopesWithAllInOnePlaceAndWithNone) {
  std::vector<PlacedObject> objects(50, placed({{1, 2, 3}, {0, 0, 0}, 0, 0}));
  paper::SweepAndPrune borders;
  EXPECT_EQ(pairs_of(borders, {objects, nullptr}).size(), 50u * 49 / 2);
  objects.clear();
  EXPECT_TRUE(pairs_of(borders, {objects, nullptr}).empty());
}

/// Spheres that touch in one point, at radii and distances that round either way.
TEST(MayTouch, KeepsSpheresThatTouchInExactArithmetic) {
  test::Seeded seeded(9);
  int touching = 0;
  for (int i = 0; i < 20000; ++i) {
    PlacedObject a = placed({{0, 0, 0}, {0, 0, 0}, 0, 0}), b = a;
    a.box = b.box = {{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}};
    // On a Pythagorean quadruple times a random scale of few bits everything here is exact.
    const double scale = std::ldexp(seeded.random.integer(1, 1 << 20), seeded.random.integer(-40, 20));
    b.sphere.center = scale * Vec3{2, 3, 6};
    a.sphere.radius = scale * seeded.random.integer(0, 7);
    b.sphere.radius = 7 * scale - a.sphere.radius;
    const std::array<PlacedObject, 2> both{a, b};
    EXPECT_TRUE(broad::may_touch({both, nullptr}, 0, 1));
    touching += broad::may_touch({both, nullptr}, 0, 1);
    b.sphere.radius *= 1 - 1e-12;
    const std::array<PlacedObject, 2> apart{a, b};
    if (b.sphere.radius > 1e-3 * scale) {
      EXPECT_FALSE(broad::may_touch({apart, nullptr}, 0, 1));
    }
  }
  EXPECT_EQ(touching, 20000);
}

}  // namespace
}  // namespace impinge
