// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/pseudo_normal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace impinge::clash {
namespace {

class Surface {
 public:
  Surface(const LinkedPart& part, const LocalFrame& frame) : part_(part), frame_(frame) {}

  [[nodiscard]] Triangle local(std::uint32_t triangle) const {
    return frame_.to_local(part_.part.body.triangle(triangle));
  }

  /// Of unit length; nothing where its error may be above 2^-20 (see make_slab).
  [[nodiscard]] std::optional<Vec3> normal(std::uint32_t triangle) const {
    const Triangle t = local(triangle);
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const double length = norm(n);
    const double longest = std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
    if (!(length > 0x1p-30 * longest * (longest + frame_.scale))) return std::nullopt;
    return (1 / length) * n;
  }

  /// The edge from a corner to the next.
  [[nodiscard]] std::optional<Vec3> at_edge(std::uint32_t triangle, std::size_t corner) const {
    const auto corners = corners_of(triangle);
    const std::uint32_t from = corners[corner], to = corners[(corner + 1) % 3];
    const auto next = across(triangle, from, to);
    if (!next) return std::nullopt;
    const auto own = normal(triangle), other = normal(next->triangle);
    if (!own || !other) return std::nullopt;
    return *own + next->turn * *other;
  }

  [[nodiscard]] std::optional<Vec3> at_vertex(std::uint32_t triangle, std::size_t corner) const {
    const std::uint32_t vertex = corners_of(triangle)[corner];
    const std::size_t size = fan(vertex).size();
    if (size > kMost) return std::nullopt;
    Vec3 sum{0, 0, 0};
    std::size_t seen = 0;
    Turned at{triangle, 1};
    do {
      const auto corners = corners_of(at.triangle);
      const auto k = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
      const auto n = normal(at.triangle);
      if (!n) return std::nullopt;
      sum = sum + at.turn * angle(local(at.triangle), k) * *n;
      // Those that are turned are gone around the other way.
      const auto next = across(at.triangle, vertex, corners[(k + (at.turn > 0 ? 2 : 1)) % 3]);
      if (!next) return std::nullopt;
      at = {next->triangle, at.turn * next->turn};
    } while (at.triangle != triangle && ++seen < size);
    return at.triangle == triangle && at.turn > 0 && seen + 1 == size ? std::optional(sum) : std::nullopt;
  }

 private:
  static constexpr std::size_t kMost = 64;

  struct Turned {
    std::uint32_t triangle;
    int turn;  ///< -1 where its normal looks the other way
  };

  [[nodiscard]] std::array<std::uint32_t, 3> corners_of(std::uint32_t triangle) const {
    const auto& [a, b, c] = part_.part.body.placed.mesh->triangles[triangle];
    const auto& position = part_.part.topology.position;
    return {position[a], position[b], position[c]};
  }

  [[nodiscard]] std::span<const std::uint32_t> fan(std::uint32_t position) const {
    const auto& [offsets, triangles] = part_.fans;
    return std::span(triangles).subspan(offsets[position], offsets[position + 1] - offsets[position]);
  }

  /// The one other triangle at an edge.
  [[nodiscard]] std::optional<Turned> across(std::uint32_t triangle, std::uint32_t p, std::uint32_t q) const {
    const auto runs = [&](std::uint32_t t) {
      const auto corners = corners_of(t);
      const auto at = std::find(corners.begin(), corners.end(), p);
      return corners[static_cast<std::size_t>(at - corners.begin() + 1) % 3] == q;
    };
    std::optional<Turned> found;
    const auto of_p = fan(p), of_q = fan(q);
    const std::uint32_t far = of_p.size() < of_q.size() ? q : p;
    for (const std::uint32_t t : far == q ? of_p : of_q) {
      const auto corners = corners_of(t);
      if (t == triangle || !part_.part.is_boundary(t) ||
          std::find(corners.begin(), corners.end(), far) == corners.end())
        continue;
      if (found) return std::nullopt;
      found = {t, runs(t) != runs(triangle) ? 1 : -1};
    }
    return found;
  }

  static double angle(const Triangle& t, std::size_t corner) {
    const Vec3 p = t[(corner + 1) % 3] - t[corner], q = t[(corner + 2) % 3] - t[corner];
    return std::atan2(norm(cross(p, q)), dot(p, q));
  }

  const LinkedPart& part_;
  const LocalFrame& frame_;
};

}  // namespace

std::optional<Vec3> pseudo_normal(const LinkedPart& part, const LocalFrame& frame, const Foot& foot) {
  const Surface surface(part, frame);
  const Triangle t = surface.local(foot.triangle);
  for (std::size_t i = 0; i < 3; ++i)
    if (norm(foot.point - t[i]) <= foot.near) return surface.at_vertex(foot.triangle, i);
  const Vec3 up = cross(t[1] - t[0], t[2] - t[0]);
  std::array<double, 3> heights;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 inward = cross(up, t[(i + 1) % 3] - t[i]);
    heights[i] = dot(inward, foot.point - t[i]) / norm(inward);
  }
  const auto least = std::min_element(heights.begin(), heights.end());
  if (*least > foot.near) return surface.normal(foot.triangle);
  return surface.at_edge(foot.triangle, static_cast<std::size_t>(least - heights.begin()));
}

}  // namespace impinge::clash
