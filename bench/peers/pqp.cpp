// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/peers/pqp.hpp"

#include <PQP.h>

#include "bench/peers/common.hpp"

namespace impinge::bench {

struct PqpMesh::State {
  PQP_Model model;
  PQP_CollideResult result;
};

PqpMesh::PqpMesh(const scenes::MeshData& data) : state_(std::make_unique<State>()) {
  state_->model.BeginModel(static_cast<int>(data.triangle_count()));
  for (std::size_t i = 0; i < data.triangles.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return &data.xyz[3 * data.triangles[i + k]]; };
    state_->model.AddTri(corner(0), corner(1), corner(2), static_cast<int>(i / 3));
  }
  state_->model.EndModel();
}

PqpMesh::PqpMesh(PqpMesh&&) noexcept = default;
PqpMesh::~PqpMesh() = default;

std::size_t PqpMesh::collide(const Pose& pose_a, const PqpMesh& b, const Pose& pose_b, std::size_t limit) {
  RowsAndPlace a_at(pose_a), b_at(pose_b);
  PQP_Collide(&state_->result, a_at.rows, a_at.place, &state_->model, b_at.rows, b_at.place, &b.state_->model,
              limit == 1 ? PQP_FIRST_CONTACT : PQP_ALL_CONTACTS);
  return static_cast<std::size_t>(state_->result.NumPairs());
}

std::vector<TrianglePair> PqpMesh::pairs() const {
  std::vector<TrianglePair> pairs;
  for (int i = 0; i < state_->result.NumPairs(); ++i)
    pairs.push_back(
        {static_cast<std::uint32_t>(state_->result.Id1(i)), static_cast<std::uint32_t>(state_->result.Id2(i))});
  return sorted(std::move(pairs));
}

}  // namespace impinge::bench
