// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/solids.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace impinge::scenes {
namespace {

/// Gives equal places one vertex.
class Welded {
 public:
  std::uint32_t vertex(const std::array<double, 3>& at) {
    const auto [place, is_new] = known_.try_emplace(at, 0);
    if (is_new) {
      place->second = mesh_.add_vertex(at[0], at[1], at[2]);
    }
    return place->second;
  }
  void triangle(const std::array<double, 3>& a, const std::array<double, 3>& b, const std::array<double, 3>& c) {
    const std::uint32_t first = vertex(a), second = vertex(b);
    mesh_.add_triangle(first, second, vertex(c));
  }
  /// Corners in a ring.
  void square(const std::array<std::array<double, 3>, 4>& c, bool other_diagonal = false) {
    const std::size_t from = other_diagonal ? 1 : 0;
    triangle(c[from], c[from + 1], c[from + 2]);
    triangle(c[from], c[from + 2], c[(from + 3) % 4]);
  }
  MeshData mesh() && { return std::move(mesh_); }

 private:
  MeshData mesh_;
  std::map<std::array<double, 3>, std::uint32_t> known_;
};

/// Which diagonal comes next.
class Diagonals {
 public:
  explicit Diagonals(std::uint64_t seed) : random_(seed), drawn_(seed != 0) {}
  bool other() { return drawn_ && random_.bits() % 2 != 0; }

 private:
  Random random_;
  bool drawn_;
};

using Place = std::array<int, 3>;

Place operator-(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::int64_t dot(const Place& a, const Place& b) {
  return std::int64_t{a[0]} * b[0] + std::int64_t{a[1]} * b[1] + std::int64_t{a[2]} * b[2];
}

/// The corners of the convex polygon that points of one plane span, counterclockwise around the normal.
std::vector<Place> wrapped(const std::vector<Place>& points, const Place& normal) {
  const Place first = *std::min_element(points.begin(), points.end());
  std::vector<Place> ring;
  Place at = first;
  do {
    ring.push_back(at);
    Place next = at;
    for (const Place& p : points) {
      const std::int64_t side = dot(normal, cross(next - at, p - at));
      if (next == at || side < 0 || (side == 0 && dot(p - at, p - at) > dot(next - at, next - at))) {
        next = p;
      }
    }
    at = next;
  } while (at != first);
  return ring;
}

std::array<double, 3> in_doubles(const Place& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

int cell_count(const std::vector<double>& borders) { return static_cast<int>(borders.size()) - 1; }

}  // namespace

MeshData boundary(const Cells& cells, std::uint64_t seed) {
  const std::array<const std::vector<double>*, 3> borders{&cells.x, &cells.y, &cells.z};
  const auto filled = [&](const Place& c) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (c[k] < 0 || c[k] >= cell_count(*borders[k])) {
        return false;
      }
    }
    return cells.filled(c[0], c[1], c[2]);
  };
  Welded mesh;
  Diagonals diagonals(seed);
  const auto add_side = [&](const Place& c, std::size_t axis, int side) {
    Place beyond = c;
    beyond[axis] += side == 0 ? -1 : 1;
    if (filled(beyond)) {
      return;
    }
    const auto corner = [&](int u, int v) {
      Place at = c;
      at[axis] += side;
      at[(axis + 1) % 3] += u;
      at[(axis + 2) % 3] += v;
      std::array<double, 3> place{};
      for (std::size_t k = 0; k < 3; ++k) {
        place[k] = (*borders[k])[static_cast<std::size_t>(at[k])];
      }
      return place;
    };
    const int s = side;
    mesh.square({corner(0, 0), corner(s, 1 - s), corner(1, 1), corner(1 - s, s)}, diagonals.other());
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, 1}) {
      for (int i = 0; i < cell_count(cells.x); ++i) {
        for (int j = 0; j < cell_count(cells.y); ++j) {
          for (int k = 0; k < cell_count(cells.z); ++k) {
            if (cells.filled(i, j, k)) {
              add_side({i, j, k}, axis, side);
            }
          }
        }
      }
    }
  }
  return std::move(mesh).mesh();
}

MeshData block(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z,
               std::uint64_t seed) {
  return boundary({x, y, z, [](int, int, int) { return true; }}, seed);
}

MeshData hull(const std::vector<std::array<int, 3>>& points, int turn) {
  Welded mesh;
  std::set<std::vector<Place>> faces;
  const auto add_face = [&](Place normal, const Place& through) {
    bool above = false, below = false;
    std::vector<Place> in_plane;
    for (const Place& p : points) {
      const std::int64_t height = dot(normal, p - through);
      above = above || height > 0;
      below = below || height < 0;
      if (height == 0) {
        in_plane.push_back(p);
      }
    }
    if (above && below) {
      return;
    }
    if (above) {
      normal = Place{} - normal;
    }
    std::vector<Place> ring = wrapped(in_plane, normal);
    if (!faces.insert(ring).second) {
      return;
    }
    std::rotate(ring.begin(), ring.begin() + turn % static_cast<int>(ring.size()), ring.end());
    for (std::size_t i = 2; i < ring.size(); ++i) {
      mesh.triangle(in_doubles(ring[0]), in_doubles(ring[i - 1]), in_doubles(ring[i]));
    }
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const Place normal = cross(points[j] - points[i], points[k] - points[i]);
        if (normal != Place{}) {
          add_face(normal, points[i]);
        }
      }
    }
  }
  return std::move(mesh).mesh();
}

