// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "partition/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/instruction_sets.hpp"
#include "tests/hierarchy/exact_frames.hpp"
#include "tests/hierarchy/tree_pair.hpp"

namespace impinge {
namespace {

using hierarchy::WideLeafPair;
using partition::PairStream;
using test::Rational3;
using test::TreePair;
using test::TrianglePairs;

/// Streams the work to `see(stream, begin)`, which looks at what was appended from `begin` on. The stream is emptied
/// when it is full, or before, as a consumer may do.
template <class See>
void stream_all(const std::vector<WideLeafPair>& pairs, const hierarchy::TreeRelation& relation, const See& see) {
  const auto sweep = std::make_unique<partition::Sweep>();
  const auto stream = std::make_unique<PairStream>();
  sweep->begin(pairs, relation);
  for (bool done = false; !done;) {
    stream->size = 0;
    done = sweep->fill(*stream);
    ASSERT_LE(stream->size, PairStream::kCapacity);
    ASSERT_TRUE(done || stream->size > 0);
    see(*stream);
  }
}

/// The streamed pairs; fails where one comes twice.
TrianglePairs streamed(const TreePair& pair, const std::vector<WideLeafPair>& leaf_pairs) {
  TrianglePairs ids;
  stream_all(leaf_pairs, pair.relation(), [&](const PairStream& stream) {
    for (std::size_t i = 0; i < stream.size; ++i) ids.emplace_back(stream.id_a[i], stream.id_b[i]);
  });
  return test::sorted_once(std::move(ids));
}

/// Every touching pair, on every instruction set, of any leaves. Returns how many pairs are streamed.
std::size_t expect_streams_all(const scenes::PlacedScene& scene, std::uint32_t leaf_size) {
  SCOPED_TRACE("leaf size " + std::to_string(leaf_size));
  const TreePair pair(scene, leaf_size);
  const TrianglePairs touching = pair.touching(test::brute_force(scene));
  const std::vector<WideLeafPair> leaf_pairs = pair.all_leaf_pairs();
  std::size_t swept = 0;
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    const TrianglePairs found = streamed(pair, leaf_pairs);
    test::expect_contains(found, touching);
    swept = found.size();
  }
  return swept;
}

TEST(Sweep, StreamsEveryPairThatTouchesOnce) {
  test::Seeded seeded(1);
  std::size_t swept = 0, all = 0;
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 40)) {
    SCOPED_TRACE(named.name);
    for (const std::uint32_t leaf_size : {1u, 2u, 3u, 8u, 16u, 17u, 32u, 64u, 256u}) {
      swept += expect_streams_all(named.scene, leaf_size);
      all += 1600;
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_LT(swept, all / 2);  // boxes do their work
}

/// Leaves of every number of triangles, as roots of their trees; far more pairs than a stream holds. All triangles have
/// a corner in the origin, so each pair touches.
TEST(Sweep, StreamsLeavesOfEverySizeWhole) {
  for (int n = 1; n <= 256; ++n) {
    test::Seeded seeded(static_cast<std::uint64_t>(n));
    const int m = n % 3 == 0 ? 257 - n : seeded.random.integer(1, 256);
    const auto soup = [&](int count) {
      scenes::MeshData data = scenes::integer_soup(seeded.random, count, 6);
      for (std::size_t t = 0; t < data.triangles.size(); t += 3) std::fill_n(&data.xyz[3 * data.triangles[t]], 3, 0.0);
      return data;
    };
    const TreePair pair(scenes::pair_scene(soup(n), soup(m)), 256);
    const std::vector<WideLeafPair> leaf_pairs = pair.all_leaf_pairs();
    ASSERT_EQ(leaf_pairs.size(), 1u);
    TrianglePairs every_pair;
    for (std::uint32_t a = 0; a < pair.first().count(); ++a)
      for (std::uint32_t b = 0; b < pair.second().count(); ++b) every_pair.emplace_back(a, b);
    const std::vector<std::int64_t> sets = test::instruction_sets();
    const test::OnInstructionSet on(sets[static_cast<std::size_t>(n) % sets.size()]);
    ASSERT_EQ(streamed(pair, leaf_pairs), every_pair);
  }
}

/// Many leaf pairs that yield one pair, or none, among some that yield hundreds.
TEST(Sweep, StreamsLongListsOfLeafPairs) {
  test::Seeded seeded(5);
  const auto soup = [&](double size) { return scenes::triangle_soup(seeded.random, 500, size); };
  for (const double size : {0.02, 0.5})
    for (const std::uint32_t leaf_size : {1u, 7u, 40u}) {
      const scenes::PlacedScene scene = scenes::pair_scene(soup(size), soup(0.5));
      const TreePair pair(scene, leaf_size);
      const TrianglePairs swept = streamed(pair, pair.all_leaf_pairs());
      ASSERT_NO_FATAL_FAILURE(test::expect_contains(swept, pair.touching(test::brute_force(scene))));
      EXPECT_LT(swept.size(), 500u * 500);
    }
}

/// What the stream holds before is kept, and counts as full when it is.
TEST(Sweep, AppendsToWhatIsThere) {
  test::Seeded seeded(6);
  const auto soup = [&] { return scenes::integer_soup(seeded.random, 30, 2); };
  const TreePair pair(scenes::pair_scene(soup(), soup()), 16);
  const std::vector<WideLeafPair> leaf_pairs = pair.all_leaf_pairs();
  const TrianglePairs expected = streamed(pair, leaf_pairs);
  for (std::size_t before = 0; before <= PairStream::kCapacity; before += 37) {
    const auto sweep = std::make_unique<partition::Sweep>();
    const auto stream = std::make_unique<PairStream>();
    sweep->begin(leaf_pairs, pair.relation());
    stream->size = before;
    std::fill(stream->id_a, stream->id_a + before, 0xFFFFFFFF);
    TrianglePairs found;
    for (std::size_t begin = before;; begin = 0) {
      const bool done = sweep->fill(*stream);
      ASSERT_LE(begin, stream->size);
      ASSERT_LE(stream->size, PairStream::kCapacity);
      for (std::size_t i = 0; i < begin; ++i) ASSERT_EQ(stream->id_a[i], 0xFFFFFFFF);
      for (std::size_t i = begin; i < stream->size; ++i) found.emplace_back(stream->id_a[i], stream->id_b[i]);
      if (done) break;
      stream->size = 0;
    }
    EXPECT_EQ(test::sorted_once(std::move(found)), expected);
  }
}

/// The stream's promise: an affine map takes the world to the frame of A's leaf, and each coordinate of either triangle
/// is within `error` of where the map takes the world's vertex. Exactly, in rationals.
class Coordinates {
 public:
  Coordinates(const TreePair& pair, const WideLeafPair& leaves)
      : a_(mapped(pair.first(), pair, *leaves.a)), b_(mapped(pair.second(), pair, *leaves.a)) {}

  void expect_true(const PairStream& stream) {
    for (std::size_t i = 0; i < stream.size; ++i) {
      ASSERT_NO_FATAL_FAILURE(expect_true(a_[stream.id_a[i]], stream.a, i, stream.error[i]));
      ASSERT_NO_FATAL_FAILURE(expect_true(b_[stream.id_b[i]], stream.b, i, stream.error[i]));
    }
  }
  [[nodiscard]] double greatest_share() const { return greatest_; }

 private:
  using Corners = std::array<Rational3, 3>;

  static std::vector<Corners> mapped(const TreePair::Side& side, const TreePair& pair,
                                     const hierarchy::WideLeaf& leaf) {
    const test::Unposed unposed(pair.first().pose, pair.first().tree.unit_exponent());
    std::vector<Corners> triangles;
    for (const Triangle& world : side.world())
      triangles.push_back({test::in_frame(leaf.frame, unposed(world[0])), test::in_frame(leaf.frame, unposed(world[1])),
                           test::in_frame(leaf.frame, unposed(world[2]))});
    return triangles;
  }

  void expect_true(const Corners& exact, const float (&rows)[9][PairStream::kStride], std::size_t lane, float error) {
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t i = 0; i < 3; ++i) {
        const mpq_class off = abs(mpq_class(rows[3 * corner + i][lane]) - exact[corner][i]);
        ASSERT_LE(off, mpq_class(error));
        greatest_ = std::max(greatest_, mpq_class(off / mpq_class(error)).get_d());
      }
  }

  std::vector<Corners> a_, b_;
  double greatest_ = 0;
};

