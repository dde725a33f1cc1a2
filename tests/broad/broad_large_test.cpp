// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "broad/sweep_and_prune.hpp"
#include "impinge/scene.hpp"
#include "scenes/placed.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scene::PlacedObject;

const MeshData kSomething;

PlacedObject box_at(const Vec3& center, const Vec3& half) {
  PlacedObject object;
  object.mesh = &kSomething;
  object.sphere = {center, norm(half) * (1 + 1e-12)};
  object.box = {center - half, center + half};
  return object;
}

/// Unit boxes that fill a lattice.
std::vector<PlacedObject> lattice(int nx, int ny, int nz) {
  std::vector<PlacedObject> objects;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k) objects.push_back(box_at({1.0 * i, 1.0 * j, 1.0 * k}, {0.5, 0.5, 0.5}));
  return objects;
}

/// Each box and its neighbours, itself among them: 3n - 2 of both along an axis.
std::size_t lattice_pairs(std::size_t nx, std::size_t ny, std::size_t nz) {
  return ((3 * nx - 2) * (3 * ny - 2) * (3 * nz - 2) - nx * ny * nz) / 2;
}

struct Found {
  std::size_t pairs;
  std::uint64_t comparisons;
};
Found find(const std::vector<PlacedObject>& objects) {
  broad::SweepAndPrune borders;
  borders.update({objects, nullptr});
  std::uint64_t comparisons = 0;
  const std::size_t pairs = borders.find({objects, nullptr}, {}, &comparisons).size();
  return {pairs, comparisons};
}

TEST(SweepAndPrune, FindsTheNeighboursOfAHundredThousandBoxes) {
  EXPECT_EQ(find(lattice(50, 50, 40)).pairs, lattice_pairs(50, 50, 40));
}

TEST(SweepAndPrune, EndsEarlyWhenAskedToStop) {
  const std::vector<PlacedObject> objects = lattice(3, 3, 3);
  broad::SweepAndPrune borders;
  borders.update({objects, nullptr});
  std::stop_source stop;
  std::uint64_t comparisons = 0;
  EXPECT_FALSE(borders.find({objects, nullptr}, stop.get_token(), &comparisons).empty());
  EXPECT_GT(comparisons, 0u);
  stop.request_stop();
  comparisons = 0;
  EXPECT_TRUE(borders.find({objects, nullptr}, stop.get_token(), &comparisons).empty());
  EXPECT_EQ(comparisons, 0u);
}

/// If all were open at once, each would be held against fifty thousand others.
TEST(SweepAndPrune, PipesAlongOneAxisDoNotDegrade) {
  constexpr int n = 100000;
  const auto unit = [](int axis) { return Vec3{axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0}; };
  for (int axis = 0; axis < 3; ++axis) {
    SCOPED_TRACE("axis " + std::to_string(axis));
    const Vec3 along = unit(axis), across = unit((axis + 1) % 3);
    std::vector<PlacedObject> row, side_by_side, bundle;
    for (int i = 0; i < n; ++i) {
      // End to end along the axis; beside each other, each as long as all; and beside each other in both directions.
      row.push_back(box_at(1.0 * i * along, 0.5 * along + Vec3{0.1, 0.1, 0.1}));
      side_by_side.push_back(box_at(1.0 * i * across, 50000.0 * along + Vec3{0.1, 0.1, 0.1}));
      const Vec3 at = 1.0 * (i % 316) * across + 1.0 * (i / 316) * unit((axis + 2) % 3);
      bundle.push_back(box_at(at, 500.0 * along + Vec3{0.1, 0.1, 0.1}));
    }
    const Found in_row = find(row), in_order = find(side_by_side), in_bundle = find(bundle);
    EXPECT_EQ(in_row.pairs, n - 1u);
    EXPECT_EQ(in_order.pairs, 0u);
    EXPECT_EQ(in_bundle.pairs, 0u);
    EXPECT_EQ(in_row.comparisons, n - 1u);
    EXPECT_EQ(in_order.comparisons, 0u);
    EXPECT_LE(in_bundle.comparisons, 160u * n);  // with the others of its column
  }
}

/// Through the whole pipeline; each joint is that of the first two pipes.
TEST(Scene, HoldsAHundredThousandPipes) {
  constexpr int n = 100000;
  const auto joint = test::scene_of(scenes::pipe_row(2, 3)).collide();
  ASSERT_TRUE(joint);
  const std::vector<test::Contact> expected = test::listed(*joint);
  ASSERT_FALSE(expected.empty());
  Scene scene = test::scene_of(scenes::pipe_row(n, 3));
  ASSERT_TRUE(scene.update());
  const auto found = scene.collide();
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_EQ(found->objects.size(), n - 1u);
  const std::vector<test::Contact> contacts = test::listed(*found);
  ASSERT_EQ(contacts.size(), (n - 1) * expected.size());
  for (std::uint32_t i = 0; i < contacts.size(); ++i) {
    const auto row = static_cast<std::uint32_t>(i / expected.size());
    const test::Contact& first = expected[i % expected.size()];
    ASSERT_EQ(contacts[i], (test::Contact{row, row + 1, first[2], first[3], first[4]}));
  }
}

}  // namespace
}  // namespace impinge
