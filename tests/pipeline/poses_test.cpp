// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

/// `collide_poses` against `collide`, pose by pose.
namespace impinge {
namespace {

/// Apart, touching lightly, deep, the same, off a rotation.
std::vector<Pose> any_poses(scenes::Random& random, int n) {
  std::vector<Pose> poses;
  for (int i = 0; i < n; ++i) {
    poses.push_back(scenes::random_motion(random, std::array{0.0, 0.5, 2.5, 20.0}[static_cast<std::size_t>(i % 4)]));
    if (i % 3 == 0) poses.back().R = scenes::stretched_rotation(random);
    if (i % 5 == 0) poses.back() = {};
  }
  return poses;
}

struct Row {
  std::array<std::uint32_t, 2> poses;
  std::vector<TrianglePair> triangles;
  std::vector<Kind> kinds;
};

/// The rows of an answer, touching or not.
std::vector<Row> rows_of(const Contacts& contacts) {
  std::vector<Row> rows;
  EXPECT_EQ(contacts.offsets.size(), contacts.objects.size() + 1);
  EXPECT_EQ(contacts.offsets.back(), contacts.triangles.size());
  EXPECT_EQ(contacts.kinds.size(), contacts.triangles.size());
  for (std::size_t row = 0; row < contacts.objects.size(); ++row) {
    const auto begin = static_cast<std::ptrdiff_t>(contacts.offsets[row]);
    const auto end = static_cast<std::ptrdiff_t>(contacts.offsets[row + 1]);
    EXPECT_LE(begin, end);
    rows.push_back({contacts.objects[row],
                    {contacts.triangles.begin() + begin, contacts.triangles.begin() + end},
                    {contacts.kinds.begin() + begin, contacts.kinds.begin() + end}});
  }
  return rows;
}

/// Every pose's row as `collide` has it, and the sum of the hashes.
void expect_rows(const Mesh& a, const std::vector<Pose>& poses_a, const Mesh& b, const std::vector<Pose>& poses_b,
                 const Options& options) {
  const auto found = collide_poses(a, poses_a, b, poses_b, options);
  ASSERT_TRUE(found) << found.error().message;
  const std::vector<Row> rows = rows_of(*found);
  ASSERT_EQ(rows.size(), std::max(poses_a.size(), poses_b.size()));
  std::uint64_t hash = 0;
  for (std::uint32_t k = 0; k < rows.size(); ++k) {
    const std::uint32_t i = poses_a.size() == 1 ? 0 : k, j = poses_b.size() == 1 ? 0 : k;
    EXPECT_EQ(rows[k].poses, (std::array{i, j}));
    const Contacts one = collide(a, poses_a[i], b, poses_b[j], options).value();
    EXPECT_TRUE(rows[k].triangles == one.triangles) << "row " << k;
    EXPECT_EQ(rows[k].kinds, one.kinds);
    hash += one.hash;
  }
  EXPECT_EQ(found->hash, hash);
  EXPECT_FALSE(found->truncated);
}

TEST(CollidePoses, GivesTheRowsOfCollide) {
  test::Seeded seeded(1);
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968)), cube = test::mesh_of(scenes::cube());
  const Mesh soup = test::mesh_of(scenes::integer_soup(seeded.random, 60, 2));
  const std::vector<Pose> many = any_poses(seeded.random, 40), more = any_poses(seeded.random, 40), one{many[3]};
  for (const char* backend : {"simd", "paper"})
    for (const int threads : {1, 2, 8}) {
      const Options options{.threads = threads, .backend = backend};
      expect_rows(knot, many, cube, more, options);
      expect_rows(knot, one, soup, more, options);
      expect_rows(soup, many, knot, one, options);
      expect_rows(soup, one, soup, one, options);
      expect_rows(cube, many, cube, many, options);
    }
  expect_rows(knot, many, soup, more, {.kinds = kTouching});
  expect_rows(cube, any_poses(seeded.random, 1100), cube, any_poses(seeded.random, 1100), {.threads = 2});
}

