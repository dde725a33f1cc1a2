// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/solids.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <cassert>
#include <cmath>
#include <numbers>
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
/// Twice the area, positive counterclockwise. Exact for snapped numbers below 2^14.
double turn_of(const Flat& a, const Flat& b, const Flat& c) {
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

MeshData inverted(MeshData mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);
  return mesh;
}

MeshData joined(MeshData mesh, const MeshData& shell) {
  const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
  mesh.xyz.insert(mesh.xyz.end(), shell.xyz.begin(), shell.xyz.end());
  for (const std::uint32_t corner : shell.triangles) mesh.triangles.push_back(first + corner);
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
