// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/peers/cgal.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "bench/peers/common.hpp"

namespace impinge::bench {
namespace {

/// Its predicates decide exactly on the doubles that they are given.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

Triangles triangles_of(const scenes::MeshData& data, const Pose& pose) {
  std::vector<Kernel::Point_3> points;
  points.reserve(data.vertex_count());
  for (const Point& p : placed(data, pose)) points.emplace_back(p.x, p.y, p.z);
  Triangles result;
  result.reserve(data.triangle_count());
  for (std::size_t i = 0; i < data.triangles.size(); i += 3)
    result.emplace_back(points[data.triangles[i]], points[data.triangles[i + 1]], points[data.triangles[i + 2]]);
  return result;
}

}  // namespace

struct CgalBody::State {
  Triangles triangles;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree;
  std::vector<TrianglePair> pairs;
};

CgalBody::CgalBody(const scenes::MeshData& data, const Pose& pose) : state_(std::make_unique<State>()) {
  state_->triangles = triangles_of(data, pose);
  state_->tree.insert(state_->triangles.begin(), state_->triangles.end());
}

CgalBody::CgalBody(CgalBody&&) noexcept = default;
CgalBody::~CgalBody() = default;

void CgalBody::build_tree() const { state_->tree.build(); }

std::size_t CgalBody::collide(const CgalBody& b) {
  const Triangles &of_a = state_->triangles, &of_b = b.state_->triangles;
  state_->pairs.clear();
  std::vector<Triangles::const_iterator> hits;
  const CGAL::Bbox_3 box = state_->tree.bbox();
  for (std::size_t i = 0; i < of_b.size(); ++i) {
    if (!CGAL::do_overlap(box, of_b[i].bbox())) continue;
    hits.clear();
    state_->tree.all_intersected_primitives(of_b[i], std::back_inserter(hits));
    for (const auto hit : hits)
      state_->pairs.push_back({static_cast<std::uint32_t>(hit - of_a.cbegin()), static_cast<std::uint32_t>(i)});
  }
  return state_->pairs.size();
}

bool CgalBody::touches(const CgalBody& b) const {
  const CGAL::Bbox_3 box = state_->tree.bbox();
  return std::any_of(b.state_->triangles.begin(), b.state_->triangles.end(), [&](const Kernel::Triangle_3& triangle) {
    return CGAL::do_overlap(box, triangle.bbox()) && state_->tree.do_intersect(triangle);
  });
}

std::vector<TrianglePair> CgalBody::pairs() const { return sorted(state_->pairs); }

struct CgalSurface::State {
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
};

CgalSurface::CgalSurface(const scenes::MeshData& data) : state_(std::make_unique<State>()) {
  auto& mesh = state_->mesh;
  using Vertex = CGAL::Surface_mesh<Kernel::Point_3>::Vertex_index;
  for (const Point& p : placed(data, {})) mesh.add_vertex(Kernel::Point_3(p.x, p.y, p.z));
  for (std::size_t i = 0; i < data.triangles.size(); i += 3)
    mesh.add_face(Vertex(data.triangles[i]), Vertex(data.triangles[i + 1]), Vertex(data.triangles[i + 2]));
}

CgalSurface::~CgalSurface() = default;

std::vector<TrianglePair> CgalSurface::self_intersections() const {
  using Face = CGAL::Surface_mesh<Kernel::Point_3>::Face_index;
  std::vector<std::pair<Face, Face>> found;
  CGAL::Polygon_mesh_processing::self_intersections(state_->mesh, std::back_inserter(found));
  std::vector<TrianglePair> pairs;
  for (const auto& [f, g] : found) pairs.push_back({std::min<std::uint32_t>(f, g), std::max<std::uint32_t>(f, g)});
  return sorted(std::move(pairs));
}

}  // namespace impinge::bench
