// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Verdicts on small parts in every way that parts meet (scenes/solid_pairs.hpp), against the oracle for solids and
/// against what is known by hand of surfaces: exactly, and with the tolerance for rounding wherever they stand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "impinge/clash.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solid_pairs.hpp"
#include "scenes/solids.hpp"
#include "tests/oracle/expected.hpp"

namespace impinge {
namespace {

using scenes::Family;
using scenes::Judgement;
using scenes::MeshData;
using scenes::Random;
using scenes::SolidPair;

constexpr double kExactly = 0;
constexpr std::optional<double> kForRounding = std::nullopt;

struct Placed {
  Mesh mesh;
  Pose pose{};
};

Mesh mesh_of(const MeshData& data) { return Mesh::create(data.xyz, data.triangles).value(); }

Judgement swapped(Judgement judgement) {
  judgement.inner = judgement.inner < 0 ? -1 : 1 - judgement.inner;
  return judgement;
}

/// Nothing, and a failed test, if there is no verdict or it does not fit together.
std::optional<Clash> judged(const Placed& a, const Placed& b, std::optional<double> tolerance) {
  ClashOptions options;
  options.tolerance = tolerance;
  Result<Clash> clash = judge(a.mesh, a.pose, b.mesh, b.pose, options);
  if (!clash) {
    ADD_FAILURE() << "No verdict: " << clash.error().message;
    return std::nullopt;
  }
  EXPECT_EQ(clash->objects, (std::array<std::uint32_t, 2>{0, 1}));
  EXPECT_EQ(clash->verdict == Verdict::inside, clash->inner == 0 || clash->inner == 1);
  if (tolerance == kExactly) {
    EXPECT_EQ(clash->note, clash->tolerance == 0 ? Note::none : Note::tolerance_raised);
  }
  return *std::move(clash);
}

std::optional<Clash> expect_verdict(const Judgement& expected, const Placed& a, const Placed& b,
                                    std::optional<double> tolerance) {
  std::optional<Clash> clash = judged(a, b, tolerance);
  if (clash) {
    EXPECT_EQ(expected, (Judgement{clash->verdict, clash->inner})) << "Note " << static_cast<int>(clash->note);
  }
  return clash;
}

/// Both ways round; what was found is that of the first.
std::optional<Clash> expect_verdicts(const Judgement& expected, const Placed& a, const Placed& b,
                                     std::optional<double> tolerance) {
  std::optional<Clash> clash = expect_verdict(expected, a, b, tolerance);
  const testing::ScopedTrace trace(__FILE__, __LINE__, "swapped");
  expect_verdict(swapped(expected), b, a, tolerance);
  return clash;
}

Mesh mapped(const Mesh& mesh, const Pose& pose, double scale = 1) {
  Affine map{.m = pose.R, .t = pose.t};
  for (double& x : map.m) x *= scale;
  return mesh.transformed(map).value();
}

/// The same place after `motion` (up to rounding) from a mesh whose own frame is elsewhere: equal vertices of two parts
/// then differ by some ulps.
Placed from_own_frame(const MeshData& mesh, const Pose& motion, Random& random) {
  std::array<double, 3> shift{};
  for (double& s : shift) s = random.integer(-20, 20);
  Pose pose = motion;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) pose.t[i] += motion.R[3 * i + k] * shift[k];
  return {mesh_of(scenes::shifted(mesh, -shift[0], -shift[1], -shift[2])), pose};
}

class Verdicts : public testing::TestWithParam<Family> {
 protected:
  using Check = std::function<void(const SolidPair&, const Judgement&, Random&)>;
  static void each(const Check& check, std::size_t first = 0, std::size_t stride = 1) {
    const std::vector<SolidPair>& pairs = GetParam().pairs;
    for (std::size_t i = first; i < pairs.size(); i += stride) {
      const SolidPair& pair = pairs[i];
      const testing::ScopedTrace trace(__FILE__, __LINE__, pair.name + ", drawn with seed " + std::to_string(i + 1));
      Random random(i + 1);
      check(pair, pair.known ? *pair.known : expected::judgement(pair), random);
    }
  }
  /// Of families drawn at random, which are large, every fifth pair from `first` on: each pair has two of ten
  /// properties.
  static void some(std::size_t first, const Check& check) {
    const bool is_large = GetParam().pairs.size() >= 80;
    each(check, is_large ? first : 0, is_large ? 5 : 1);
  }
};

/// And of parts that are closed and do not meet themselves some tolerance would excuse the pair if and only if their
/// interiors meet.
TEST_P(Verdicts, AreExact) {
  std::size_t solids = 0, exact = 0;
  each([&](const SolidPair& pair, const Judgement& expected, Random&) {
    const auto clash = expect_verdicts(expected, {mesh_of(pair.a)}, {mesh_of(pair.b)}, kExactly);
    solids += pair.solids;
    if (!pair.solids || !clash || clash->tolerance > 0) return;
    EXPECT_EQ(clash->note, Note::none);
    EXPECT_EQ(clash->fails_below > 0, expected.verdict < Verdict::touching);
    ++exact;
  });
  if (GetParam().name == "SelfPassing") {
    EXPECT_GT(exact, 0u);
  } else {
    EXPECT_EQ(exact, solids);
  }
}

TEST_P(Verdicts, AreTheSameWhicheverWayNormalsLook) {
  some(0, [](const SolidPair& pair, const Judgement& expected, Random&) {
    expect_verdict(expected, {mesh_of(scenes::inverted(pair.a))}, {mesh_of(pair.b)}, kExactly);
    expect_verdict(expected, {mesh_of(pair.a)}, {mesh_of(scenes::inverted(pair.b))}, kExactly);
  });
}

TEST_P(Verdicts, AreTheSameInWhicheverOrder) {
  some(1, [](const SolidPair& pair, const Judgement& expected, Random& random) {
    const auto mixed = [&](const MeshData& mesh) { return mesh_of(scenes::shuffled(mesh, random)); };
    expect_verdicts(expected, {mixed(pair.a)}, {mixed(pair.b)}, kExactly);
    expect_verdict(expected, {mixed(scenes::unshared(pair.a))}, {mixed(pair.b)}, kExactly);
    expect_verdict(expected, {mixed(pair.a)}, {mixed(scenes::unshared(pair.b))}, kExactly);
  });
}

TEST_P(Verdicts, AreTheSameInAScene) {
  some(2, [](const SolidPair& pair, const Judgement& expected, Random& random) {
    for (const std::optional<double> tolerance : {std::optional(kExactly), kForRounding}) {
      Scene scene;
      ASSERT_TRUE(scene.add(mesh_of(pair.a)));
      ASSERT_TRUE(scene.add(mesh_of(pair.b)));
      ClashOptions options;
      options.tolerance = tolerance;
      options.threads = random.integer(0, 2);
      const Result<Clashes> clashes = find_clashes(scene, options);
      ASSERT_TRUE(clashes) << clashes.error().message;
      Judgement found;
      if (!clashes->pairs.empty()) {
        EXPECT_EQ(clashes->pairs.size(), 1u);
        found = {clashes->pairs[0].verdict, clashes->pairs[0].inner};
      }
      EXPECT_EQ(expected, found);
      ASSERT_EQ(clashes->parts.size(), 2u);
      for (const PartFacts& part : clashes->parts) EXPECT_TRUE(!pair.solids || part.part_class == PartClass::solid);
    }
  });
}

TEST_P(Verdicts, AreTheSameWithAToleranceForRounding) {
  some(3, [](const SolidPair& pair, const Judgement& expected, Random&) {
    expect_verdicts(expected, {mesh_of(pair.a)}, {mesh_of(pair.b)}, kForRounding);
  });
}

TEST_P(Verdicts, AreTheSameAfterARigidMotion) {
  some(4, [](const SolidPair& pair, const Judgement& expected, Random& random) {
    const Mesh a = mesh_of(pair.a), b = mesh_of(pair.b);
    const double reach = std::array{0.0, 10.0, 100.0}[static_cast<std::size_t>(random.integer(0, 2))];
    const Pose motion = scenes::random_motion(random, reach);
    SCOPED_TRACE("moved by up to " + std::to_string(reach));
    expect_verdicts(expected, {a, motion}, {b, motion}, kForRounding);
    expect_verdict(expected, {mapped(a, motion)}, {mapped(b, motion)}, kForRounding);
    expect_verdict(expected, {mapped(a, motion)}, {b, motion}, kForRounding);
  });
}

TEST_P(Verdicts, AreTheSameFromFramesOfTheirOwn) {
  some(0, [](const SolidPair& pair, const Judgement& expected, Random& random) {
    const Pose motion = scenes::random_motion(random, 10);
    expect_verdicts(expected, from_own_frame(pair.a, motion, random), from_own_frame(pair.b, motion, random),
                    kForRounding);
  });
}

TEST_P(Verdicts, AreTheSameAfterAMotionThatIsNotQuiteRigid) {
  some(1, [](const SolidPair& pair, const Judgement& expected, Random& random) {
    const Pose motion{.R = scenes::stretched_rotation(random)};
    expect_verdicts(expected, {mesh_of(pair.a), motion}, {mesh_of(pair.b), motion}, kForRounding);
  });
}

TEST_P(Verdicts, AreTheSameInAnyUnit) {
  some(2, [](const SolidPair& pair, const Judgement& expected, Random& random) {
    const Mesh a = mesh_of(pair.a), b = mesh_of(pair.b);
    for (const double scale : {1e-3, 1e3}) {
      SCOPED_TRACE("scaled by " + std::to_string(scale));
      expect_verdict(expected, {mapped(a, {}, scale)}, {mapped(b, {}, scale)}, kForRounding);
      const Pose motion = scenes::random_motion(random, 10 * scale);
      expect_verdict(expected, {mapped(a, motion, scale)}, {mapped(b, motion, scale)}, kForRounding);
    }
  });
}

TEST_P(Verdicts, AreExactFarFromTheOrigin) {
  // The sums are exact, or rounded alike.
  const Pose far{.t = {0x1p20, -0x1p20, 0x1p20}};
  some(3, [&](const SolidPair& pair, const Judgement& expected, Random&) {
    expect_verdicts(expected, {mesh_of(pair.a), far}, {mesh_of(pair.b), far}, kExactly);
  });
}

TEST_P(Verdicts, AreTheSameFarFromTheOrigin) {
  some(4, [](const SolidPair& pair, const Judgement& expected, Random& random) {
    // The tolerance is about 1 there: parts of millimetres that stand a kilometre away are larger than that.
    Pose motion = scenes::random_motion(random, 1);
    motion.t = {1e6, -1e6, 1e6};
    const Mesh a = mesh_of(pair.a), b = mesh_of(pair.b);
    expect_verdict(expected, {mapped(a, motion, 1e3)}, {mapped(b, motion, 1e3)}, kForRounding);
    const Pose shift{.t = motion.t};
    expect_verdict(expected, {mapped(a, {}, 1e3), shift}, {mapped(b, {}, 1e3), shift}, kForRounding);
  });
}

INSTANTIATE_TEST_SUITE_P(Families, Verdicts, testing::ValuesIn(scenes::solid_families()),
                         [](const auto& family) { return family.param.name; });

TEST(Points, AreJudgedExactly) {
  for (const SolidPair& pair : scenes::point_pairs()) {
    SCOPED_TRACE(pair.name);
    for (const std::optional<double> tolerance : {std::optional(kExactly), kForRounding})
      expect_verdicts(*pair.known, {mesh_of(pair.a)}, {mesh_of(pair.b)}, tolerance);
  }
}

/// Cubes with sides of 8, side by side but for this much of a gap.
std::optional<Clash> cubes(double gap, std::optional<double> tolerance) {
  return judged({mesh_of(scenes::box({-8, 0, 0}, {0, 8, 8}))}, {mesh_of(scenes::box({gap, 0, 0}, {8, 8, 8}))},
                tolerance);
}

TEST(Tolerance, IsAMillionthOfBothPartsByDefault) {
  for (const double sign : {-1.0, 1.0}) {
    const auto within = cubes(sign * 0x1p-16, kForRounding), beyond = cubes(sign * 0x1p-14, kForRounding);
    ASSERT_TRUE(within && beyond);
    EXPECT_NEAR(within->tolerance, 2 * 0x1p-20 * 8 * std::sqrt(3), 0x1p-30);
    EXPECT_EQ(within->verdict, Verdict::touching);
    EXPECT_EQ(within->note, sign < 0 ? Note::none : Note::gap_within_tolerance);  // an overlap is a rounding
    EXPECT_EQ(beyond->verdict, sign < 0 ? Verdict::penetrating : Verdict::apart);
    EXPECT_EQ(beyond->note, Note::none);
  }
}

TEST(Tolerance, OfNothingMeansExactly) {
  for (const auto& [gap, verdict] :
       {std::pair{-0x1p-50, Verdict::penetrating}, {0.0, Verdict::touching}, {0x1p-50, Verdict::apart}}) {
    const auto clash = cubes(gap, kExactly);
    ASSERT_TRUE(clash);
    EXPECT_EQ(clash->verdict, verdict) << gap;
  }
}

TEST(Tolerance, CannotBeNegativeOrNoNumber) {
  const Mesh cube = mesh_of(scenes::cube());
  for (const double wrong : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    ClashOptions tolerance, clearance;
    tolerance.tolerance = wrong;
    clearance.clearance = wrong;
    for (const ClashOptions& options : {tolerance, clearance}) {
      const Result<Clash> clash = judge(cube, {}, cube, {}, options);
      ASSERT_FALSE(clash);
      EXPECT_EQ(clash.error().code, Code::bad_option);
    }
  }
}

}  // namespace
}  // namespace impinge
