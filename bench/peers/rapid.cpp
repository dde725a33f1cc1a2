// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/peers/rapid.hpp"

#if __has_include(<RAPID.H>)
#include <RAPID.H>
#else
#include <RAPID.h>
#endif

#include "bench/peers/common.hpp"

namespace impinge::bench {

struct RapidMesh::State {
  RAPID_model model;
};

RapidMesh::RapidMesh(const scenes::MeshData& data) : state_(std::make_unique<State>()) {
  state_->model.BeginModel();
  for (std::size_t i = 0; i < data.triangles.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return &data.xyz[3 * data.triangles[i + k]]; };
    state_->model.AddTri(corner(0), corner(1), corner(2), static_cast<int>(i / 3));
  }
  state_->model.EndModel();
}

RapidMesh::RapidMesh(RapidMesh&&) noexcept = default;
RapidMesh::~RapidMesh() = default;

std::size_t RapidMesh::collide(const Pose& pose_a, const RapidMesh& b, const Pose& pose_b, std::size_t limit) {
  RowsAndPlace a_at(pose_a), b_at(pose_b);
  RAPID_Collide(a_at.rows, a_at.place, &state_->model, b_at.rows, b_at.place, &b.state_->model,
                limit == 1 ? RAPID_FIRST_CONTACT : RAPID_ALL_CONTACTS);
  return static_cast<std::size_t>(RAPID_num_contacts);
}

std::vector<TrianglePair> RapidMesh::pairs() const {
  std::vector<TrianglePair> pairs;
  for (int i = 0; i < RAPID_num_contacts; ++i)
    pairs.push_back(
        {static_cast<std::uint32_t>(RAPID_contact[i].id1), static_cast<std::uint32_t>(RAPID_contact[i].id2)});
  return sorted(std::move(pairs));
}

}  // namespace impinge::bench
