// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/refit_plan.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/vec3.hpp"
#include "hierarchy/carried_axes.hpp"

namespace impinge::hierarchy {
namespace {

/// More do not make tighter boxes to speak of.
constexpr std::uint32_t kNodeSamples = RefitPlan::kMostSamples, kLeafSamples = 5;

class Planner {
 public:
  Planner(const SoupSource& source, const RefitPlan* before)
      : source_(source), before_(before), listed_(source.mesh.vertices.size()), place_(source.mesh.vertices.size()) {}

  /// Returns its place in `nodes` or `leaves`.
  std::uint32_t add(const TreeRef& ref) { return ref.is_leaf() ? add_leaf(ref.leaf()) : add_node(ref.node()); }

  RefitPlan plan;

 private:
  std::uint32_t add_leaf(const WideLeaf& leaf) {
    const auto first = static_cast<std::uint32_t>(plan.order.size());
    plan.order.insert(plan.order.end(), leaf.ids(), leaf.ids() + leaf.count);
    const RefitPlan::Vertices vertices = list(first, leaf.count);
    plan.leaves.push_back(
        {fit(leaf.frame, {&vertices, 1}, kLeafSamples), first, leaf.count, vertices, plan.corners.size()});
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::uint32_t i = first; i < first + leaf.count; ++i)
        plan.corners.push_back(static_cast<std::uint16_t>(place_[source_.mesh.triangles[plan.order[i]][corner]]));
    return static_cast<std::uint32_t>(plan.leaves.size() - 1);
  }

  std::uint32_t add_node(const WideNode& node) {
    const auto number = static_cast<std::uint32_t>(plan.nodes.size());
    plan.nodes.emplace_back();
    RefitPlan::Node planned{.size = node.size, .depth = node.depth, .split_cost = cost_of(node)};
    for (std::uint32_t lane = 0; lane < node.size; ++lane) {
      const TreeRef child(node.child[lane].load(std::memory_order_acquire));
      planned.first[lane] = static_cast<std::uint32_t>(plan.order.size()), planned.count[lane] = node.count[lane];
      planned.child[lane] = add(child), planned.is_leaf[lane] = child.is_leaf();
      planned.vertices[lane] =
          child.is_leaf() ? plan.leaves[planned.child[lane]].vertices : list(planned.first[lane], planned.count[lane]);
    }
    planned.axes = fit(node.frame, {planned.vertices, planned.size}, kNodeSamples);
    plan.nodes[number] = planned;
    return number;
  }

  [[nodiscard]] float cost_of(const WideNode& node) const {
    return node.planned == WideNode::kNotPlanned ? node.cost : before_->nodes[node.planned].split_cost;
  }

  /// The vertices of triangles in the order.
  RefitPlan::Vertices list(std::uint32_t first, std::uint32_t count) {
    const auto begin = static_cast<std::uint32_t>(plan.vertices.size());
    ++lists_;
    for (std::uint32_t i = first; i < first + count; ++i) {
      for (const std::uint32_t v : source_.mesh.triangles[plan.order[i]]) {
        if (std::exchange(listed_[v], lists_) == lists_) continue;
        place_[v] = static_cast<std::uint32_t>(plan.vertices.size()) - begin;
        plan.vertices.push_back(v);
      }
    }
    return {begin, static_cast<std::uint32_t>(plan.vertices.size()) - begin};
  }

  /// Axes turn by the linear map that fits best, in least squares, vertices out of these lists.
  RefitPlan::Axes fit(const Frame& frame, std::span<const RefitPlan::Vertices> lists, std::uint32_t most) {
    std::uint32_t count = 0;
    for (const RefitPlan::Vertices& each : lists) count += each.count;
    const std::uint32_t size = std::min(count, most);
    RefitPlan::Axes axes{.first_sample = static_cast<std::uint32_t>(plan.samples.size()), .samples = size};
    std::copy(&frame.axes[0][0], &frame.axes[0][0] + 12, &axes.axes[0][0]);

    std::array<Vec3, kNodeSamples> points;
    Vec3 mean{};
    for (std::uint32_t k = 0; k < size; ++k) {
      auto at = static_cast<std::uint32_t>(std::uint64_t{k} * count / size);
      const RefitPlan::Vertices* of = lists.data();
      for (; at >= of->count; ++of) at -= of->count;
      plan.samples.push_back({of->first + at, {}});
      points[k] = source_.vertex(plan.vertices[of->first + at]);
      if (k > 0) points[k] = points[k] - points[0];
      mean = mean + (k > 0 ? 1.0 / size : 0.0) * points[k];
    }
    points[0] = {};
    double reach = 0;
    for (std::uint32_t k = 0; k < size; ++k)
      points[k] = points[k] - mean, reach = std::max(reach, max_component(abs(points[k])));
    if (!(reach > 0)) return axes;
    // Across a plane or a line the map is open; the least of these makes it 0 there.
    Mat3 covariance{Vec3{0x1p-20, 0, 0}, Vec3{0, 0x1p-20, 0}, Vec3{0, 0, 0x1p-20}};
    for (std::uint32_t k = 0; k < size; ++k) {
      const Vec3 p = points[k] = (1 / reach) * points[k];
      covariance[0] = covariance[0] + p.x * p, covariance[1] = covariance[1] + p.y * p;
      covariance[2] = covariance[2] + p.z * p;
    }
    const Mat3 weights = inverse(covariance);
    for (std::uint32_t k = 0; k < size; ++k)
      for (int i = 0; i < 3; ++i)
        plan.samples[axes.first_sample + k].coefficient[i] =
            static_cast<float>(dot(axis_of(frame, i), weights * points[k]));
    return axes;
  }

  const SoupSource& source_;
  const RefitPlan* before_;
  std::vector<std::uint32_t> listed_, place_;  ///< of each vertex, the last list that it is in, and where in it
  std::uint32_t lists_ = 0;
};

}  // namespace

std::size_t RefitPlan::bytes() const {
  const auto bytes_of = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
  return sizeof(RefitPlan) + bytes_of(nodes) + bytes_of(leaves) + bytes_of(samples) + bytes_of(order) +
         bytes_of(vertices) + bytes_of(corners);
}

std::shared_ptr<const RefitPlan> make_refit_plan(const TreeRef& root, const SoupSource& source,
                                                 const RefitPlan* before) {
  Planner planner(source, before);
  planner.add(root);
  // Beyond, what was counted in 32 bits is wrong.
  if (std::max(planner.plan.vertices.size(), planner.plan.samples.size()) > UINT32_MAX) return nullptr;
  return std::make_shared<const RefitPlan>(std::move(planner.plan));
}

}  // namespace impinge::hierarchy