TEST(CollidePoses, FindsAWitnessForEachPoseThatTouches) {
  test::Seeded seeded(2);
  const Mesh soup = test::mesh_of(scenes::integer_soup(seeded.random, 60, 2)), cube = test::mesh_of(scenes::cube());
  const std::vector<Pose> one(1), many = any_poses(seeded.random, 40);
  for (const int threads : {1, 0})
    for (const std::uint8_t kinds : {kAllKinds, kTouching}) {
      const Options all{.kinds = kinds, .threads = threads};
      const Contacts found =
          collide_poses(soup, one, cube, many, {.find = Options::Find::first, .kinds = kinds, .threads = threads})
              .value();
      const std::vector<Row> witnesses = rows_of(found),
                             rows = rows_of(collide_poses(soup, one, cube, many, all).value());
      ASSERT_EQ(witnesses.size(), 40u);
      EXPECT_EQ(found.hash, 0u);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        ASSERT_EQ(witnesses[k].triangles.size(), rows[k].triangles.empty() ? 0u : 1u);
        if (rows[k].triangles.empty()) continue;
        const auto at = std::find(rows[k].triangles.begin(), rows[k].triangles.end(), witnesses[k].triangles[0]);
        ASSERT_NE(at, rows[k].triangles.end());
        EXPECT_EQ(witnesses[k].kinds[0], rows[k].kinds[static_cast<std::size_t>(at - rows[k].triangles.begin())]);
      }
    }
}

/// The limit is of the whole call: the rows stay, the last of them emptier.
TEST(CollidePoses, ALimitCutsTheCallAsAWhole) {
  test::Seeded seeded(3);
  const Mesh cube = test::mesh_of(scenes::cube()), soup = test::mesh_of(scenes::integer_soup(seeded.random, 60, 2));
  const std::vector<Pose> one(1), many = any_poses(seeded.random, 20);
  const Contacts all = collide_poses(soup, one, cube, many).value();
  ASSERT_GT(all.triangles.size(), 100u);
  for (const std::size_t limit : {std::size_t{0}, std::size_t{1}, std::size_t{50}, all.triangles.size() - 1,
                                  all.triangles.size(), all.triangles.size() + 1}) {
    for (const int threads : {1, 2}) {
      const Contacts cut = collide_poses(soup, one, cube, many, {.limit = limit, .threads = threads}).value();
      const std::size_t kept = std::min(limit, all.triangles.size());
      EXPECT_EQ(cut.objects, all.objects);
      ASSERT_EQ(cut.triangles.size(), kept);
      EXPECT_TRUE(std::equal(cut.triangles.begin(), cut.triangles.end(), all.triangles.begin()));
      EXPECT_TRUE(std::equal(cut.kinds.begin(), cut.kinds.end(), all.kinds.begin()));
      EXPECT_EQ(cut.truncated, kept < all.triangles.size());
      for (std::size_t k = 0; k < all.offsets.size(); ++k)
        EXPECT_EQ(cut.offsets[k], std::min<std::uint64_t>(all.offsets[k], kept));
    }
  }
}

TEST(Touches, WhereThePapersWayHasContacts) {
  test::Seeded seeded(4);
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968)), cube = test::mesh_of(scenes::cube()),
             soup = test::mesh_of(scenes::integer_soup(seeded.random, 60, 2)), empty = test::mesh_of({});
  Workspace workspace;
  int touching = 0;
  for (const Mesh* a : {&knot, &cube, &soup, &empty}) {
    const std::vector<Pose> poses_a = any_poses(seeded.random, 40), poses_b = any_poses(seeded.random, 40);
    for (const Mesh* b : {&knot, &cube, &soup})
      for (std::size_t i = 0; i < poses_a.size(); ++i) {
        const bool expected = !collide(*a, poses_a[i], *b, poses_b[i], {.backend = "paper"}).value().objects.empty();
        EXPECT_EQ(touches(*a, poses_a[i], *b, poses_b[i]).value(), expected);
        EXPECT_EQ(touches(*b, poses_b[i], *a, poses_a[i], {}, &workspace).value(), expected);
        touching += expected ? 1 : 0;
      }
  }
  EXPECT_GT(touching, 40);
}

