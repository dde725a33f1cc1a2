// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/peers/cgal.hpp"

#include <algorithm>

#include "bench/peers/cgal_types.hpp"

namespace impinge::bench {

struct CgalBody::State {
  CgalTree<Epick>::Triangles triangles;
  CgalTree<Epick>::Tree tree;
  std::vector<TrianglePair> pairs;
};

CgalBody::CgalBody(const scenes::MeshData& data, const Pose& pose) : state_(std::make_unique<State>()) {
  state_->triangles = CgalTree<Epick>::triangles(data, pose);
  state_->tree.insert(state_->triangles.begin(), state_->triangles.end());
}

CgalBody::CgalBody(CgalBody&&) noexcept = default;
CgalBody::~CgalBody() = default;

void CgalBody::build_tree() const { state_->tree.build(); }

std::size_t CgalBody::collide(const CgalBody& b) {
  state_->pairs.clear();
  CgalTree<Epick>::collide(state_->triangles, state_->tree, b.state_->triangles, state_->pairs);
  return state_->pairs.size();
}

bool CgalBody::touches(const CgalBody& b) const {
  const CGAL::Bbox_3 box = state_->tree.bbox();
  return std::any_of(b.state_->triangles.begin(), b.state_->triangles.end(), [&](const Epick::Triangle_3& triangle) {
    return CGAL::do_overlap(box, triangle.bbox()) && state_->tree.do_intersect(triangle);
  });
}

std::vector<TrianglePair> CgalBody::pairs() const { return sorted(state_->pairs); }

}  // namespace impinge::bench
