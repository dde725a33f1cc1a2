// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/fold_side.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "clash/sheets.hpp"

namespace impinge::clash {
namespace {

/// Of the triangles at a corner; of more nothing is asked.
constexpr std::size_t kMost = 64;

using Corners = std::array<std::uint32_t, 3>;

std::size_t place_of(std::uint32_t position, const Corners& corners) {
  return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), position) - corners.begin());
}

struct Turned {
  std::uint32_t triangle;
  int turn;  ///< -1 where its normal looks the other way
};

class Surface {
 public:
  explicit Surface(const PartTriangle& triangle)
      : part_(triangle.part), frame_(triangle.frame), own_(triangle), corners_(corners_of(triangle.id)) {}

  [[nodiscard]] std::span<const std::uint32_t> fan(std::size_t corner) const { return fan_of(corners_[corner]); }
  [[nodiscard]] Triangle local(std::uint32_t id) const { return frame_.to_local(part_.part.body.triangle(id)); }

  /// Nearest to a point of that edge, which is `away` from it at a right angle.
  [[nodiscard]] std::uint8_t side_at_edge(std::size_t edge, const Vec3& away) const {
    const std::uint32_t from = corners_[edge], to = corners_[(edge + 1) % 3];
    const auto next = across(own_.id, from, to);
    if (!next) return 0;
    const Triangle other = local(next->triangle);
    const Corners corners = corners_of(next->triangle);
    const std::size_t apex = 3 - place_of(from, corners) - place_of(to, corners);
    if (dot(away, other[apex] - own_.local[edge]) > 0) return 0;
    const auto up = normal(own_.local), also_up = normal(other);
    return up && also_up ? side(*up + next->turn * *also_up, away) : std::uint8_t{0};
  }

  [[nodiscard]] std::uint8_t side_at_corner(std::size_t corner, const Vec3& away) const {
    const std::uint32_t vertex = corners_[corner];
    const auto triangles = fan(corner);
    if (triangles.size() > kMost) return 0;
    for (const std::uint32_t id : triangles)
      for (const Vec3& end : local(id))
        if (dot(away, end - own_.local[corner]) > 0) return 0;
    Vec3 sum{0, 0, 0};
    Turned at{own_.id, 1};
    for (std::size_t seen = 1; seen <= triangles.size(); ++seen) {
      const Triangle t = local(at.triangle);
      const Corners corners = corners_of(at.triangle);
      const std::size_t k = place_of(vertex, corners);
      const auto up = normal(t);
      // Those that are turned are gone around the other way.
      const auto next = across(at.triangle, vertex, corners[(k + (at.turn > 0 ? 2 : 1)) % 3]);
      if (!up || !next) return 0;
      sum = sum + at.turn * angle(t, k) * *up;
      at = {next->triangle, at.turn * next->turn};
      if (at.triangle == own_.id) return at.turn > 0 && seen == triangles.size() ? side(sum, away) : std::uint8_t{0};
    }
    return 0;
  }

 private:
  [[nodiscard]] Corners corners_of(std::uint32_t id) const {
    const auto& [a, b, c] = part_.part.body.placed.mesh->triangles[id];
    const auto& position = part_.part.topology.position;
    return {position[a], position[b], position[c]};
  }

  [[nodiscard]] std::span<const std::uint32_t> fan_of(std::uint32_t position) const {
    const auto& [offsets, triangles] = part_.fans;
    return std::span(triangles).subspan(offsets[position], offsets[position + 1] - offsets[position]);
  }

  /// The one other triangle at an edge.
  [[nodiscard]] std::optional<Turned> across(std::uint32_t id, std::uint32_t p, std::uint32_t q) const {
    const auto runs = [&](const Corners& corners) { return corners[(place_of(p, corners) + 1) % 3] == q; };
    const auto of_p = fan_of(p), of_q = fan_of(q);
    const bool is_p = of_p.size() < of_q.size();
    std::optional<Turned> found;
    for (const std::uint32_t t : is_p ? of_p : of_q) {
      const Corners corners = corners_of(t);
      if (t == id || place_of(is_p ? q : p, corners) == 3 || !part_.part.is_boundary(t)) continue;
      if (found) return std::nullopt;
      found = {t, runs(corners) != runs(corners_of(id)) ? 1 : -1};
    }
    return found;
  }

  /// Of unit length; nothing where it may be off by more than 2^-20 (see make_slab).
  [[nodiscard]] std::optional<Vec3> normal(const Triangle& t) const {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const double length = norm(n);
    const double longest = std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
    if (!(length > 0x1p-30 * longest * (longest + frame_.scale))) return std::nullopt;
    return (1 / length) * n;
  }

  static double angle(const Triangle& t, std::size_t corner) {
    const Vec3 p = t[(corner + 1) % 3] - t[corner], q = t[(corner + 2) % 3] - t[corner];
    return std::atan2(norm(cross(p, q)), dot(p, q));
  }

  /// The normals of what is folded up flat cancel out.
  static std::uint8_t side(const Vec3& up, const Vec3& away) {
    const double height = dot(up, away);
    if (!(std::abs(height) > 0x1p-10 * norm(away))) return 0;
    return height > 0 ? kAbove : kBelow;
  }

  const LinkedPart& part_;
  const LocalFrame& frame_;
  const PartTriangle& own_;
  Corners corners_;
};

}  // namespace

bool is_bent_around(const PartTriangle& triangle) {
  const Surface surface(triangle);
  const Triangle& t = triangle.local;
  const Vec3 up = cross(t[1] - t[0], t[2] - t[0]);
  const double flat = 0x1p-6 * norm(up);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto fan = surface.fan(i);
    if (fan.size() > kMost) return true;
    for (const std::uint32_t id : fan) {
      const Triangle other = surface.local(id);
      const Vec3 normal = cross(other[1] - other[0], other[2] - other[0]);
      if (!(norm(cross(up, normal)) <= flat * norm(normal))) return true;
    }
  }
  return false;
}

std::uint8_t side_of_fold(const PartTriangle& triangle, const Vec3& point, double beyond) {
  const Triangle& t = triangle.local;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 out = t[(i + 1) % 3] - t[i], in = t[(i + 2) % 3] - t[i], to_point = point - t[i];
    const double share = dot(to_point, out) / dot(out, out);
    if (share <= 0 && dot(to_point, in) <= 0)
      return norm(to_point) > beyond ? Surface(triangle).side_at_corner(i, to_point) : std::uint8_t{0};
    const Vec3 away = to_point - share * out;
    if (share > 0 && share < 1 && dot(away, in) < 0)
      return norm(away) > beyond ? Surface(triangle).side_at_edge(i, away) : std::uint8_t{0};
  }
  return 0;
}

}  // namespace impinge::clash
