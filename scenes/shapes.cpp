// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/shapes.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace impinge::scenes {
namespace {

using Vec = std::array<double, 3>;

Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec unit(const Vec& a) {
  const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

double turn(int i, int n) { return 2 * std::numbers::pi * i / n; }

}  // namespace

std::uint32_t MeshData::add_vertex(double x, double y, double z) {
  xyz.insert(xyz.end(), {x, y, z});
  return static_cast<std::uint32_t>(xyz.size() / 3 - 1);
}

void MeshData::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  triangles.insert(triangles.end(), {a, b, c});
}

void MeshData::add_triangle(const std::array<double, 9>& corners) {
  const auto first = static_cast<std::uint32_t>(vertex_count());
  xyz.insert(xyz.end(), corners.begin(), corners.end());
  add_triangle(first, first + 1, first + 2);
}

PlacedScene pair_scene(MeshData a, MeshData b) {
  PlacedScene scene;
  scene.meshes.push_back(std::move(a));
  scene.meshes.push_back(std::move(b));
  scene.objects = {{.mesh = 0}, {.mesh = 1}};
  return scene;
}

MeshData torus_knot(int p, int q, int along, int around) {
  constexpr double kTube = 0.4;
  MeshData mesh;
  for (int i = 0; i < along; ++i) {
    const double u = p * turn(i, along);
    const double v = q * turn(i, along);
    const double ring = 2 + std::cos(v);
    const Vec center{ring * std::cos(u), ring * std::sin(u), std::sin(v)};
    const Vec tangent = unit({-q * std::sin(v) * std::cos(u) - p * ring * std::sin(u),
                              -q * std::sin(v) * std::sin(u) + p * ring * std::cos(u), q * std::cos(v)});
    // The torus's own normal: perpendicular to the curve, and closed when the curve is.
    const Vec normal{std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)};
    const Vec binormal = cross(tangent, normal);
    for (int j = 0; j < around; ++j) {
      const double c = kTube * std::cos(turn(j, around));
      const double s = kTube * std::sin(turn(j, around));
      mesh.add_vertex(center[0] + c * normal[0] + s * binormal[0], center[1] + c * normal[1] + s * binormal[1],
                      center[2] + c * normal[2] + s * binormal[2]);
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % along) * around + j % around); };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      mesh.add_triangle(at(i, j), at(i + 1, j + 1), at(i + 1, j));
      mesh.add_triangle(at(i, j), at(i, j + 1), at(i + 1, j + 1));
    }
  }
  return mesh;
}

MeshData torus_knot_of(int triangles, int p, int q) {
  constexpr double kRatio = 6;
  const int quads = triangles / 2;
  int around = 5;
  double best = 1e300;
  for (int candidate = 5; candidate <= quads / 5; ++candidate) {
    const double ratio = static_cast<double>(quads) / candidate / candidate;
    const double badness = std::fabs(std::log(ratio / kRatio)) + quads % candidate;
    if (badness < best) {
      best = badness;
      around = candidate;
    }
  }
  return torus_knot(p, q, quads / around, around);
}

MeshData uv_sphere(int slices, int stacks, double radius) {
  MeshData mesh;
  const std::uint32_t south = mesh.add_vertex(0, 0, -radius);
  for (int i = 1; i < stacks; ++i) {
    const double latitude = std::numbers::pi * i / stacks;
    for (int j = 0; j < slices; ++j) {
      mesh.add_vertex(radius * std::sin(latitude) * std::cos(turn(j, slices)),
                      radius * std::sin(latitude) * std::sin(turn(j, slices)), -radius * std::cos(latitude));
    }
  }
  const std::uint32_t north = mesh.add_vertex(0, 0, radius);
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(1 + (i - 1) * slices + j % slices); };
  for (int j = 0; j < slices; ++j) {
    mesh.add_triangle(south, at(1, j + 1), at(1, j));
    for (int i = 1; i + 1 < stacks; ++i) {
      mesh.add_triangle(at(i, j), at(i, j + 1), at(i + 1, j + 1));
      mesh.add_triangle(at(i, j), at(i + 1, j + 1), at(i + 1, j));
    }
    mesh.add_triangle(at(stacks - 1, j), at(stacks - 1, j + 1), north);
  }
  return mesh;
}

MeshData box(const std::array<double, 3>& low, const std::array<double, 3>& high, int n) {
  MeshData mesh;
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](const std::array<int, 3>& cell) {
    const auto [place, is_new] = known.try_emplace(cell, 0);
    if (is_new) {
      Vec at{};
      for (std::size_t k = 0; k < 3; ++k) {
        at[k] = cell[k] == n ? high[k] : low[k] + (high[k] - low[k]) * cell[k] / n;
      }
      place->second = mesh.add_vertex(at[0], at[1], at[2]);
    }
    return place->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, n}) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> cell{};
            cell[axis] = side;
            cell[(axis + 1) % 3] = i + di;
            cell[(axis + 2) % 3] = j + dj;
            return vertex(cell);
          };
          const std::uint32_t a = corner(0, 0);
          const std::uint32_t b = side == 0 ? corner(0, 1) : corner(1, 0);
          const std::uint32_t c = corner(1, 1);
          const std::uint32_t d = side == 0 ? corner(1, 0) : corner(0, 1);
          mesh.add_triangle(a, b, c);
          mesh.add_triangle(a, c, d);
        }
      }
    }
  }
  return mesh;
}

MeshData cube() { return box({0, 0, 0}, {1, 1, 1}); }

MeshData grid(int nx, int ny, double cell, const Height& height) {
  MeshData mesh;
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      mesh.add_vertex(i * cell, j * cell, height(i, j));
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (ny + 1) + j); };
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      mesh.add_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return mesh;
}

MeshData flat_grid(int nx, int ny, double cell) {
  return grid(nx, ny, cell, [](int, int) { return 0.0; });
}

MeshData bumpy_grid(int nx, int ny, double cell) {
  return grid(nx, ny, cell, [cell](int i, int j) { return cell * ((i * 3 + j * 5 + i * j) % 8) / 16; });
}

MeshData pipe(int around, int along, double radius, double length, bool capped) {
  MeshData mesh;
  for (int i = 0; i <= along; ++i) {
    for (int j = 0; j < around; ++j) {
      mesh.add_vertex(radius * std::cos(turn(j, around)), radius * std::sin(turn(j, around)), length * i / along);
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * around + j % around); };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      mesh.add_triangle(at(i, j), at(i, j + 1), at(i + 1, j + 1));
      mesh.add_triangle(at(i, j), at(i + 1, j + 1), at(i + 1, j));
    }
  }
  if (capped) {
    const std::uint32_t bottom = mesh.add_vertex(0, 0, 0);
    const std::uint32_t top = mesh.add_vertex(0, 0, length);
    for (int j = 0; j < around; ++j) {
      mesh.add_triangle(bottom, at(0, j + 1), at(0, j));
      mesh.add_triangle(top, at(along, j), at(along, j + 1));
    }
  }
  return mesh;
}

MeshData scaled(MeshData mesh, double sx, double sy, double sz) {
  for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) {
    mesh.xyz[i] *= sx;
    mesh.xyz[i + 1] *= sy;
    mesh.xyz[i + 2] *= sz;
  }
  return mesh;
}

MeshData shifted(MeshData mesh, double dx, double dy, double dz) {
  for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) {
    mesh.xyz[i] += dx;
    mesh.xyz[i + 1] += dy;
    mesh.xyz[i + 2] += dz;
  }
  return mesh;
}

}  // namespace impinge::scenes