Outline regular(int sides, double radius, double turn) {
  Outline outline;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * (i + turn) / sides;
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return outline;
}

MeshData prism(const Outline& outline, double low, double high) {
  Welded mesh;
  const std::size_t n = outline.size();
  const auto at = [&](std::size_t i, double z) { return std::array{outline[i % n][0], outline[i % n][1], z}; };
  for (std::size_t i = 0; i < n; ++i) {
    mesh.square({at(i, low), at(i + 1, low), at(i + 1, high), at(i, high)});
  }
  for (std::size_t i = 2; i < n; ++i) {
    mesh.triangle(at(0, low), at(i, low), at(i - 1, low));
    mesh.triangle(at(0, high), at(i - 1, high), at(i, high));
  }
  return std::move(mesh).mesh();
}

MeshData ring(const Outline& outer, const Outline& inner, double low, double high) {
  Welded mesh;
  const std::size_t n = outer.size();
  const auto out = [&](std::size_t i, double z) { return std::array{outer[i % n][0], outer[i % n][1], z}; };
  const auto in = [&](std::size_t i, double z) { return std::array{inner[i % n][0], inner[i % n][1], z}; };
  for (std::size_t i = 0; i < n; ++i) {
    mesh.square({out(i, low), out(i + 1, low), out(i + 1, high), out(i, high)});
    mesh.square({in(i, low), in(i, high), in(i + 1, high), in(i + 1, low)});
    mesh.square({out(i, low), in(i, low), in(i + 1, low), out(i + 1, low)});
    mesh.square({out(i, high), out(i + 1, high), in(i + 1, high), in(i, high)});
  }
  return std::move(mesh).mesh();
}

MeshData sheet(const std::vector<double>& x, const std::vector<double>& y, double z, std::uint64_t seed) {
  Welded mesh;
  Diagonals diagonals(seed);
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      mesh.square({std::array{x[i], y[j], z}, {x[i + 1], y[j], z}, {x[i + 1], y[j + 1], z}, {x[i], y[j + 1], z}},
                  diagonals.other());
    }
  }
  return std::move(mesh).mesh();
}

MeshData joined(MeshData a, const MeshData& b) {
  const auto offset = static_cast<std::uint32_t>(a.vertex_count());
  a.xyz.insert(a.xyz.end(), b.xyz.begin(), b.xyz.end());
  for (const std::uint32_t v : b.triangles) {
    a.triangles.push_back(v + offset);
  }
  return a;
}

MeshData inverted(MeshData mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);
  }
  return mesh;
}

MeshData turned(MeshData mesh) {
  for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) {
    const auto first = mesh.xyz.begin() + static_cast<std::ptrdiff_t>(i);
    std::rotate(first, first + 2, first + 3);
  }
  return mesh;
}

MeshData opened(MeshData mesh, int n) {
  mesh.triangles.resize(mesh.triangles.size() - 3 * static_cast<std::size_t>(n));
  return mesh;
}

MeshData unshared(const MeshData& mesh) {
  MeshData result;
  for (const std::uint32_t v : mesh.triangles) {
    result.triangles.push_back(result.add_vertex(mesh.xyz[3 * v], mesh.xyz[3 * v + 1], mesh.xyz[3 * v + 2]));
  }
  return result;
}

MeshData shuffled(const MeshData& mesh, Random& random) {
  const auto order = [&](std::size_t n) {
    std::vector<std::uint32_t> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0u);
    for (std::size_t i = n; i > 1; --i) {
      std::swap(numbers[i - 1], numbers[random.bits() % i]);
    }
    return numbers;
  };
  MeshData result;
  std::vector<std::uint32_t> renamed(mesh.vertex_count());
  for (const std::uint32_t v : order(mesh.vertex_count())) {
    renamed[v] = result.add_vertex(mesh.xyz[3 * v], mesh.xyz[3 * v + 1], mesh.xyz[3 * v + 2]);
  }
  for (const std::uint32_t t : order(mesh.triangle_count())) {
    const std::uint64_t first = random.bits() % 3;
    const auto corner = [&](std::uint64_t k) { return renamed[mesh.triangles[3 * t + (first + k) % 3]]; };
    result.add_triangle(corner(0), corner(1), corner(2));
  }
  return result;
}

}  // namespace impinge::scenes