/// Returns the greatest share of an error that was used up.
double expect_true_coordinates(const scenes::PlacedScene& scene, std::uint32_t leaf_size) {
  const TreePair pair(scene, leaf_size);
  double greatest = 0;
  for (const WideLeafPair& leaves : pair.all_leaf_pairs()) {
    Coordinates coordinates(pair, leaves);
    for (const std::int64_t set : test::instruction_sets()) {
      const test::OnInstructionSet on(set);
      stream_all({leaves}, pair.relation(), [&](const PairStream& stream) { coordinates.expect_true(stream); });
    }
    greatest = std::max(greatest, coordinates.greatest_share());
    if (testing::Test::HasFailure()) break;
  }
  return greatest;
}

TEST(Sweep, CoordinatesAreWithinTheirErrorOnHardScenes) {
  test::Seeded seeded(7);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 16)) {
    SCOPED_TRACE(named.name);
    expect_true_coordinates(named.scene, 8);
    if (testing::Test::HasFailure()) return;
  }
}

/// Matrices off a rotation by 9e-7, vertices and objects far from the origin, meshes of different sizes: some far
/// smaller than what single precision tells apart in the other. Their middles are in one place, up to rounding.
TEST(Sweep, CoordinatesAreWithinTheirErrorFarAwayAndOfAnySize) {
  double greatest = 0;
  int streamed = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    const double reach = std::array{0.0, 1.0, 1e6, 1e15}[seed % 4], off = std::array{0.0, 1e6, 1e15}[seed / 4 % 3];
    const double small = std::ldexp(1.0, -std::array{0, 3, 40, 300}[seed / 12 % 4]);
    const auto soup = [&](double scale) {
      const double half = scale / 2;
      return scenes::shifted(scenes::scaled(scenes::triangle_soup(random, 12, 1), scale, scale, scale), off - half,
                             -half, -off - half);
    };
    scenes::PlacedScene scene = scenes::pair_scene(soup(1), soup(small));
    for (auto& object : scene.objects) {
      object.pose = scenes::random_motion(random, reach);
      if (seed % 3 != 0) object.pose.R = scenes::stretched_rotation(random, 9e-7);
    }
    const Pose& first = scene.objects[0].pose;
    Pose& second = scene.objects[1].pose;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto middle = [&](const Pose& pose) { return off * pose.R[3 * i] - off * pose.R[3 * i + 2]; };
      second.t[i] = first.t[i] + (middle(first) - middle(second));
    }
    const double share = expect_true_coordinates(scene, 4);
    greatest = std::max(greatest, share), streamed += int{share > 0};
    if (testing::Test::HasFailure()) return;
  }
  std::cout << "at most " << greatest << " of an error was used\n";
  EXPECT_GT(greatest, 0.1);  // the errors are not far larger than they need be
  EXPECT_GT(streamed, 90);
}

