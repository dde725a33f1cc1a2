// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/unclear_edges.hpp"

#include <cmath>
#include <numeric>

namespace impinge::solid {
namespace {

bool is_clear(const TriangleTree& tree, const Vec3& point) {
  const double winding = tree.winding_number(point);
  return std::abs(winding - std::round(winding)) <= 0.1;
}

class Prober {
 public:
  Prober(const InnerSearch& search, std::span<const std::vector<std::uint32_t>> components)
      : search_(search),
        components_(components),
        component_of_(search.tree.triangles().size()),
        radius_of_(components.size(), kUnknown) {
    for (std::uint32_t c = 0; c < components.size(); ++c)
      for (const std::uint32_t t : components[c]) component_of_[t] = c;
  }

  /// The place is moved off the middle, and into the triangle by a little: in regular meshes it would be just on edges
  /// of other triangles, where half of their angle counts.
  bool is_clear_beside(const OpenEdge& edge) {
    const Triangle& t = search_.tree.triangles()[edge.triangle];
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    const double length = norm(normal), radius = radius_beside(edge.triangle);
    if (!(radius > 0) || !(length > 0)) return false;
    const Vec3 foot = 0.49 * t[edge.k] + 0.507 * t[(edge.k + 1) % 3] + 0.003 * t[(edge.k + 2) % 3];
    const Vec3 off = (radius / 2 / length) * normal;
    return is_clear(search_.tree, foot - off) && is_clear(search_.tree, foot + off);
  }

 private:
  /// The largest inner radius of the triangle's component.
  double radius_beside(std::uint32_t triangle) {
    constexpr std::size_t kTried = 16;
    const std::uint32_t component = component_of_[triangle];
    double& radius = radius_of_[component];
    if (radius == kUnknown)
      radius = largest_inner_radius(search_, spread_by_area(search_.tree.triangles(), components_[component], kTried));
    return radius;
  }

  static constexpr double kUnknown = -1;
  const InnerSearch& search_;
  std::span<const std::vector<std::uint32_t>> components_;
  std::vector<std::uint32_t> component_of_;  ///< per triangle
  std::vector<double> radius_of_;            ///< per component
};

}  // namespace

UnclearEdges unclear_edges(const InnerSearch& search, std::span<const OpenEdge> edges,
                           std::span<const std::vector<std::uint32_t>> components) {
  constexpr std::size_t kProbed = 128;
  std::vector<double> lengths;
  for (const OpenEdge& edge : edges) {
    const Triangle& t = search.tree.triangles()[edge.triangle];
    lengths.push_back(norm(t[(edge.k + 1) % 3] - t[edge.k]));
  }
  UnclearEdges result;
  result.whole_length = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  std::vector<std::uint32_t> probed(edges.size());
  std::iota(probed.begin(), probed.end(), 0U);
  const bool are_all = edges.size() <= kProbed;
  if (!are_all) probed = spread(lengths, kProbed);

  Prober prober(search, components);
  std::size_t unclear = 0;
  for (const std::uint32_t i : probed) {
    if (search.stop.stop_requested()) break;
    if (prober.is_clear_beside(edges[i])) continue;
    if (unclear++ == 0) result.first = i;
    result.length += are_all ? lengths[i] : result.whole_length / kProbed;
  }
  result.count = are_all ? unclear : edges.size() * unclear / kProbed;
  return result;
}

}  // namespace impinge::solid
