// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "broad/near_pairs.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "scenes/random.hpp"
#include "tests/broad/bodies.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scene::PlacedObject;
using test::box_at;

Vec3 within(scenes::Random& random, double side) {
  return {random.uniform(-side, side), random.uniform(-side, side), random.uniform(-side, side)};
}

/// An object and its own motion.
struct Body {
  Vec3 center, half, velocity;
  bool is_here = true;
};

PlacedObject placed(const Body& body) {
  PlacedObject object = box_at(body.center, body.half);
  if (!body.is_here) object.mesh = nullptr;  // and the bounds as they were, so that they would be found
  return object;
}

std::vector<PlacedObject> placed(const std::vector<Body>& bodies) {
  std::vector<PlacedObject> objects;
  for (const Body& body : bodies) objects.push_back(placed(body));
  return objects;
}

/// Checks every frame against brute force; `step` moves the bodies.
void expect_right(std::vector<Body> bodies, int frames, const std::function<void(std::vector<Body>&, int)>& step,
                  std::size_t pairs_at_first) {
  broad::NearPairs near_pairs;
  for (int frame = 0; frame < frames; ++frame) {
    const std::vector<PlacedObject> objects = placed(bodies);
    test::update(near_pairs, objects);
    broad::ObjectPairs pairs;
    broad::NearPairs::Scratch scratch;
    const std::size_t looked_at = near_pairs.find({objects}, pairs, scratch);
    ASSERT_TRUE(pairs == test::all_pairs({objects})) << "frame " << frame;
    ASSERT_TRUE(frame > 0 || pairs.size() >= pairs_at_first);
    ASSERT_GE(looked_at, pairs.size());
    step(bodies, frame);
  }
}

std::vector<Body> crowd(scenes::Random& random, int n, double speed) {
  const double side = 1.5 * std::cbrt(n);
  std::vector<Body> bodies;
  for (int i = 0; i < n; ++i)
    bodies.push_back({within(random, side), Vec3{1, 0.6, 0.3} + within(random, 0.3), within(random, speed)});
  return bodies;
}

void drift(std::vector<Body>& bodies, int) {
  for (Body& body : bodies) body.center = body.center + body.velocity;
}

TEST(NearPairs, StayRightWhileBodiesDriftSlowly) {
  for (const double speed : {0.0, 0.001, 0.01, 0.05, 0.3}) {
    SCOPED_TRACE("speed " + std::to_string(speed));
    test::Seeded seeded(3);
    expect_right(crowd(seeded.random, 300, speed), 200, drift, 20);
  }
}

TEST(NearPairs, StayRightOnRandomWalksWithTurns) {
  test::Seeded seeded(4);
  scenes::Random& random = seeded.random;
  expect_right(
      crowd(random, 300, 0), 200,
      [&](std::vector<Body>& bodies, int) {
        for (Body& body : bodies) {
          body.center = body.center + within(random, 0.02);
          body.half = abs(body.half + within(random, 0.01));
        }
      },
      20);
}

TEST(NearPairs, StayRightThroughArrivalsDeparturesAndJumps) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    std::vector<Body> bodies = crowd(random, 400, 0.02);
    expect_right(
        bodies, 150,
        [&](std::vector<Body>& now, int frame) {
          drift(now, frame);
          for (Body& body : now) {
            if (random.integer(0, 200) == 0) body.is_here = !body.is_here;
            if (random.integer(0, 200) == 0) body.center = within(random, 11);
          }
          if (frame % 30 == 10)  // many, though not all
            for (std::size_t i = 0; i < now.size() / 4; ++i) now[4 * i].center = within(random, 11);
          if (frame % 50 == 20)  // all at once
            for (Body& body : now) body.center = within(random, 11);
          if (frame % 40 == 5) now.push_back(now[7]);
          if (frame == 100)
            for (std::size_t i = 0; i < now.size(); ++i) now[i].is_here = i % 9 == 0;
          if (frame == 110)
            for (Body& body : now) body.is_here = true;
        },
        0);
  }
}

