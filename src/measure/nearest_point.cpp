// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pose.hpp"
#include "exact/triangle_pair.hpp"
#include "measure/nearest.hpp"
#include "measure/pair_walk.hpp"
#include "measure/triangle_distance.hpp"

namespace impinge::measure {
namespace {

using hierarchy::Frame;
using hierarchy::kWidth;
using hierarchy::PlacedTree;
using hierarchy::TreeRef;
using hierarchy::WideLeaf;
using hierarchy::WideNode;

/// The point in the mesh's coordinates and unit, and what bounds need to know of the way there.
struct MeshPoint {
  Vec3 at;
  double error;  ///< of a coordinate, in the unit: as of a body that is this point (hierarchy/tree_relation.cpp)
  double unit;

  MeshPoint(const PlacedTree& body, const Vec3& point) : unit(std::ldexp(1.0, body.tree->unit_exponent())) {
    const Vec3 t{body.pose.t[0], body.pose.t[1], body.pose.t[2]};
    at = (1 / unit) * (inverse(to_mat3(body.pose.R)) * (point - t));
    const Vec3 all = body.mesh->max_abs + abs(t) + abs(point);
    error = 0x1p-47 / unit * (all.x + all.y + all.z);
  }
};

/// A part of a length in a frame that it may lack in the world: 1.5 * 2^-20 for the frame, 1.5e-6 for the pose.
constexpr double kShrink = 1 - 0x1p-17;

/// The point as a frame has it, with a radius: in single precision it is off by u of its coordinates, and gaps of boxes
/// by a few u of those and the boxes'.
struct LocalPoint {
  float x[3], radius;

  LocalPoint(const MeshPoint& point, const Frame& frame) {
    const Vec3 r = point.at - Vec3{frame.origin[0], frame.origin[1], frame.origin[2]};
    constexpr double kFar = 1e18;  // squares must not overflow, and nearer than it is only makes bounds lower
    double most = frame.radius;
    for (int i = 0; i < 3; ++i) {
      const double v = double{frame.axes[0][i]} * r.x + double{frame.axes[1][i]} * r.y + double{frame.axes[2][i]} * r.z;
      x[i] = static_cast<float>(std::clamp(v, -kFar, kFar));
      most = std::max(most, std::abs(double{x[i]}));
    }
    radius = static_cast<float>(std::min(2 * point.error + 0x1p-20 * most, 1e30)) + 0x1p-100f;
  }
};

void bound_boxes(const WideNode& node, const LocalPoint& p, float* lower) {
  float squares[kWidth] = {};
  for (int i = 0; i < 3; ++i) {
    for (int lane = 0; lane < kWidth; ++lane) {
      const float gap = std::max(std::abs(node.center[i][lane] - p.x[i]) - (node.half[i][lane] + p.radius), 0.0f);
      squares[lane] += gap * gap;
    }
  }
  for (int lane = 0; lane < kWidth; ++lane) lower[lane] = std::sqrt(squares[lane]);
}

void bound_triangles(const WideLeaf& leaf, const LocalPoint& p, float* lower) {
  const float radius = p.radius + leaf.error;
  for (std::uint32_t t = 0; t < leaf.count; ++t) {
    float square = 0;
    for (int i = 0; i < 3; ++i) {
      const float x = leaf.row(i)[t], y = leaf.row(i + 3)[t], z = leaf.row(i + 6)[t];
      const float lo = std::min(x, std::min(y, z)), hi = std::max(x, std::max(y, z));
      const float gap = std::max(std::max(lo - p.x[i], p.x[i] - hi) - radius, 0.0f);
      square += gap * gap;
    }
    lower[t] = std::sqrt(square);
  }
}

class PointSearch {
 public:
  PointSearch(const PlacedTree& body, const Vec3& point, double within, double enough)
      : body_(body), point_(point), local_(body, point), enough_(enough), limit_(within) {}

