// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/motion/moving_scene.hpp"

#include <cstdint>
#include <utility>

namespace impinge::report {

Result<void> MovingScene::move_to(std::vector<Posed> posed) {
  for (std::uint32_t i = 0; i < posed.size(); ++i) {
    const ObjectId id{.index = i};  // the first at its index
    const Posed &now = posed[i], &before = posed_[i];
    if (&now.mesh.state() != &before.mesh.state()) {
      if (auto set = scene_.set_mesh(id, now.mesh, now.pose); !set) return set;
    } else if (now.pose.R != before.pose.R || now.pose.t != before.pose.t) {
      if (auto set = scene_.set_pose(id, now.pose); !set) return set;
    }
  }
  posed_ = std::move(posed);
  return {};
}

}  // namespace impinge::report
