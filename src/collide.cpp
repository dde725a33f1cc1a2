// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/collide.hpp"

#include "core/guarded.hpp"
#include "mesh_state.hpp"
#include "pipeline.hpp"
#include "scene/scene_view.hpp"
#include "scene/validate_pose.hpp"

namespace impinge {

Result<Contacts> collide(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                         const Options& options) {
  return guarded([&]() -> Result<Contacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    for (const Pose* pose : {&pose_a, &pose_b})
      if (auto valid = scene::validate(*pose); !valid) return valid.error();

    const MeshState &a = mesh_a.state(), &b = mesh_b.state();
    const std::array<scene::PlacedObject, 2> objects{scene::place(a.data, pose_a, 0), scene::place(b.data, pose_b, 0)};
    const std::array<hierarchy::ObbTree*, 2> trees{&a.tree, &b.tree};
    return run_pipeline({{objects, nullptr}, trees, nullptr, options});
  });
}

}  // namespace impinge