/// Some jump every frame, more than are left out of the tree at once, rest and jump again; some of those come and go.
TEST(NearPairs, StayRightWhileAFewJumpAndRest) {
  for (const std::size_t jumping : {1, 7, 40}) {
    test::Seeded seeded(6);
    scenes::Random& random = seeded.random;
    expect_right(
        crowd(random, 200, 0), 160,
        [&](std::vector<Body>& now, int frame) {
          for (std::size_t i = 0; i < jumping; ++i) {
            if (frame % 50 < 30) now[5 * i].center = within(random, 9);
            if (random.integer(0, 20) == 0) now[5 * i].is_here = !now[5 * i].is_here;
          }
          if (frame % 50 == 20) now[5].half = {9, 9, 9};
          if (frame % 50 == 22) now[5].half = {1, 1, 1};
        },
        20);
  }
}

/// An object that jumps is looked up wherever it is, and is in the tree again once it rests.
TEST(NearPairs, FindJumpingObjectsNearABox) {
  test::Seeded seeded(7);
  scenes::Random& random = seeded.random;
  std::vector<Body> bodies = crowd(random, 60, 0);
  broad::NearPairs near_pairs;
  broad::BoxTree::Search search;
  for (int frame = 0; frame < 40; ++frame) {
    if (frame < 25) bodies[3].center = bodies[4].center = within(random, 6);
    std::vector<PlacedObject> objects = placed(bodies);
    test::update(near_pairs, objects);
    // A jump that no update has seen yet makes nothing out of date once the objects are known to jump.
    if (frame >= 10 && frame < 25) {
      bodies[3].center = within(random, 6);
      objects = placed(bodies);
      near_pairs.place(3, objects[3]);
      ASSERT_TRUE(near_pairs.is_current());
    }
    const Vec3 middle = within(random, 6);
    const Box asked{middle - Vec3{1, 1, 1}, middle + Vec3{1, 1, 1}};
    near_pairs.find_near(asked, search);
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
      const auto found = std::count(search.found.begin(), search.found.end(), i);
      ASSERT_LE(found, 1);
      ASSERT_TRUE(found == 1 || !overlap(objects[i].box, asked)) << "frame " << frame;
    }
  }
}

/// Bodies that set out far apart and all come to one place, and go on.
TEST(NearPairs, StayRightWhileACrowdMeetsAndParts) {
  test::Seeded seeded(5);
  std::vector<Body> bodies;
  for (int i = 0; i < 200; ++i) {
    const Vec3 from = within(seeded.random, 20);
    bodies.push_back({from, {0.5, 0.5, 0.5}, -0.02 * from});
  }
  expect_right(bodies, 100, drift, 0);
}

struct HardScene {
  std::string name;
  std::vector<Body> bodies;
};

