// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "clash/measured_part.hpp"
#include "impinge/clash.hpp"
#include "impinge/mesh.hpp"
#include "solid/body.hpp"
#include "solid/part.hpp"

/// Makes the parts of a scene ready to be judged in pairs.
namespace impinge {

/// A mesh and where it stands in the world.
struct Placed {
  const Mesh* mesh;  ///< null: the object has no mesh, or was left out
  Pose pose;
};

/// Counts the steps of a query in the caller's `Progress`, if there is one.
class Steps {
 public:
  explicit Steps(Progress* progress) : progress_(progress) {}
  void begin(std::uint64_t total) const {
    if (progress_ != nullptr) progress_->done = 0, progress_->total = total;
  }
  void step() const {
    if (progress_ != nullptr) progress_->done.fetch_add(1, std::memory_order_relaxed);
  }

 private:
  Progress* progress_;
};

/// The tolerance that is applied to parts whose largest |world coordinate| is `largest`.
inline double tolerance_of(const ClashOptions& options, double largest) {
  return options.tolerance.value_or(0x1p-20 * largest);
}

inline Error cancelled() { return {Code::cancelled, "the query was stopped before it was complete"}; }

/// The placed meshes to be searched for defects. With a tolerance a mesh is searched once, in its own frame, however
/// many objects have it; without one each object is searched where it stands, since rounding differs from pose to pose.
struct DefectChecks {
  struct Check : Placed {
    bool pose_independent;  ///< the mesh is searched in its own frame, so the result holds for every object that has it
  };
  std::vector<Check> placed;
  std::vector<std::size_t> of_object;  ///< per object, the index of its check
};

DefectChecks list_defect_checks(const std::vector<Placed>& objects, const ClashOptions& options);

/// One placed mesh with what judging needs. Internal walls are shells with the interior, or the exterior, on both
/// sides: they are no boundary, and verdicts ignore them.
struct Part {
  clash::MeasuredPart judged;              ///< without internal walls: world triangles, adjacency, shells and measures
  std::optional<Mesh> mesh_without_walls;  ///< the mesh that `judged` refers to, where internal walls were left out
  std::optional<solid::Part> with_walls;   ///< then also the part with them, for contacts, regions and distances

  [[nodiscard]] const solid::Part& whole() const { return with_walls ? *with_walls : judged.part; }
};

/// The objects' world vertices; an empty body for an object without a mesh.
std::vector<solid::Body> bodies_of(const std::vector<Placed>& objects, int threads);

/// Searches each of `checks` for defects and makes a part of each object; `bodies` are the objects'. A step is counted
/// for each check and each object. Errors: `cancelled`.
Result<std::vector<Part>> make_parts(const std::vector<Placed>& objects, std::vector<solid::Body> bodies,
                                     const DefectChecks& checks, const ClashOptions& options);

}  // namespace impinge