TEST(Touches, HasTheErrorsOfCollide) {
  const Mesh cube = test::mesh_of(scenes::cube());
  std::stop_source stopped;
  stopped.request_stop();
  const auto expect = [&](const Pose& pose, const std::stop_token& stop, Code code) {
    for (const bool first : {true, false}) {
      const auto found = first ? touches(cube, pose, cube, {}, stop) : touches(cube, {}, cube, pose, stop);
      const auto known =
          first ? collide(cube, pose, cube, {}, {.stop = stop}) : collide(cube, {}, cube, pose, {.stop = stop});
      ASSERT_FALSE(found.has_value());
      EXPECT_EQ(found.error().code, code);
      EXPECT_EQ(found.error().message, known.error().message);
    }
  };
  expect({.R{1, 0, 0, 0, 1, 0, 0, 0, -1}}, {}, Code::bad_pose);
  expect({.t{0x1p301, 0, 0}}, {}, Code::out_of_range);
  expect({.t{0x1p1023, 0x1p1023, 0x1p1023}}, {}, Code::out_of_range);
  expect({}, stopped.get_token(), Code::cancelled);
  expect({.t{9, 0, 0}}, stopped.get_token(), Code::cancelled);
}

TEST(CollidePoses, OfNothingIsNothing) {
  const Mesh cube = test::mesh_of(scenes::cube()), empty = test::mesh_of({});
  const std::vector<Pose> none, one(1), three(3);
  for (const auto& [a, b] : {std::pair{none, none}, {none, one}, {one, none}}) {
    const Contacts found = collide_poses(cube, a, cube, b).value();
    EXPECT_TRUE(found.objects.empty());
    EXPECT_EQ(found.offsets, std::vector<std::uint64_t>{0});
    EXPECT_EQ(found.hash, 0u);
  }
  for (const auto& [a, b] : {std::pair{empty, cube}, {cube, empty}, {empty, empty}}) {
    const Contacts found = collide_poses(a, three, b, one).value();
    EXPECT_EQ(found.objects.size(), 3u);
    EXPECT_EQ(found.offsets, std::vector<std::uint64_t>(4));
  }
}

TEST(CollidePoses, NamesWhatIsWrong) {
  const Mesh cube = test::mesh_of(scenes::cube());
  const std::vector<Pose> one(1), two(2), three(3);
  std::vector<Pose> bad(1100), far(4);
  bad[2].R[0] = bad[1000].R[0] = 5;
  far[1].t = {0x1p301, 0, 0};
  const auto code_of = [](const Result<Contacts>& result) {
    EXPECT_FALSE(result);
    EXPECT_FALSE(result.error().message.empty());
    return result.error().code;
  };
  EXPECT_EQ(code_of(collide_poses(cube, two, cube, three)), Code::bad_option);
  EXPECT_EQ(code_of(collide_poses(cube, {}, cube, three)), Code::bad_option);
  EXPECT_EQ(code_of(collide_poses(cube, one, cube, three, {.threads = -1})), Code::bad_option);
  EXPECT_EQ(code_of(collide_poses(cube, one, cube, far)), Code::out_of_range);
  for (const auto& result : {collide_poses(cube, bad, cube, one), collide_poses(cube, one, cube, bad)}) {
    EXPECT_EQ(code_of(result), Code::bad_pose);
    EXPECT_NE(result.error().message.find("[2]"), std::string::npos) << result.error().message;
  }
  std::stop_source stopped;
  stopped.request_stop();
  EXPECT_EQ(code_of(collide_poses(cube, one, cube, three, {.stop = stopped.get_token()})), Code::cancelled);
}

}  // namespace
}  // namespace impinge
