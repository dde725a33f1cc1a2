// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "impinge/mesh.hpp"
#include "impinge/result.hpp"
#include "impinge/workspace.hpp"

/// How near, how deep, inside or out. All lengths are in the caller's unit.
namespace impinge {

struct MeasureOptions {
  int threads = 0;  ///< at most so many; 0: all there are. What searches alone shares the making of trees among them
  std::stop_token stop{};
  double stop_above = std::numeric_limits<double>::infinity();  ///< distances: a greater one is of no interest
  double enough_below = 0;  ///< distances: where one is below this, any below it may be given
};

/// A number known to lie between two others.
struct Interval {
  double lo = 0, hi = 0;
};

/// Two points, one of each mesh, that are nearest to each other.
struct Nearest {
  double distance = 0;  ///< 0 if and only if the meshes share a point
  double error = 0;     ///< the exact distance is within so much of it
  Point a{}, b{};       ///< where, up to rounding
  std::uint32_t triangle_a = 0, triangle_b = 0;
};

/// The distance between two placed meshes as sets of triangles: 0 where triangles touch; what closed meshes enclose
/// does not count. Branch and bound over both trees (Larsen, Gottschalk, Lin and Manocha, "Fast Proximity Queries
/// with Swept Sphere Volumes", 1999, with boxes).
/// A steady series of calls on one thread allocates nothing; memory is the workspace's, or else the thread's own.
/// Infinity, without points, where it is more than `stop_above`.
/// Errors: `bad_pose`, `out_of_range`, `bad_mesh` (one without triangles), `bad_option`, `cancelled`.
Result<Nearest> distance(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                         const MeasureOptions& options = {}, Workspace* workspace = nullptr);

/// Whether some points of the two are nearer to each other than `limit`: exact at 0 (never), and elsewhere wherever the
/// distance is not within its error of the limit. Much faster than the distance itself.
/// Errors and memory: as `distance`; `bad_option` also for a limit that is negative or not a number.
Result<bool> closer_than(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b, double limit,
                         const MeasureOptions& options = {}, Workspace* workspace = nullptr);

enum class Location : std::uint8_t { outside, inside, boundary };

/// Where a point lies to a closed mesh, exactly: on a triangle, or else inside where the mesh winds around it.
/// Errors: `bad_pose`, `out_of_range` (also of the point), `bad_mesh` (not closed: vertices count as one where their
/// world coordinates are equal).
/// Looks through the whole mesh in each call; for many points there is `PointLocator`.
Result<Location> locate(const Point& point, const Mesh& mesh, const Pose& pose = {});

/// A closed mesh at a pose, prepared so that many points are located fast: by the same rule, and as exactly. A grid
/// over its box knows how all points of a cell without triangles lie. A handle: copies are cheap and share it. Safe to
/// use from many threads; one that was moved from may only be destroyed or assigned to.
class PointLocator {
 public:
  /// Errors: as `locate` has them of the mesh; `bad_option` (a negative number of threads).
  static Result<PointLocator> create(const Mesh& mesh, const Pose& pose = {}, int threads = 0);

  /// Where each point lies. Errors: `out_of_range` (names the point), `bad_option`, `cancelled`. Limits on distances
  /// say nothing here.
  [[nodiscard]] Result<std::vector<Location>> locate(std::span<const Point> points,
                                                     const MeasureOptions& options = {}) const;

 private:
  struct State;
  explicit PointLocator(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

/// How deep the boundary of one solid reaches into the other: the greatest distance of a point of a's boundary that
/// lies inside b from b's boundary; and the other way round. 0 where nothing reaches in. This is not the shortest way
/// to pull the two apart, which may be longer or shorter (docs/verdicts.md). That of a `Clash` may be larger: it counts
/// the inner points of one part that the other's material holds as well, so that equal parts have a depth.
struct OverlapDepth {
  Interval a_in_b, b_in_a;
};

/// Each interval holds the true depth for certain; its width is at most `precision` times the depth, unless that is
/// below 2^-42 of the largest |world coordinate|, or would take more than some 130,000 points, and four more for each
/// pair of triangles that touch, to find out. It takes no workspace: what a part is has to be found out anew for each
/// call, beside which memory is nothing. Errors: as `locate`; `bad_option` (precision not in (0, 1]), `cancelled`.
Result<OverlapDepth> overlap_depth(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                                   double precision = 0.01, const MeasureOptions& options = {});

/// How much space two solids have in common.
struct OverlapVolume {
  double volume = 0;
  double error = 0;  ///< it is off by no more, but for what rounding adds, which is estimated
};

/// Where shells of one solid pass through each other, what both wind around counts as often as they do. Found for the
/// second mesh shifted by 2^-30 of what the boxes have in common, or 2^-40 of the largest |world coordinate|: `error`
/// is what the smaller surface there sweeps. Linear in the triangles there and in those that cross.
/// Errors: `bad_pose`, `out_of_range`, `bad_mesh` (not closed, or touching so that no shift parts them), `cancelled`.
Result<OverlapVolume> overlap_volume(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                                     const MeasureOptions& options = {});

}  // namespace impinge
