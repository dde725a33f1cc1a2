// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "impinge/measures.hpp"
#include "impinge/mesh.hpp"
#include "impinge/options.hpp"
#include "impinge/regions.hpp"
#include "impinge/result.hpp"
#include "impinge/scene.hpp"

/// What a design review asks of two parts (docs/verdicts.md). A part is a solid if it is closed (by position) and no
/// two of its triangles cross or share an area; its interior is where its boundary winds around points, whichever way
/// its normals look. Anything else is a surface.
namespace impinge {

/// The first that holds.
enum class Verdict : std::uint8_t {
  duplicate,    ///< the same set of points
  inside,       ///< one's interior contains the other's, in contact or not; or a surface lies within a solid
  penetrating,  ///< the interiors of two solids meet
  crossing,     ///< a surface passes through a solid's boundary, or through a surface
  touching,     ///< they share a point
  apart,
};

/// What the tolerance did to a verdict.
enum class Note : std::uint8_t {
  none,
  overlap_within_tolerance,  ///< exactly they overlap, by no more than the tolerance
  outside_within_tolerance,  ///< exactly some of the inner part is outside, by no more than the tolerance
  gap_within_tolerance,      ///< exactly they are apart, by no more than the tolerance
  equal_within_tolerance,    ///< exactly they are not the same, but no point of one is farther from the other
  tolerance_not_applied,     ///< it is above a quarter of one part's wall, or below what rounding leaves of such
                             ///< coordinates: the verdict is the exact one
};

/// On what terms two parts are judged where a scene is put to several tests.
struct ClashTerms {
  std::optional<double> tolerance;  ///< as in `ClashOptions`
  double clearance = 0;             ///< likewise
  Verdict last = Verdict::apart;    ///< what comes after this in `Verdict` is left out
  std::uint32_t test = 0;           ///< the caller's own number, which `Clash::test` repeats
  friend bool operator==(const ClashTerms&, const ClashTerms&) = default;
};

struct ClashOptions {
  /// Parts that overlap by no more than this, for certain, are taken to touch. Nothing: 2^-20 of the largest |world
  /// coordinate| of each pair, which is what rotating flush parts in files of single precision leaves. 0: exactly.
  std::optional<double> tolerance;
  double clearance = 0;  ///< pairs nearer than this are listed with their distance, though they are apart
  bool depth = false;    ///< measure overlap depths of what penetrates
  bool regions = false;  ///< find regions of contact
  int threads = 0;       ///< at most so many; 0: all there are
  /// With `find_clashes`: fills the empty list with the terms on which objects a < b are judged, one `Clash` for each;
  /// a pair without terms is left out. Called from several threads at once. `tolerance` above then says only what
  /// counts as a solid, and `clearance` how near parts must be to be asked about: no less than each tolerance and
  /// clearance of the terms.
  std::function<void(std::uint32_t a, std::uint32_t b, std::vector<ClashTerms>& terms)> terms{};
  Progress* progress = nullptr;  ///< of `find_clashes`: counts meshes looked through, parts and pairs
  std::stop_token stop{};
};

/// Two parts and what is said of them.
struct Clash {
  std::array<std::uint32_t, 2> objects{};  ///< the lower first
  std::uint32_t test = 0;                  ///< of the terms on which they were judged
  Verdict verdict = Verdict::apart;
  int inner = -1;  ///< with `inside`: 0 if the first object lies in the second, 1 if the second in the first
  Note note = Note::none;
  double tolerance = 0;                     ///< that was applied
  std::array<std::uint64_t, 3> contacts{};  ///< pairs of triangles that share a point, by Kind
  /// With a clearance, of pairs that do not touch and are nearer than it: those inside of each other too.
  std::optional<Nearest> nearest;
  std::optional<OverlapDepth> overlap_depth;  ///< with `depth`, of two solids that penetrate or lie inside
  /// With `regions`, within `tolerance`; exact ones where `contact_regions` would refuse so many pairs.
  std::vector<Region> regions;
};

/// What a part, or a piece of it, is by winding numbers (Jacobson et al., 2013): how often triangles wind around a
/// point, an integer where they are closed. Triangles are first turned to agree with their neighbours, and closed
/// shells outwards. A piece is what hangs together by vertices and is closed, with its cavities; all that is not closed
/// is one piece more. The best first.
enum class PartClass : std::uint8_t {
  solid,    ///< closed, with an inside, though it may meet itself
  cracked,  ///< not closed, but beside its open edges it is clear what is inside: seams that gape, missing triangles
  surface,  ///< anything else
};

/// What a part is. Lengths in the caller's unit.
struct PartFacts {
  bool solid = false, closed = false;         ///< as verdicts have it
  PartClass part_class = PartClass::surface;  ///< the best class of its pieces; verdicts do not go by it yet
  std::array<std::uint32_t, 3> pieces{};      ///< how many there are, by class
  std::uint64_t turned = 0;                   ///< triangles that had to be turned to find the classes
  std::uint64_t unclear_edges = 0;      ///< open edges beside which winding is not clear; of more than 128 an estimate
  std::optional<Segment> unclear_edge;  ///< the first of them
  std::uint64_t open_edges = 0, self_crossings = 0;  ///< what keeps it from being a solid
  std::uint64_t degenerate = 0;                      ///< triangles whose world vertices are collinear
  std::optional<Segment> open_edge;                  ///< the first of them
  std::optional<TrianglePair> self_crossing;         ///< likewise
  double volume = 0, area = 0;
  double wall = 0;  ///< of a solid: 2 volume / area, the thickness of a sheet of that volume and area
};

struct Clashes {
  /// By (object, object), and each pair in the order of its terms; those that are apart and not nearer than the
  /// clearance left out.
  std::vector<Clash> pairs;
  std::vector<PartFacts> parts;  ///< by object index
  std::uint64_t candidates = 0;  ///< pairs whose bounds are near enough, and that there are terms for
  double parts_seconds = 0;      ///< wall clock: to see what the parts are
  double pairs_seconds = 0;      ///< and to judge the pairs
};

/// What `find_clashes` found out, for its next call on the same scene: what an object is that neither moved nor changed
/// its mesh since, and what two such objects are to each other on the same terms, is not found out again. Answers are
/// the same with it and without. It holds what the last call saw of the scene's objects and of its candidates, and
/// nothing of earlier ones; with another scene, another tolerance or after an error it is filled anew. One query uses
/// it at a time. One that was moved from may only be destroyed or assigned to.
class ClashMemory {
 public:
  ClashMemory();
  ~ClashMemory();
  ClashMemory(ClashMemory&&) noexcept;
  ClashMemory& operator=(ClashMemory&&) noexcept;
  ClashMemory(const ClashMemory&) = delete;
  ClashMemory& operator=(const ClashMemory&) = delete;

