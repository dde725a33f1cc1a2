// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "impinge/clash.hpp"
#include "scenes/scene.hpp"

/// Pairs of small parts in every way that parts meet, for verdicts. Nothing in them is nearer than a hundredth of their
/// size without touching, overlaps by less, or is thinner, so that a tolerance for rounding changes none of the
/// verdicts.
namespace impinge::scenes {

struct Judgement {
  Verdict verdict = Verdict::apart;
  int inner = -1;  ///< with `inside`: 0 if a lies in b
  friend bool operator==(const Judgement&, const Judgement&) = default;
};

inline constexpr Judgement kDuplicate{Verdict::duplicate}, kInner{Verdict::inside, 0}, kOuter{Verdict::inside, 1},
    kPenetrating{Verdict::penetrating}, kCrossing{Verdict::crossing}, kTouching{Verdict::touching},
    kApart{Verdict::apart};

struct SolidPair {
  std::string name;
  MeshData a, b;
  std::optional<Judgement> known;  ///< by hand or by counting, where that is easy
  bool solids = true;              ///< both are, so that an oracle for solids can judge
};

/// Derived by hand, and in no need of another oracle than the eye.
std::vector<SolidPair> overlapping_pairs();  ///< aligned, with one to three shared planes, with no crossing triangles
std::vector<SolidPair> flush_pairs();        ///< face on face
std::vector<SolidPair> edge_and_vertex_pairs();  ///< all else that may meet, and the same a little deeper and apart
std::vector<SolidPair> inscribed_pairs();        ///< vertices on the other's surface, edges within it
std::vector<SolidPair> nested_pairs();
std::vector<SolidPair> cavity_pairs();
std::vector<SolidPair> duplicate_pairs();
std::vector<SolidPair> inverted_pairs();
std::vector<SolidPair> shell_pairs();    ///< several shells in a part
std::vector<SolidPair> concave_pairs();  ///< notches, grooves, tubes and rods
std::vector<SolidPair> thin_pairs();
std::vector<SolidPair> surface_pairs();     ///< one or both are no solids
std::vector<SolidPair> degenerate_pairs();  ///< segments with solids and with surfaces, alone and as parts of surfaces
/// The same of points. A point has no extent that a tolerance could be small against: they are judged exactly.
std::vector<SolidPair> point_pairs();
std::vector<SolidPair> self_passing_pairs();  ///< a part of two shells that pass through each other

/// Two boxes whose sides lie to each other in three of the thirteen ways in which two intervals can (Allen, 1983), in
/// every combination but for turning the axes: 364 pairs, triangulated at random.
std::vector<SolidPair> interval_pairs(std::uint64_t seed);

/// Convex hulls of a few points of a small lattice, where much coincides, and in general position. Nothing is known.
std::vector<SolidPair> convex_pairs(std::uint64_t seed, int n);

/// Random cells of lattices, judged by counting them; some under an integer affine map, which keeps coordinates exact
/// and the verdict what it is.
std::vector<SolidPair> voxel_pairs(std::uint64_t seed, int n);

struct Family {
  std::string name;
  std::vector<SolidPair> pairs;
};

/// All of them, with the seeds that the tests use.
std::vector<Family> solid_families();

}  // namespace impinge::scenes
