// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/damaged.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"

namespace impinge::scenes {
namespace {

using Corner = std::array<double, 3>;

Corner vertex_of(const MeshData& mesh, std::uint32_t v) {
  return {mesh.xyz[3 * v], mesh.xyz[3 * v + 1], mesh.xyz[3 * v + 2]};
}
std::array<std::uint32_t, 3> corners_of(const MeshData& mesh, std::size_t t) {
  return {mesh.triangles[3 * t], mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]};
}

Corner normal_of(const MeshData& mesh, std::size_t t) {
  const auto [a, b, c] = corners_of(mesh, t);
  const Corner p = vertex_of(mesh, a), q = vertex_of(mesh, b), r = vertex_of(mesh, c);
  Corner u{}, v{}, n{};
  for (std::size_t k = 0; k < 3; ++k) u[k] = q[k] - p[k], v[k] = r[k] - p[k];
  for (std::size_t k = 0; k < 3; ++k) n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
  const double length = std::hypot(n[0], n[1], n[2]);
  for (double& x : n) x /= length;
  return n;
}

/// The plane face of each triangle, by its lowest triangle.
std::vector<std::size_t> faces_of(const MeshData& mesh) {
  std::vector<std::size_t> face(mesh.triangle_count());
  std::iota(face.begin(), face.end(), std::size_t{0});
  const auto find = [&](std::size_t t) {
    while (face[t] != t) t = face[t];
    return t;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> seen;
  for (std::size_t t = 0; t < face.size(); ++t) {
    const auto corners = corners_of(mesh, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [place, is_new] = seen.try_emplace(std::minmax(corners[k], corners[(k + 1) % 3]), t);
      if (is_new) continue;
      const Corner n = normal_of(mesh, t), m = normal_of(mesh, place->second);
      if (n[0] * m[0] + n[1] * m[1] + n[2] * m[2] < 1 - 1e-12) continue;
      const std::size_t p = find(t), q = find(place->second);
      face[std::max(p, q)] = std::min(p, q);
    }
  }
  for (std::size_t t = 0; t < face.size(); ++t) face[t] = find(t);
  return face;
}

Corner random_direction(Random& random) {
  for (;;) {
    Corner d{};
    for (double& x : d) x = random.uniform(-1, 1);
    const double length = std::hypot(d[0], d[1], d[2]);
    if (length > 1 || length < 0.1) continue;
    for (double& x : d) x /= length;
    return d;
  }
}

/// So many different numbers below `count`, at least one.
std::vector<bool> chosen(std::size_t count, double share, Random& random) {
  const auto most = static_cast<int>(std::max(1.0, share * static_cast<double>(count)));
  std::vector<bool> is_chosen(count);
  for (int n = 0; n < most;) {
    const auto t = static_cast<std::size_t>(random.integer(0, static_cast<int>(count) - 1));
    n += is_chosen[t] ? 0 : 1;
    is_chosen[t] = true;
  }
  return is_chosen;
}

double widest_triangle(const MeshData& mesh) {
  double widest = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto corners = corners_of(mesh, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner p = vertex_of(mesh, corners[k]), q = vertex_of(mesh, corners[(k + 1) % 3]);
      widest = std::max(widest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
  }
  return widest;
}

}  // namespace

MeshData faces_apart(const MeshData& mesh, double gap, Random& random) {
  const std::vector<std::size_t> face = faces_of(mesh);
  std::map<std::size_t, Corner> offset;
  std::map<std::pair<std::size_t, std::uint32_t>, std::uint32_t> vertices;
  MeshData result;
  for (std::size_t t = 0; t < face.size(); ++t) {
    const auto [place, is_new] = offset.try_emplace(face[t]);
    if (is_new) {
      const double by = random.uniform(0.25, 0.5) * gap;
      place->second = random_direction(random);
      for (double& x : place->second) x *= by;
    }
    for (const std::uint32_t v : corners_of(mesh, t)) {
      const auto [at, is_new_vertex] = vertices.try_emplace({face[t], v}, 0);
      const Corner p = vertex_of(mesh, v), &d = place->second;
      if (is_new_vertex) at->second = result.add_vertex(p[0] + d[0], p[1] + d[1], p[2] + d[2]);
      result.triangles.push_back(at->second);
    }
  }
  return result;
}

MeshData with_t_junctions(const MeshData& mesh, double share, Random& random) {
  const std::vector<bool> is_cut = chosen(mesh.triangle_count(), share, random);
  MeshData result{mesh.xyz, {}};
  for (std::size_t t = 0; t < is_cut.size(); ++t) {
    const auto [a, b, c] = corners_of(mesh, t);
    if (!is_cut[t]) {
      result.add_triangle(a, b, c);
      continue;
    }
    const Corner p = vertex_of(mesh, a), q = vertex_of(mesh, b);
    const std::uint32_t middle = result.add_vertex((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2);
    result.add_triangle(a, middle, c), result.add_triangle(middle, b, c);
  }
  return result;
}

MeshData with_triangles_missing(const MeshData& mesh, double share, Random& random) {
  const std::vector<bool> is_missing = chosen(mesh.triangle_count(), share, random);
  MeshData result{mesh.xyz, {}};
  for (std::size_t t = 0; t < is_missing.size(); ++t) {
    const auto [a, b, c] = corners_of(mesh, t);
    if (!is_missing[t]) result.add_triangle(a, b, c);
  }
  return result;
}

MeshData with_triangles_flipped(const MeshData& mesh, double share, Random& random) {
  const std::vector<bool> is_flipped = chosen(mesh.triangle_count(), share, random);
  MeshData result = mesh;
  for (std::size_t t = 0; t < is_flipped.size(); ++t)
    if (is_flipped[t]) std::swap(result.triangles[3 * t], result.triangles[3 * t + 1]);
  return result;
}

MeshData with_a_face_flipped(const MeshData& mesh, Random& random) {
  const std::vector<std::size_t> face = faces_of(mesh);
  const std::size_t flipped = face[static_cast<std::size_t>(random.integer(0, static_cast<int>(face.size()) - 1))];
  MeshData result = mesh;
  for (std::size_t t = 0; t < face.size(); ++t)
    if (face[t] == flipped) std::swap(result.triangles[3 * t], result.triangles[3 * t + 1]);
  return result;
}

MeshData mismatched_cylinder(int around_wall, int around_caps, double radius, double height) {
  MeshData mesh = pipe(around_wall, 1, radius, height, false);
  for (const double z : {0.0, height}) {
    const std::uint32_t middle = mesh.add_vertex(0, 0, z);
    const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
    for (int i = 0; i < around_caps; ++i) {
      const double angle = 2 * std::numbers::pi * i / around_caps;
      mesh.add_vertex(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    for (int i = 0; i < around_caps; ++i) {
      std::uint32_t from = first + static_cast<std::uint32_t>(i);
      std::uint32_t to = first + static_cast<std::uint32_t>((i + 1) % around_caps);
      if (z == 0) std::swap(from, to);
      mesh.add_triangle(middle, from, to);
    }
  }
  return mesh;
}

MeshData moebius_band(int around) {
  MeshData band;
  for (int i = 0; i < around; ++i) {
    const double angle = 2 * std::numbers::pi * i / around;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(angle / 2);
      band.add_vertex(r * std::cos(angle), r * std::sin(angle), side * std::sin(angle / 2));
    }
  }
  const auto squares = static_cast<std::uint32_t>(around);
  for (std::uint32_t i = 0; i < squares; ++i) {
    const std::uint32_t a = 2 * i, b = a + 1;
    const std::uint32_t c = i + 1 < squares ? a + 2 : 1, d = i + 1 < squares ? a + 3 : 0;
    band.add_triangle(a, c, d), band.add_triangle(a, d, b);
  }
  return band;
}

MeshData two_sided(const MeshData& mesh) { return joined(mesh, inverted(mesh)); }

std::vector<DamagedSolid> damaged_solids(std::uint64_t seed) {
  Random random(seed);
  const std::vector<std::pair<std::string, MeshData>> sound{
      {"block", box({0, 0, 0}, {1, 1, 1}, 8)},
      {"coarse block", cube()},
      {"beam", box({0, 0, 0}, {1, 0.125, 0.125}, 6)},
      {"ball", uv_sphere(32, 16, 0.5)},
      {"cylinder", pipe(24, 6, 0.25, 1, true)},
      {"knot", scaled(torus_knot_of(3162), 0.25, 0.25, 0.25)},
      {"angle",
       boundary({{0, 0.25, 1}, {0, 0.25, 1}, {0, 0.5, 1}, [](int i, int j, int) { return i == 0 || j == 0; }})},
      {"hollow block", boundary({{0, 0.25, 0.75, 1},
                                 {0, 0.25, 0.75, 1},
                                 {0, 0.25, 0.75, 1},
                                 [](int i, int j, int k) { return i != 1 || j != 1 || k != 1; }})},
  };
  std::vector<DamagedSolid> solids;
  for (const auto& [name, mesh] : sound) {
    for (const double gap : {1e-7, 1e-5, 1e-3})
      solids.push_back(
          {name + ", faces apart by " + std::to_string(gap), mesh, faces_apart(mesh, gap, random), gap, true});
    solids.push_back({name + ", T-junctions", mesh, with_t_junctions(mesh, 0.2, random), 0, true});
    solids.push_back({name + ", triangles flipped", mesh, with_triangles_flipped(mesh, 0.2, random), 0, false});
    solids.push_back({name + ", a face flipped", mesh, with_a_face_flipped(mesh, random), 0, false});
    solids.push_back({name + ", inverted", mesh, inverted(mesh), 0, false});
    solids.push_back({name + ", two-sided", mesh, two_sided(mesh), 0, false});
    if (mesh.triangle_count() >= 500)
      solids.push_back({name + ", triangles missing", mesh, with_triangles_missing(mesh, 0.01, random),
                        widest_triangle(mesh), true});
  }
  solids.push_back(
      {"mismatched cylinder", pipe(48, 1, 0.5, 1, true), mismatched_cylinder(48, 36, 0.5, 1), 0.004, true});
  return solids;
}

std::vector<OpenShape> open_shapes() {
  std::vector<OpenShape> shapes;
  const auto cup = [](int n) {
    // The faces of a box come one after the other, each of 2 n^2 triangles.
    MeshData mesh = box({0, 0, 0}, {1, 1, 1}, n);
    mesh.triangles.resize(mesh.triangles.size() - static_cast<std::size_t>(6 * n * n));
    return mesh;
  };
  for (const int n : {1, 4, 12}) shapes.push_back({"box without a face, " + std::to_string(n), cup(n)});
  shapes.push_back({"plate without a face", scaled(cup(4), 1, 1, 0.05)});
  shapes.push_back({"deep cup", scaled(cup(6), 0.1, 0.1, 1)});
  for (const double length : {1.0, 10.0, 100.0})
    for (const int along : {1, 16})
      shapes.push_back(
          {"duct of " + std::to_string(length) + " in " + std::to_string(along), pipe(16, along, 0.5, length, false)});
  shapes.push_back({"sheet", flat_grid(8, 8)});
  shapes.push_back({"bumpy sheet", bumpy_grid(8, 8)});
  shapes.push_back({"two-sided sheet", two_sided(flat_grid(4, 4))});
  shapes.push_back({"two-sided cup", two_sided(cup(4))});
  return shapes;
}

}  // namespace impinge::scenes
