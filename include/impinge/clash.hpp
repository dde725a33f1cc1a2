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

/// What a design review asks of two parts (docs/verdicts.md): how deep one reaches into the other, and whether that is
/// more than the tolerance.
namespace impinge {

/// The first four are of parts that reach into each other by more than the tolerance, or through each other.
enum class Verdict : std::uint8_t {
  duplicate,    ///< each lies in the other
  inside,       ///< one lies in the other
  penetrating,  ///< two parts with an inside reach into each other
  crossing,     ///< a surface reaches into a part with an inside, or two surfaces reach through each other
  touching,     ///< they are no farther apart than the tolerance
  apart,
};

/// What the tolerance did to a verdict.
enum class Note : std::uint8_t {
  none,
  overlap_within_tolerance,  ///< they reach into each other, by no more than the tolerance
  gap_within_tolerance,      ///< they are apart, by no more than the tolerance
  undecided,                 ///< they may reach into each other by more than the tolerance; it could not be told
  tolerance_raised,          ///< to the least that such coordinates can tell
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
  /// Parts that reach into each other by no more than this are taken to touch. Nothing: for each pair what rounding its
  /// coordinates leaves, 2^-20 of the diagonal of each part's box and 2^-41 of the largest |world coordinate|, and for
  /// a mesh of single-precision numbers 2^-22 of its largest |coordinate| and of its |translation|. 0: exactly, if both
  /// parts are closed and do not meet themselves. What lies between 0 and 2^-42 of the largest |world coordinate| is
  /// raised to that, and so is 0 for other parts.
  std::optional<double> tolerance;
  double clearance = 0;  ///< pairs nearer than this are listed with their distance, though they are apart
  /// How wide the interval of a depth may be, relative to the depth, of what fails; infinity: verdicts alone.
  double depth_precision = 0.05;
  bool regions = false;               ///< find regions of contact
  bool volumes = false;               ///< find how much space solids that overlap have in common
  int threads = 0;                    ///< at most so many; 0: all there are
  std::string_view backend = "simd";  ///< what finds contacts, as `Options::backend`; the answer is the same
  /// With `find_clashes`: fills the empty list with the terms on which objects a < b are judged, one `Clash` for each;
  /// a pair without terms is left out. Called from several threads at once. `tolerance` above then says nothing, and
  /// `clearance` how near parts must be to be asked about: no less than each tolerance and clearance of the terms.
  std::function<void(std::uint32_t a, std::uint32_t b, std::vector<ClashTerms>& terms)> terms{};
  Progress* progress = nullptr;  ///< of `find_clashes`: counts meshes looked through, parts and pairs
  std::stop_token stop{};
};

inline constexpr std::uint64_t kMostContacts = std::uint64_t{1} << 22;

/// Two parts and what is said of them.
struct Clash {
  std::array<std::uint32_t, 2> objects{};  ///< the lower first
  std::uint32_t test = 0;                  ///< of the terms on which they were judged
  Verdict verdict = Verdict::apart;
  int inner = -1;  ///< with `inside`: 0 if the first object lies in the second, 1 if the second in the first
  Note note = Note::none;
  double tolerance = 0;  ///< that was applied
  /// The pair fails at `tolerance` if and only if that is below this; infinity if no tolerance excuses it: each goes
  /// through the other, or two surfaces are the same. So it does, if it fails here, at every tolerance below this, and
  /// at none from the larger `hi` of `overlap_depth` on; of those between, only a call that asks about one tells. What
  /// reaches in by less than the least tolerance of the call may count as nothing. Where verdicts alone are asked for,
  /// infinity or 0.
  double fails_below = 0;
  /// Pairs of triangles that share a point, by Kind; of more than `kMostContacts` the first ones. (Each triangle about
  /// a vertex touches all about the same place in the other part.)
  std::array<std::uint64_t, 3> contacts{};
  /// With a clearance, of pairs that do not touch and are nearer than it: those inside of each other too.
  std::optional<Nearest> nearest;
  /// How deep each reaches into the other, if that has an inside: at least `lo`, by which verdicts go, and at most
  /// `hi`; of the lesser of the two, and of what does not fail, only narrow enough to say so. It may be larger than the
  /// function `overlap_depth` has it, which knows boundaries alone: inner points of one part that the other's material
  /// holds count too. Nothing for two surfaces, for parts of which neither is known to reach in, and where verdicts
  /// alone are asked for.
  std::optional<OverlapDepth> overlap_depth;
  /// With `volumes`, as `overlap_volume` finds it, of two parts whose pieces are all solid and that overlap, if only
  /// within the tolerance. Nothing for others, and where `overlap_volume` refuses them.
  std::optional<OverlapVolume> overlap_volume;
  /// With `regions`, within `tolerance`, of automatic ones within 2^-20 of the largest |world coordinate| at least;
  /// exact ones where `contact_regions` would refuse so many pairs.
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

/// What a part is: of its mesh, in whose own frame it is found, but for the places of edges. Lengths in the caller's
/// unit.
struct PartFacts {
  PartClass part_class = PartClass::surface;  ///< the best class of its pieces
  bool closed = false;                        ///< it has no open edge
  std::array<std::uint32_t, 3> pieces{};      ///< how many there are, by class
  std::uint64_t turned = 0;                   ///< triangles that had to be turned to find the classes
  std::uint64_t unclear_edges = 0;      ///< open edges beside which winding is not clear; of more than 128 an estimate
  std::optional<Segment> unclear_edge;  ///< the first of them
  std::uint64_t open_edges = 0;
  std::optional<Segment> open_edge;  ///< the first of them
  /// Pairs of its triangles that cross or share an area, of the first `kMostContacts` that meet: reported, but it has
  /// an inside all the same.
  std::uint64_t self_crossings = 0;
  std::optional<TrianglePair> self_crossing;  ///< the first of them
  std::uint64_t degenerate = 0;               ///< triangles whose vertices are collinear
  double volume = 0, area = 0;                ///< the volume of its solid pieces
  double radius = 0;  ///< the largest of some balls that fit inside, of no more than 64 places in each piece
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
