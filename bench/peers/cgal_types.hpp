// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <vector>

#include "bench/peers/common.hpp"

namespace impinge::bench {

/// A tree of boxes over triangles, with a kernel whose predicates decide exactly on the doubles that they are given.
template <class Kernel>
struct CgalTree {
  using Point3 = typename Kernel::Point_3;
  using Triangle3 = typename Kernel::Triangle_3;
  using Triangles = std::vector<Triangle3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, typename Triangles::const_iterator>;
  using Traits = CGAL::AABB_traits<Kernel, Primitive>;
  using Tree = CGAL::AABB_tree<Traits>;
  using Node = CGAL::AABB_node<Traits>;

  static Triangles triangles(const scenes::MeshData& data, const Pose& pose) {
    std::vector<Point3> points;
    points.reserve(data.vertex_count());
    for (const Point& p : placed(data, pose)) points.emplace_back(p.x, p.y, p.z);
    Triangles result;
    result.reserve(data.triangle_count());
    for (std::size_t i = 0; i < data.triangles.size(); i += 3)
      result.emplace_back(points[data.triangles[i]], points[data.triangles[i + 1]], points[data.triangles[i + 2]]);
    return result;
  }

  /// `all_intersected_primitives` of the tree over `a` for each triangle of `b` that may meet its box.
  static void collide(const Triangles& a, const Tree& tree, const Triangles& b, std::vector<TrianglePair>& pairs) {
    std::vector<typename Triangles::const_iterator> hits;
    const CGAL::Bbox_3 box = tree.bbox();
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (!CGAL::do_overlap(box, b[i].bbox())) continue;
      hits.clear();
      tree.all_intersected_primitives(b[i], std::back_inserter(hits));
      for (const auto hit : hits)
        pairs.push_back({static_cast<std::uint32_t>(hit - a.cbegin()), static_cast<std::uint32_t>(i)});
    }
  }
};

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;

}  // namespace impinge::bench