std::vector<HardScene> hard_scenes(scenes::Random& random) {
  const auto made = [&](const std::string& name, int n, const std::function<Body(int)>& body) {
    HardScene scene{name, {}};
    for (int i = 0; i < n; ++i) scene.bodies.push_back(body(i));
    return scene;
  };
  const auto whole = [&](int most) {
    return Vec3{1.0 * random.integer(0, most), 1.0 * random.integer(0, most), 1.0 * random.integer(0, most)};
  };
  std::vector<HardScene> scenes{
      made("touching boxes", 343,
           [](int i) {
             return Body{{1.0 * (i % 7), 1.0 * (i / 7 % 7), 1.0 * (i / 49)}, {0.5, 0.5, 0.5}, {0, 0, 0}};
           }),
      {"all equal", std::vector<Body>(100, {{1, 2, 3}, {1, 1, 1}, {0, 0, 0}})},
      {"one point", std::vector<Body>(100, {{1, 2, 3}, {0, 0, 0}, {0, 0, 0}})},
      made("nested", 100,
           [](int i) {
             return Body{{0, 0, 0}, std::ldexp(1.0, i - 50) * Vec3{1, 2, 3}, {0, 0, 0}};
           }),
      made("nested outwards", 100,
           [](int i) {
             return Body{{0, 0, 0}, (1.0 + i) * Vec3{1, 1, 1}, {0, 0, 0}};
           }),
      made("points on a lattice", 300,
           [&](int) {
             return Body{whole(4), {0, 0, 0}, {0, 0, 0}};
           }),
      made("flat squares", 300,
           [&](int i) {
             Vec3 half{1, 1, 1};
             (i % 3 == 0 ? half.x : i % 3 == 1 ? half.y : half.z) = 0;
             return Body{whole(8), half, {0, 0, 0}};
           }),
      made("on a line", 300,
           [](int i) {
             return Body{{0.9 * i, 0, 0}, {0.5, 0, 0}, {0, 0, 0}};
           }),
      made("pipes along three axes", 300,
           [&](int i) {
             const Vec3 along{i % 3 == 0 ? 9.0 : 0, i % 3 == 1 ? 9.0 : 0, i % 3 == 2 ? 9.0 : 0};
             return Body{within(random, 9), along + Vec3{0.3, 0.3, 0.3}, {0, 0, 0}};
           }),
      made("all sizes", 300,
           [&](int) {
             const double size = std::ldexp(1.0, random.integer(-12, 3));
             return Body{within(random, 6), abs(within(random, size)), {0, 0, 0}};
           }),
      made("one far away", 300,
           [&](int i) {
             return Body{i == 77 ? Vec3{0, -1e12, 0} : within(random, 9), {1, 1, 1}, {0, 0, 0}};
           }),
      made("two crowds far apart", 300,
           [&](int i) {
             return Body{within(random, 6) + Vec3{i % 2 == 0 ? 1e9 : -1e9, 0, 0}, {1, 1, 1}, {0, 0, 0}};
           }),
      made("ever farther", 300, [&](int i) {
        const double at = std::ldexp(1.0, i - 150);
        return Body{{at, 0, 0}, {0.4 * at, 0.1, 0.1}, {0, 0, 0}};
      })};
  for (const auto& [name, scale, shift] :
       {std::tuple{"tiny", 0x1p-350, 0.0}, {"huge", 0x1p295, 0.0}, {"far from the origin", 1.0, 1e6}}) {
    HardScene scene{name, crowd(random, 300, 0)};
    for (Body& body : scene.bodies)
      body.center = scale * body.center + Vec3{shift, shift, -shift}, body.half = scale * body.half;
    scenes.push_back(scene);
  }
  return scenes;
}

/// As they are; with small steps; with some jumping onto others; in reverse order of arrival.
TEST(NearPairs, AreRightOnHardScenes) {
  test::Seeded seeded(6);
  scenes::Random& random = seeded.random;
  for (const HardScene& scene : hard_scenes(random)) {
    SCOPED_TRACE(scene.name);
    ASSERT_FALSE(test::all_pairs({placed(scene.bodies)}).empty());
    expect_right(
        scene.bodies, 40,
        [&](std::vector<Body>& now, int frame) {
          if (frame < 2) return;
          for (Body& body : now) {
            const double least = std::min({body.half.x, body.half.y, body.half.z});
            if (frame < 25) body.center = body.center + within(random, 0.1 * least);
            if (frame >= 25 && random.integer(0, 9) == 0) {
              const std::size_t other = random.bits() % now.size();
              body.center = now[other].center + Vec3{now[other].half.x + body.half.x, 0, 0};
            }
          }
        },
        0);
    std::vector<Body> one_by_one = scene.bodies;
    for (Body& body : one_by_one) body.is_here = false;
    std::size_t next = one_by_one.size();
    expect_right(
        one_by_one, 45,
        [&](std::vector<Body>& now, int frame) {
          // Singly at first, then in heaps, so that the tree grows by itself and is built anew as well.
          for (int k = 0; k < 1 + frame / 3 && next > 0; ++k) now[--next].is_here = true;
        },
        0);
    EXPECT_EQ(next, 0u);
  }
}