/// A tiny mesh in the middle of a large leaf, where none of its own errors count: the leaf's own must.
TEST(Sweep, CoordinatesAreWithinTheirErrorInTheMiddleOfALargeLeaf) {
  double greatest = 0;
  for (std::uint64_t seed = 1; seed <= 40u; ++seed) {
    test::Seeded seeded(seed);
    scenes::MeshData large = scenes::shifted(scenes::triangle_soup(seeded.random, 8, 1), -0.5, -0.5, -0.5);
    const scenes::MeshData mirrored = scenes::scaled(large, -1, -1, -1);
    const auto first = static_cast<std::uint32_t>(large.vertex_count());
    large.xyz.insert(large.xyz.end(), mirrored.xyz.begin(), mirrored.xyz.end());
    for (const std::uint32_t v : mirrored.triangles) large.triangles.push_back(first + v);
    const double small = std::ldexp(1.0, -seeded.random.integer(8, 60));
    const scenes::PlacedScene scene =
        scenes::pair_scene(large, scenes::scaled(scenes::triangle_soup(seeded.random, 4, 1), small, small, small));
    greatest = std::max(greatest, expect_true_coordinates(scene, 16));
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(greatest, 0.1);
}

/// A mesh whose extent is 2^-k of the other's, with what they share at the origin.
TEST(Sweep, StreamsWhatTouchesInMeshesOfDifferentSizes) {
  for (const int k : {1, 24, 40, 100, 200, 300}) {
    SCOPED_TRACE(k);
    test::Seeded seeded(static_cast<std::uint64_t>(k));
    const double small = std::ldexp(1.0, -k);
    const scenes::MeshData large = scenes::shifted(scenes::integer_soup(seeded.random, 100, 4), -2, -2, -2);
    scenes::MeshData tiny = scenes::shifted(scenes::integer_soup(seeded.random, 40, 2), -1, -1, -1);
    tiny = scenes::scaled(std::move(tiny), small, small, small);
    for (const std::uint32_t leaf_size : {1u, 16u, 64u}) {
      expect_streams_all(scenes::pair_scene(large, tiny), leaf_size);
      expect_streams_all(scenes::pair_scene(tiny, large), leaf_size);
      if (testing::Test::HasFailure()) return;
    }
    EXPECT_FALSE(test::brute_force(scenes::pair_scene(large, tiny)).empty());
  }
}

}  // namespace
}  // namespace impinge
