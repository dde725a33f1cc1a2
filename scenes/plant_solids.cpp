// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/plant_solids.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace impinge::scenes {
namespace {

/// Twice the area, positive counterclockwise. Exact for snapped numbers below 2^14.
[[maybe_unused]] double turn_of(const Flat& a, const Flat& b, const Flat& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// The angle between two points as seen from a third one.
double angle_at(const Flat& center, const Flat& a, const Flat& b) {
  const Flat u{a[0] - center[0], a[1] - center[1]}, v{b[0] - center[0], b[1] - center[1]};
  return std::fabs(std::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]));
}

Flat mean_of(const Loop& loop) {
  Flat sum{};
  for (const Flat& point : loop) sum = {sum[0] + point[0], sum[1] + point[1]};
  return {sum[0] / static_cast<double>(loop.size()), sum[1] / static_cast<double>(loop.size())};
}

Flat direction(int k, int n) {
  const double angle = (2 * k + 1) * std::numbers::pi / n;
  return {std::cos(angle), std::sin(angle)};
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Points of a section at the heights of its layers, made when they are first asked for.
class Levels {
 public:
  Levels(const Section& section, std::span<const double> zs, MeshData& mesh)
      : section_(section), zs_(zs), mesh_(mesh), vertices_(section.points.size() * zs.size(), kNone) {}

  std::uint32_t vertex(std::uint32_t point, std::size_t level) {
    std::uint32_t& vertex = vertices_[level * section_.points.size() + point];
    const Flat& p = section_.points[point];
    if (vertex == kNone) vertex = mesh_.add_vertex(p[0], p[1], zs_[level]);
    return vertex;
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  const Section& section_;
  std::span<const double> zs_;
  MeshData& mesh_;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace

double snapped(double x) { return std::nearbyint(x * 1024) / 1024; }

Loop circle(double radius, int n, const Flat& center) {
  Loop loop;
  for (int k = 0; k < n; ++k) {
    // The first side is the one from corner n - 1 to corner 0.
    const Flat d = direction(k, n);
    loop.push_back({center[0] + snapped(radius * d[0]), center[1] + snapped(radius * d[1])});
  }
  return loop;
}

double flat_of(double radius, int n) { return circle(radius, n)[0][0]; }

std::uint32_t Section::add(const Flat& point) {
  const Flat key{point[0] + 0.0, point[1] + 0.0};  // no -0
  const auto [place, is_new] = known_.try_emplace(key, static_cast<std::uint32_t>(points.size()));
  if (is_new) points.push_back(key);
  return place->second;
}

void Section::fill(const Loop& loop, unsigned zone) {
  std::vector<std::uint32_t> corners;
  for (const Flat& point : loop) corners.push_back(add(point));
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
    zones.push_back(zone);
  }
}

void Section::fill_between(const Loop& outer, const Loop& inner, unsigned zone) {
  // Around once, with a line from one polygon to the other that turns as little as may be against the center's view.
  const Flat center = mean_of(inner);
  const auto nearest = std::min_element(inner.begin(), inner.end(), [&](const Flat& a, const Flat& b) {
    return angle_at(center, a, outer[0]) < angle_at(center, b, outer[0]);
  });
  const auto start = static_cast<std::size_t>(nearest - inner.begin());
  const auto out = [&](std::size_t i) { return outer[i % outer.size()]; };
  const auto in = [&](std::size_t j) { return inner[(start + j) % inner.size()]; };
  for (std::size_t i = 0, j = 0; i < outer.size() || j < inner.size();) {
    const bool inner_is_done = j == inner.size();
    const bool outer_next = i < outer.size() && (inner_is_done || angle_at(center, in(j), out(i + 1)) <=
                                                                      angle_at(center, in(j + 1), out(i)));
    const Flat third = outer_next ? out(i + 1) : in(j + 1);
    assert(turn_of(in(j), out(i), third) > 0 && "the center does not see both polygons");
    triangles.push_back({add(in(j)), add(out(i)), add(third)});
    zones.push_back(zone);
    ++(outer_next ? i : j);
  }
}

Section grid_section(std::span<const double> xs, std::span<const double> ys, std::span<const int> zones) {
  Section section;
  const std::size_t columns = xs.size() - 1;
  for (std::size_t cell = 0; cell < zones.size(); ++cell) {
    if (zones[cell] < 0) continue;
    const std::size_t i = cell % columns, j = cell / columns;
    section.fill({{xs[i], ys[j]}, {xs[i + 1], ys[j]}, {xs[i + 1], ys[j + 1]}, {xs[i], ys[j + 1]}},
                 static_cast<unsigned>(zones[cell]));
  }
  return section;
}

MeshData layered(const Section& section, std::span<const double> zs, std::span<const unsigned> layers) {
  MeshData mesh;
  Levels levels(section, zs, mesh);
  // The triangle on the left of each directed edge.
  std::map<Edge, std::size_t> left;
  for (std::size_t t = 0; t < section.triangles.size(); ++t) {
    const auto& [a, b, c] = section.triangles[t];
    for (const Edge& edge : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) left.emplace(edge, t);
  }
  const auto filled = [&](std::size_t t, std::size_t layer) {  // layer -1 wraps around
    return layer < layers.size() && (layers[layer] >> section.zones[t] & 1u) != 0;
  };
  for (std::size_t t = 0; t < section.triangles.size(); ++t) {
    const auto& [a, b, c] = section.triangles[t];
    for (std::size_t k = 0; k < zs.size(); ++k) {
      const bool below = filled(t, k - 1), above = filled(t, k);
      if (below && !above) mesh.add_triangle(levels.vertex(a, k), levels.vertex(b, k), levels.vertex(c, k));
      if (above && !below) mesh.add_triangle(levels.vertex(a, k), levels.vertex(c, k), levels.vertex(b, k));
    }
  }
  for (const auto& [edge, t] : left) {
    const auto [a, b] = edge;
    const auto other = left.find({b, a});
    for (std::size_t k = 0; k < layers.size(); ++k) {
      if (!filled(t, k) || (other != left.end() && filled(other->second, k))) continue;
      mesh.add_triangle(levels.vertex(a, k), levels.vertex(b, k), levels.vertex(b, k + 1));
      mesh.add_triangle(levels.vertex(a, k), levels.vertex(b, k + 1), levels.vertex(a, k + 1));
    }
  }
  return mesh;
}

MeshData extruded(const Section& section, double low, double high, int along) {
  std::vector<double> zs;
  for (int k = 0; k <= along; ++k) zs.push_back(k == along ? high : snapped(low + (high - low) * k / along));
  return layered(section, zs, std::vector<unsigned>(static_cast<std::size_t>(along), ~0u));
}

MeshData revolved(const Loop& profile, int n) {
  MeshData mesh;
  const auto last = static_cast<std::uint32_t>(profile.size() - 1), sides = static_cast<std::uint32_t>(n);
  const std::uint32_t bottom = mesh.add_vertex(0, 0, profile.front()[1]);
  for (std::uint32_t i = 1; i < last; ++i)
    for (const Flat& p : circle(profile[i][0], n)) mesh.add_vertex(p[0], p[1], snapped(profile[i][1]));
  const std::uint32_t top = mesh.add_vertex(0, 0, profile.back()[1]);
  const auto at = [&](std::uint32_t i, std::uint32_t k) { return 1 + (i - 1) * sides + k % sides; };
  for (std::uint32_t k = 0; k < sides; ++k) {
    mesh.add_triangle(bottom, at(1, k + 1), at(1, k));
    for (std::uint32_t i = 1; i + 1 < last; ++i) {
      mesh.add_triangle(at(i, k), at(i, k + 1), at(i + 1, k + 1));
      mesh.add_triangle(at(i, k), at(i + 1, k + 1), at(i + 1, k));
    }
    mesh.add_triangle(at(last - 1, k), at(last - 1, k + 1), top);
  }
  return mesh;
}

MeshData revolved_ring(const Loop& profile, int n) {
  MeshData mesh;
  const auto rows = static_cast<std::uint32_t>(profile.size()), sides = static_cast<std::uint32_t>(n);
  for (const Flat& corner : profile)
    for (const Flat& p : circle(corner[0], n)) mesh.add_vertex(p[0], p[1], snapped(corner[1]));
  const auto at = [&](std::uint32_t i, std::uint32_t k) { return i % rows * sides + k % sides; };
  for (std::uint32_t k = 0; k < sides; ++k) {
    for (std::uint32_t i = 0; i < rows; ++i) {
      mesh.add_triangle(at(i, k), at(i, k + 1), at(i + 1, k + 1));
      mesh.add_triangle(at(i, k), at(i + 1, k + 1), at(i + 1, k));
    }
  }
  return mesh;
}

MeshData subdivided(const MeshData& mesh) {
  MeshData out{mesh.xyz, {}};
  std::map<Edge, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, 0);
    const double* const p = &mesh.xyz[3 * a];
    const double* const q = &mesh.xyz[3 * b];
    if (is_new) place->second = out.add_vertex((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2);
    return place->second;
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const std::uint32_t a = mesh.triangles[i], b = mesh.triangles[i + 1], c = mesh.triangles[i + 2];
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    out.add_triangle(a, ab, ca);
    out.add_triangle(ab, b, bc);
    out.add_triangle(ca, bc, c);
    out.add_triangle(ab, bc, ca);
  }
  return out;
}

MeshData renumbered(const MeshData& mesh) {
  MeshData out;
  const auto vertices = static_cast<std::uint32_t>(mesh.vertex_count());
  for (std::uint32_t v = vertices; v-- > 0;) out.add_vertex(mesh.xyz[3 * v], mesh.xyz[3 * v + 1], mesh.xyz[3 * v + 2]);
  for (std::size_t i = mesh.triangles.size(); i > 0; i -= 3) {
    const auto corner = [&](std::size_t k) { return vertices - 1 - mesh.triangles[i - 3 + k]; };
    out.add_triangle(corner(1), corner(2), corner(0));
  }
  return out;
}

}  // namespace impinge::scenes
