// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The verdicts of fragments, held against exact arithmetic where they are least sure.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

#include "impinge/collide.hpp"
#include "impinge/predicates.hpp"
#include "paper/scalar.hpp"
#include "pipeline/ready_device.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"
#include "tests/gpu/environment.hpp"

namespace impinge {
namespace {

using paper::Batch;
using paper::ElementTest;
using paper::Verdict;
using scenes::Random;

/// What `crossing` claims: an end strictly on either side, the line strictly through the interior.
bool crosses(const Segment& edge, const Triangle& t) {
  if (orient3d(t[0], t[1], t[2], edge[0]) * orient3d(t[0], t[1], t[2], edge[1]) >= 0) return false;
  const int s = orient3d(edge[0], edge[1], t[0], t[1]);
  return s != 0 && s == orient3d(edge[0], edge[1], t[1], t[2]) && s == orient3d(edge[0], edge[1], t[2], t[0]);
}

/// What lies where. Lengths are in units of `scale`, and every coordinate is a multiple of `grid` units, so that all
/// are in the domain.
struct Family {
  const char* name;
  double scale, away, grid;
  double small;  ///< the triangle's size
};
constexpr Family kFamilies[] = {
    {"of one size", 1, 0, 0x1p-50, 1},
    {"far from the origin", 1, 1e6, 0x1p-32, 1},
    {"farther from the origin", 1, 0x1p40, 0x1p-11, 1},
    {"tiny", 0x1p-300, 0, 0x1p-50, 1},
    {"huge", 0x1p290, 3, 0x1p-48, 1},
    {"whose numbers are denormal floats", 0x1p-140, 0, 0x1p-50, 1},
    {"a thousandth", 1, 0, 0x1p-60, 0x1p-10},
    {"next to nothing beside their edges", 1, 0, 0x1p-100, 0x1p-40},
    {"denormal beside their edges", 1, 0, 0x1p-200, 0x1p-130},
    {"lost beside their edges", 1, 0, 0x1p-250, 0x1p-200},
};

/// Edges pass a triangle by its corners, sides and interior, or end in it, a little off: from nothing to its size.
struct Maker {
  Random& random;
  const Family& of;

  [[nodiscard]] double small_number() const {
    const int kind = random.integer(0, 3);
    const double size = std::ldexp(1.0, kind == 0 ? -random.integer(0, 8) : -random.integer(8, 50));
    return kind == 3 ? 0 : size * random.uniform(-1, 1);
  }
  [[nodiscard]] Point placed(const std::array<double, 3>& p) const {
    const auto on_grid = [&](double x) { return of.scale * (std::round(x / of.grid) * of.grid + of.away); };
    return {on_grid(p[0]), on_grid(p[1]), on_grid(p[2])};
  }