  std::optional<NearestPoint> run(const std::stop_token& stop) {
    struct Open {
      TreeRef ref;
      double lower;
    };
    hierarchy::MadeNodes made;
    std::vector<Open> open{{body_.tree->root(made), 0}};
    while (!open.empty() && !is_done()) {
      if (stop.stop_requested()) return std::nullopt;
      const auto [ref, lower_here] = open.back();
      open.pop_back();
      if (lower_here > limit_) continue;
      if (ref.is_leaf()) {
        search(ref.leaf());
        continue;
      }
      WideNode& node = ref.node();
      float lower[kWidth];
      bound_boxes(node, LocalPoint(local_, node.frame), lower);
      const auto old_size = static_cast<std::ptrdiff_t>(open.size());
      for (int lane = 0; lane < static_cast<int>(node.size); ++lane)
        if (world(lower[lane]) <= limit_) open.push_back({body_.tree->child(node, lane, made), world(lower[lane])});
      std::sort(open.begin() + old_size, open.end(), [](const Open& p, const Open& q) { return p.lower > q.lower; });
    }
    if (best_ && best_->distance > 0) best_->error = std::max(best_->error, best_->distance - least_);
    return best_;
  }

 private:
  [[nodiscard]] bool is_done() const { return best_ && (best_->distance == 0 || best_->distance < enough_); }
  [[nodiscard]] double world(float lower) const { return local_.unit * (kShrink * double{lower}); }

  void search(const WideLeaf& leaf) {
    float lower[kMostInLeaf];
    bound_triangles(leaf, LocalPoint(local_, leaf.frame), lower);
    for (std::uint32_t i = 0; i < leaf.count && !is_done(); ++i)
      if (world(lower[i]) <= limit_) test(leaf.ids()[i]);
  }

  void test(std::uint32_t id) {
    const Triangle triangle = world_triangle(body_, id);
    const TriangleDistance d = point_distance(point_, triangle, limit_);
    least_ = std::min(least_, d.lower);
    const bool is_on = d.lower == 0 && exact::classify({point_, point_, point_}, triangle);
    if (!is_on && (d.lower > limit_ || d.distance > limit_)) return;
    // Elsewhere the distance is above 0, even if it was rounded to 0.
    limit_ = is_on ? 0 : std::max(d.distance, std::numeric_limits<double>::denorm_min());
    best_ = {limit_, is_on ? 0 : d.margin, is_on ? point_ : d.b, id};
  }

  const PlacedTree& body_;
  const Vec3 point_;
  const MeshPoint local_;
  const double enough_;
  double limit_;                                            ///< what is farther is of no interest
  double least_ = std::numeric_limits<double>::infinity();  ///< nothing that was passed over is nearer
  std::optional<NearestPoint> best_;
};

}  // namespace

std::optional<NearestPoint> nearest_point(const PlacedTree& body, const Vec3& point, double within, double enough,
                                          const std::stop_token& stop) {
  if (body.mesh->triangles.empty()) return std::nullopt;
  return PointSearch(body, point, within, enough).run(stop);
}

void near_triangles(const PlacedTree& body, const Vec3& point, double within,
                    const std::function<void(std::uint32_t)>& take) {
  const MeshPoint local(body, point);
  const auto is_near = [&](float lower) { return local.unit * (kShrink * double{lower}) <= within; };
  hierarchy::MadeNodes made;
  std::vector<TreeRef> open;
  if (!body.mesh->triangles.empty()) open.push_back(body.tree->root(made));
  while (!open.empty()) {
    const TreeRef ref = open.back();
    open.pop_back();
    float lower[kMostInLeaf];
    if (ref.is_leaf()) {
      bound_triangles(ref.leaf(), LocalPoint(local, ref.leaf().frame), lower);
      for (std::uint32_t i = 0; i < ref.leaf().count; ++i)
        if (is_near(lower[i])) take(ref.leaf().ids()[i]);
      continue;
    }
    WideNode& node = ref.node();
    bound_boxes(node, LocalPoint(local, node.frame), lower);
    for (int lane = 0; lane < static_cast<int>(node.size); ++lane)
      if (is_near(lower[lane])) open.push_back(body.tree->child(node, lane, made));
  }
}

}  // namespace impinge::measure
