// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "impinge/measures.hpp"
#include "impinge/mesh.hpp"
#include "impinge/result.hpp"
#include "impinge/workspace.hpp"

/// When rigid bodies meet that move from one pose to another.
namespace impinge {

/// How a rigid body moves from a pose at time 0 to another at time 1.
struct Sweep {
  enum class Path : std::uint8_t {
    screw,     ///< it turns about an axis and glides along it, at constant speed: the screw of to * from⁻¹
    straight,  ///< each vertex moves on a straight line, as in `find_impacts`: a body that turns is not rigid on the
               ///< way
  };
  Pose from, to;
  Path path = Path::screw;
  /// Of a screw: whole turns beside the least angle, which is from 0 to half a turn; -1 is the other way round. (Half a
  /// turn goes one of both ways, the same for the same poses.)
  int turns = 0;
};

/// A body that stands still.
inline Sweep at_rest(const Pose& pose) { return {pose, pose, Sweep::Path::screw, 0}; }

/// The pose at a time from 0 to 1, rounded: `from` at 0, `to` at 1.
/// Errors: as `time_of_impact` has them of a sweep; `bad_option` (a time that is not from 0 to 1; a straight path on
/// which the body turns, where there are no poses).
Result<Pose> pose_at(const Sweep& sweep, double time);

/// The first contact of two bodies, or their first approach.
struct TimeOfImpact {
  Interval time;   ///< they share no point before `lo`
  double gap = 0;  ///< at `time.hi`; 0: they share a point then (straight paths: within `time`), exactly
  Point a{}, b{};  ///< where, of each body, up to rounding
};

/// When two placed meshes first meet; nothing if they do not.
///
/// Screws: conservative. Before `time.lo` no two triangles share a point, neither on the way in real arithmetic nor at
/// any `pose_at`; at `time.hi`, which is the same time, they do, or are nearer than the tolerance and some of their
/// triangles approach each other, as far as bounds tell. What passes at a distance above the tolerance is never
/// reported. The tolerance, a length, is raised to what rounding needs: some 2^-40 of the largest world coordinate, and
/// of the way, for each radian that is turned, and eight times what the matrices of the poses are off rotations, as
/// parts of it. By conservative advancement (Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996)
/// over both trees: each pair of nodes has a time of its own, its distance over its speeds, and pairs of triangles one
/// along the direction between them.
///
/// Straight paths: exact, by `find_impacts`, for any tolerance; `time` holds the first contact between equal or
/// neighbouring doubles. Both bodies are on straight paths, or one is on a screw that does not turn, which is straight.
///
/// Errors: `bad_pose`, `out_of_range` (also on the way), `bad_mesh` (one without triangles), `bad_option` (a tolerance
/// that is not a number above 0; turns of a straight path, or where the least angle is below 2^-10 and tells no axis; a
/// straight path beside a screw that turns), `cancelled`. Limits on distances say nothing here.
Result<std::optional<TimeOfImpact>> time_of_impact(const Mesh& mesh_a, const Sweep& sweep_a, const Mesh& mesh_b,
                                                   const Sweep& sweep_b, double tolerance,
                                                   const MeasureOptions& options = {}, Workspace* workspace = nullptr);

}  // namespace impinge