TEST(NearPairs, HeedGroupsThatChange) {
  test::Seeded seeded(7);
  std::vector<PlacedObject> objects = placed(crowd(seeded.random, 200, 0));
  broad::NearPairs near_pairs;
  std::size_t fewest = objects.size() * objects.size(), most = 0;
  for (int frame = 0; frame < 30; ++frame) {
    for (PlacedObject& object : objects)
      if (seeded.random.integer(0, 9) == 0) object.group = static_cast<std::uint32_t>(seeded.random.integer(0, 2));
    test::update(near_pairs, objects);
    const broad::ObjectPairs pairs = test::pairs_of(near_pairs, {objects});
    ASSERT_TRUE(pairs == test::all_pairs({objects}));
    fewest = std::min(fewest, pairs.size()), most = std::max(most, pairs.size());
  }
  EXPECT_LT(fewest, most);
}

/// Their pairs are never asked for: there may be too many to store.
TEST(NearPairs, KeepNoCandidatesWithinAGroup) {
  std::vector<PlacedObject> objects(3000, box_at({0, 0, 0}, {1, 1, 1}, 5));
  broad::NearPairs near_pairs;
  test::update(near_pairs, objects);
  EXPECT_EQ(near_pairs.candidates(), 0u);
  for (std::size_t i = 0; i < 100; ++i) objects[i] = box_at({5, 0, 0}, {1, 1, 1}, 5);
  test::update(near_pairs, objects);
  EXPECT_EQ(near_pairs.candidates(), 0u);
  objects[0].group = 0;
  test::update(near_pairs, objects);
  EXPECT_EQ(near_pairs.candidates(), 99u);
}

/// Objects outside the exact domain have no bounds; queries refuse them, and until then they must not cost.
TEST(NearPairs, LeaveObjectsOutsideTheDomainOut) {
  std::vector<PlacedObject> objects(3000, box_at({0, 0, 0}, {1, 1, 1}));
  for (std::size_t i = 2; i < objects.size(); ++i) objects[i].in_domain = false;
  broad::NearPairs near_pairs;
  test::update(near_pairs, objects);
  EXPECT_EQ(near_pairs.candidates(), 1u);
  objects[1].in_domain = false, objects[2].in_domain = objects[3].in_domain = true;
  test::update(near_pairs, objects);
  EXPECT_EQ(near_pairs.candidates(), 3u);
}

TEST(NearPairs, AreCurrentUntilSomethingLeavesItsRoom) {
  std::vector<PlacedObject> objects(2, box_at({0, 0, 0}, {1, 1, 1}));
  broad::NearPairs near_pairs;
  EXPECT_TRUE(near_pairs.is_current());
  near_pairs.reserve(2);
  near_pairs.place(0, objects[0]), near_pairs.place(1, objects[1]);
  EXPECT_FALSE(near_pairs.is_current());
  near_pairs.update();
  EXPECT_TRUE(near_pairs.is_current());
  near_pairs.place(1, box_at({0.001, 0, 0}, {1, 1, 1}));
  EXPECT_TRUE(near_pairs.is_current());
  EXPECT_EQ(test::pairs_of(near_pairs, {}).size(), 1u);
  near_pairs.place(1, box_at({3, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(near_pairs.is_current());
}

TEST(NearPairs, EndEarlyWhenAskedToStop) {
  broad::NearPairs near_pairs;
  const std::vector<PlacedObject> objects = test::lattice(3, 3, 3);
  test::update(near_pairs, objects);
  std::stop_source stop;
  broad::ObjectPairs pairs;
  broad::NearPairs::Scratch scratch;
  near_pairs.find({objects}, pairs, scratch, {.stop = stop.get_token()});
  EXPECT_EQ(pairs.size(), test::lattice_pairs(3, 3, 3));
  stop.request_stop();
  near_pairs.find({objects}, pairs, scratch, {.stop = stop.get_token()});
  EXPECT_TRUE(pairs.empty());
}

}  // namespace
}  // namespace impinge
