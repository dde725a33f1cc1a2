// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/peers/cgal_ways.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <cmath>

#include "bench/peers/cgal_types.hpp"

namespace impinge::bench {
namespace {

using Frame = CgalTree<Epick>;  // the mesh in its own frame
using Box = CGAL::Bbox_3;

/// Boxes of the second body in the first one's frame.
class BoxMap {
 public:
  /// `reach` bounds the coordinates of the mesh. The relative pose and what it moves are off by a few units in the last
  /// place of the largest number that takes part; a thousand of them leave no doubt.
  BoxMap(const Pose& a, const Pose& b, double reach) : pose_(relative(a, b)) {
    double largest = 2 * reach;
    for (const Pose* pose : {&a, &b, static_cast<const Pose*>(&pose_)})
      for (const double t : pose->t) largest += std::fabs(t);
    margin_ = 1000 * 0x1p-52 * largest;
  }

  [[nodiscard]] Box box(const Box& own) const {
    double low[3], high[3];
    for (int i = 0; i < 3; ++i) {
      double center = pose_.t[static_cast<std::size_t>(i)], half = margin_;
      for (int k = 0; k < 3; ++k) {
        const double entry = pose_.R[static_cast<std::size_t>(3 * i + k)];
        center += entry * (own.min(k) + own.max(k)) / 2;
        half += std::fabs(entry) * (own.max(k) - own.min(k)) / 2;
      }
      low[i] = center - half;
      high[i] = center + half;
    }
    return {low[0], low[1], low[2], high[0], high[1], high[2]};
  }

  [[nodiscard]] Box box(const std::vector<Point>& moved, const std::uint32_t* corners) const {
    const Point &p = moved[corners[0]], &q = moved[corners[1]], &r = moved[corners[2]];
    return {std::min({p.x, q.x, r.x}) - margin_, std::min({p.y, q.y, r.y}) - margin_,
            std::min({p.z, q.z, r.z}) - margin_, std::max({p.x, q.x, r.x}) + margin_,
            std::max({p.y, q.y, r.y}) + margin_, std::max({p.z, q.z, r.z}) + margin_};
  }

  [[nodiscard]] const Pose& pose() const { return pose_; }

 private:
  Pose pose_;
  double margin_;
};

/// Traversal traits: the primitives whose boxes meet the query's.
struct ListPrimitives {
  std::vector<const Frame::Primitive*>& found;

  [[nodiscard]] bool go_further() const { return true; }
  [[nodiscard]] bool do_intersect(const Box& query, const Frame::Node& node) const {
    return CGAL::do_overlap(query, node.bbox());
  }
  void intersection(const Box& query, const Frame::Primitive& primitive) const {
    if (CGAL::do_overlap(query, primitive.id()->bbox())) found.push_back(&primitive);
  }
};

/// Traversal traits: whether there is one.
struct AnyPrimitive {
  bool found = false;

  [[nodiscard]] bool go_further() const { return !found; }
  [[nodiscard]] bool do_intersect(const Box& query, const Frame::Node& node) const {
    return CGAL::do_overlap(query, node.bbox());
  }
  void intersection(const Box& query, const Frame::Primitive& primitive) {
    found = found || CGAL::do_overlap(query, primitive.id()->bbox());
  }
};

}  // namespace

struct CgalWays::State {
  explicit State(const scenes::MeshData& mesh) : data(mesh) {}

  const scenes::MeshData& data;
  Frame::Triangles triangles;
  Frame::Tree tree;
  CgalTree<CGAL::Epeck>::Triangles epeck_triangles;
  CgalTree<CGAL::Epeck>::Tree epeck_tree;
  double reach = 0;
  std::vector<TrianglePair> pairs;
  std::vector<const Frame::Primitive*> hits;

  [[nodiscard]] Epick::Triangle_3 world_triangle(const Pose& pose, std::size_t i) const {
    const auto corner = [&](std::size_t k) {
      const double* p = &data.xyz[3 * static_cast<std::size_t>(data.triangles[3 * i + k])];
      const Point q = placed(pose, {p[0], p[1], p[2]});
      return Epick::Point_3(q.x, q.y, q.z);
    };
    return {corner(0), corner(1), corner(2)};
  }

  /// Triangle `i` of the second body, whose box in the first one's frame is `box`.
  void test(const Pose& a, const Pose& b, const Box& box, std::size_t i) {
    hits.clear();
    ListPrimitives list{hits};
    tree.traversal(box, list);
    if (hits.empty()) return;
    const Epick::Triangle_3 moving = world_triangle(b, i);
    for (const Frame::Primitive* hit : hits) {
      const auto j = static_cast<std::size_t>(hit->id() - triangles.cbegin());
      if (CGAL::do_intersect(world_triangle(a, j), moving))
        pairs.push_back({static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(i)});
    }
  }
};

namespace {

/// Traversal traits of the second body's tree, whose query is the first one's.
template <class State>
struct TwoTrees {
  State& state;
  const Pose &a, &b;
  const BoxMap& map;

  [[nodiscard]] bool go_further() const { return true; }
  [[nodiscard]] bool do_intersect(const Frame::Tree& other, const Frame::Node& node) const {
    AnyPrimitive any;
    other.traversal(map.box(node.bbox()), any);
    return any.found;
  }
  void intersection(const Frame::Tree&, const Frame::Primitive& primitive) const {
    const auto i = static_cast<std::size_t>(primitive.id() - state.triangles.cbegin());
    state.test(a, b, map.box(primitive.id()->bbox()), i);
  }
};

}  // namespace

CgalWays::CgalWays(const scenes::MeshData& data) : state_(std::make_unique<State>(data)) {
  state_->triangles = Frame::triangles(data, {});
  state_->tree.insert(state_->triangles.begin(), state_->triangles.end());
  state_->tree.build();
  state_->epeck_triangles = CgalTree<CGAL::Epeck>::triangles(data, {});
  state_->epeck_tree.insert(state_->epeck_triangles.begin(), state_->epeck_triangles.end());
  state_->epeck_tree.build();
  for (const double x : data.xyz) state_->reach = std::max(state_->reach, std::fabs(x));
}

CgalWays::~CgalWays() = default;

void CgalWays::moved_triangles(const Pose& a, const Pose& b) {
  state_->pairs.clear();
  Frame::collide(state_->triangles, state_->tree, Frame::triangles(state_->data, relative(a, b)), state_->pairs);
}

void CgalWays::moved_triangles_epeck(const Pose& a, const Pose& b) {
  state_->pairs.clear();
  CgalTree<CGAL::Epeck>::collide(state_->epeck_triangles, state_->epeck_tree,
                                 CgalTree<CGAL::Epeck>::triangles(state_->data, relative(a, b)), state_->pairs);
}

void CgalWays::own_boxes(const Pose& a, const Pose& b) {
  state_->pairs.clear();
  const BoxMap map(a, b, state_->reach);
  const std::vector<Point> moved = placed(state_->data, map.pose());
  const Box whole = state_->tree.bbox();
  for (std::size_t i = 0; i < state_->triangles.size(); ++i) {
    const Box box = map.box(moved, &state_->data.triangles[3 * i]);
    if (CGAL::do_overlap(whole, box)) state_->test(a, b, box, i);
  }
}

void CgalWays::own_two_trees(const Pose& a, const Pose& b) {
  state_->pairs.clear();
  const BoxMap map(a, b, state_->reach);
  TwoTrees<State> walk{*state_, a, b, map};
  state_->tree.traversal(state_->tree, walk);
}

std::vector<TrianglePair> CgalWays::pairs() const { return sorted(state_->pairs); }

}  // namespace impinge::bench