  void append_run(Batch& batch) const {
    std::array<double, 3> corners[3];
    for (auto& corner : corners)
      for (double& x : corner) x = of.small * random.uniform(-1, 1);
    if (random.integer(0, 9) == 0)  // nearly degenerate
      for (int i = 0; i < 3; ++i) corners[2][i] = corners[1][i] + of.small * 0x1p-20 * random.uniform(-1, 1);
    const auto triangle = static_cast<std::uint32_t>(batch.triangles.size());
    const auto vertex = [&](const std::array<double, 3>& p) {
      batch.vertices.push_back(placed(p));
      return static_cast<std::uint32_t>(batch.vertices.size() - 1);
    };
    batch.triangles.push_back({vertex(corners[0]), vertex(corners[1]), vertex(corners[2])});
    batch.leaves.push_back(static_cast<std::uint32_t>(batch.edges.size()));
    for (int tests = random.integer(1, 70); tests > 0; --tests) {
      double weight[3] = {random.unit(), random.unit(), random.unit()};
      for (int zeros = random.integer(0, 2); zeros > 0; --zeros) weight[random.integer(0, 2)] = 0;
      const double sum = std::max(weight[0] + weight[1] + weight[2], 0x1p-20);
      std::array<double, 3> passed{}, from{}, to{};
      const double ahead = random.integer(0, 3) == 0 ? small_number() * of.small : 1;
      for (int i = 0; i < 3; ++i) {
        for (int corner = 0; corner < 3; ++corner) passed[i] += corners[corner][i] * weight[corner] / sum;
        passed[i] += of.small * small_number();
        const double along = random.uniform(-1, 1);
        from[i] = passed[i] - along, to[i] = passed[i] + along * ahead;
      }
      batch.edges.push_back({vertex(from), vertex(to)});
      batch.tests.push_back({.edge = static_cast<std::uint32_t>(batch.edges.size() - 1),
                             .triangle = triangle,
                             .first_pair = ElementTest::kNone,
                             .second_pair = ElementTest::kNone});
    }
  }
};

struct Drawn {
  std::vector<Verdict> verdicts;
  paper::RasterCounts counts;
};

/// All at once, as far as they find room.
std::vector<Drawn> draw(const std::vector<Batch>& batches) {
  const auto opened = gpu::Devices::of_process().choose("").opened;
  auto raster = opened->take_raster();
  std::vector<Drawn> drawn(batches.size());
  for (std::size_t i = 0, waited = 0; waited < batches.size(); ++waited) {
    for (; i < batches.size() && i < waited + paper::RasterBackend::kMostBatches; ++i) raster->submit(batches[i]);
    const auto found = raster->wait();
    drawn[waited].verdicts.assign(found.begin(), found.end());
    drawn[waited].counts = raster->take_counts();
  }
  opened->give_back(std::move(raster));
  return drawn;
}

TEST(Raster, NeverContradictsExactArithmetic) {
  for (const Family& family : kFamilies) {
    SCOPED_TRACE(family.name);
    test::Seeded seeded(11);
    Batch batch;  // of more than one image
    while (batch.tests.size() < 40'000) Maker{seeded.random, family}.append_run(batch);
    const std::vector<Verdict> found = draw({batch})[0].verdicts;
    ASSERT_EQ(found.size(), batch.tests.size());
    std::size_t count[3] = {};
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto& ends = batch.edges[batch.tests[i].edge];
      const Segment edge{batch.vertices[ends[0]], batch.vertices[ends[1]]};
      const Triangle t = batch.triangle(batch.tests[i].triangle);
      if (found[i] == Verdict::no) {
        ASSERT_FALSE(intersects(edge, t)) << "test " << i;
      } else if (found[i] == Verdict::crossing) {
        ASSERT_TRUE(crosses(edge, t)) << "test " << i;
      }
      ++count[static_cast<int>(found[i])];
    }
    std::cout << family.name << ": " << count[0] << " apart, " << count[1] << " unsure, " << count[2] << " crossing\n";
    if (family.small == 1) {
      EXPECT_GT(count[0], found.size() / 20);
      EXPECT_GT(count[2], found.size() / 20);
    }
  }
}

/// Nothing near the border: certain, however large, small or far the numbers are.
TEST(Raster, IsCertainOfWhatIsPlain) {
  for (const double scale : {1.0, 0x1p-340, 0x1p-140, 0x1p60, 0x1p290})
    for (const double away : {0.0, 512.0}) {
      SCOPED_TRACE(testing::Message() << scale << ", " << away);
      const auto at = [&](double x, double y, double z) {
        return Point{scale * (x + away), scale * (y + away), scale * (z + away)};
      };
      Batch batch;
      batch.vertices = {at(0, 0, 0), at(8, 0, 0), at(0, 8, 0),  at(2, 2, -2),
                        at(2, 2, 3), at(2, 2, 1), at(7, 7, -2), at(7, 7, 3)};
      batch.triangles = {{0, 1, 2}};
      batch.edges = {{3, 4}, {5, 4}, {6, 7}};
      batch.leaves = {0};
      for (std::uint32_t edge = 0; edge < 3; ++edge) batch.tests.push_back({.edge = edge, .triangle = 0});
      const std::vector<Verdict> expected{Verdict::crossing, Verdict::no, Verdict::no};
      EXPECT_EQ(draw({batch})[0].verdicts, expected);
    }
}

/// A leaf's edges against many triangles, some edges and some triangles left out: quads that lie over each other, of
/// any length. In two images where `tests` is large.
Batch crossed_leaf(Random& random, std::size_t tests) {
  Batch batch;
  for (std::uint32_t edge = 0; edge < 97; ++edge) {
    if (edge == 0 || edge == 40) batch.leaves.push_back(edge);
    const double x = random.uniform(-2, 2), y = random.uniform(-2, 2);
    batch.vertices.insert(batch.vertices.end(), {{x, y, -1}, {x + random.uniform(-1, 1), y, 1}});
    batch.edges.push_back({2 * edge, 2 * edge + 1});
  }
  while (batch.tests.size() < tests) {
    const auto first = static_cast<std::uint32_t>(batch.vertices.size());
    for (int corner = 0; corner < 3; ++corner)
      batch.vertices.push_back({random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-0.5, 0.5)});
    for (std::uint32_t edge = 0; edge < batch.edges.size(); ++edge)
      if (random.integer(0, 5) > 0)
        batch.tests.push_back({.edge = edge, .triangle = static_cast<std::uint32_t>(batch.triangles.size())});
    batch.triangles.push_back({first, first + 1, first + 2});
  }
  return batch;
}

TEST(Raster, BatchesThatAreUnderWayTogetherAreAnsweredInOrder) {
  test::Seeded seeded(12);
  std::vector<Batch> batches;
  for (const std::size_t tests : {100, 0, 80'000, 1, 40'000, 3000, 0, 70'000, 200})
    batches.push_back(crossed_leaf(seeded.random, tests));
  const std::vector<Drawn> drawn = draw(batches);
  for (std::size_t i = 0; i < batches.size(); ++i) {
    ASSERT_EQ(drawn[i].verdicts.size(), batches[i].tests.size()) << "batch " << i;
    std::vector<Verdict> expected;
    paper::test_edges(batches[i], expected);
    // Both certify what is plain; where they differ one of them is unsure.
    std::size_t certain = 0;
    for (std::size_t test = 0; test < expected.size(); ++test) {
      if (drawn[i].verdicts[test] == Verdict::unsure || expected[test] == Verdict::unsure) continue;
      ASSERT_EQ(drawn[i].verdicts[test], expected[test]) << "batch " << i << ", test " << test;
      ++certain;
    }
    EXPECT_GE(certain, expected.size() * 99 / 100);
  }
}

/// Verdicts are read where the query saw a test that is not certainly apart, and nowhere else.
TEST(Raster, TheOcclusionQueryDecidesWhetherVerdictsAreRead) {
  test::Seeded seeded(13);
  Batch crossed = crossed_leaf(seeded.random, 1000), apart = crossed;
  for (const auto& triangle : apart.triangles)
    for (const std::uint32_t corner : triangle) apart.vertices[corner].z += 16;
  const std::vector<Drawn> drawn = draw({apart, crossed, apart});
  std::uint64_t images = 0, overlapped = 0, read = 0;
  for (const auto& [verdicts, counts] : drawn)
    images += counts.images_drawn, overlapped += counts.images_overlapped, read += counts.images_read;
  EXPECT_EQ(images, 3u);
  EXPECT_EQ(overlapped, 2u);
  EXPECT_EQ(read, 1u);
  for (const std::size_t i : {0, 2})
    EXPECT_EQ(std::count(drawn[i].verdicts.begin(), drawn[i].verdicts.end(), Verdict::no), std::ssize(apart.tests));
  EXPECT_NE(drawn[1].verdicts, drawn[0].verdicts);
}

/// The CPU makes the next batches while the device draws.
TEST(Raster, AQueryOfManyBatchesHasSeveralUnderWay) {
  const Mesh mesh = test::mesh_of(scenes::torus_knot_of(4000));
  const Contacts contacts = collide(mesh, {}, mesh, {.t = {0.1, 0, 0}}, {.threads = 1, .backend = "raster"}).value();
  const Statistics& s = contacts.statistics;
  EXPECT_GE(s.images_drawn, 3u);
  EXPECT_GE(s.images_overlapped, s.images_drawn / 2);
  EXPECT_GT(s.device_seconds, s.device_wait_seconds);
  EXPECT_EQ(contacts.hash, collide(mesh, {}, mesh, {.t = {0.1, 0, 0}}, {.backend = "paper"})->hash);
}

/// Devices that compute without drawing, or whose fragments write nowhere, are told apart before anything is drawn.
TEST(Raster, ADeviceThatCannotDrawTestsSaysWhy) {
  const auto opened = gpu::Devices::of_process().choose("").opened;
  for (const bool draws : {false, true}) {
    gpu::PhysicalDevice physical = opened->device.physical();
    physical.draws = draws, physical.fragments_store = !draws;
    gpu::ReadyDevice poor(physical, {});
    try {
      (void)poor.take_raster();
      ADD_FAILURE() << "it drew";
    } catch (const gpu::Failure& failure) {
      EXPECT_NE(std::string_view(failure.what()).find(draws ? "buffers" : "draw"), std::string_view::npos);
    }
  }
}

}  // namespace
}  // namespace impinge