  /// How many of the last call's candidates were known from the call before.
  [[nodiscard]] std::size_t known_pairs() const noexcept;

  struct State;  // internal

 private:
  friend Result<Clashes> find_clashes(const Scene& scene, const ClashOptions& options, ClashMemory* memory);
  std::unique_ptr<State> state_;
};

/// Every pair of a scene's objects that is not apart, or nearer than the clearance. Objects of one group and ignored
/// pairs are left out. It takes no workspace: the queries within use their threads' own memory again and again, and
/// what else is made goes into the answer, and for a scene whose objects move into a memory to keep. Errors: as
/// `Scene::collide`; `bad_option` (tolerance or clearance negative or not finite, or terms that reach farther than the
/// options).
Result<Clashes> find_clashes(const Scene& scene, const ClashOptions& options = {}, ClashMemory* memory = nullptr);

/// The verdict on two placed meshes, objects 0 and 1, whatever it is. Errors and memory: likewise.
Result<Clash> judge(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                    const ClashOptions& options = {});

/// What one placed mesh is. Errors: `bad_pose`, `out_of_range`, `bad_option`.
Result<PartFacts> examine(const Mesh& mesh, const Pose& pose = {}, const ClashOptions& options = {});

/// "penetrating" and so on; "solid" and so on; a sentence about the note, "" for none.
std::string_view name(Verdict verdict);
std::string_view name(PartClass part_class);
std::string_view sentence(Note note);

}  // namespace impinge
