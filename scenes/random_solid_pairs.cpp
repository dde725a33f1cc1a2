// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "scenes/shapes.hpp"
#include "scenes/solid_pairs.hpp"
#include "scenes/solids.hpp"

namespace impinge::scenes {
namespace {

/// An interval that lies to [4, 8] in the named way.
struct Way {
  const char* name;
  double low, high;
};
constexpr std::array<Way, 12> kWays{{{"before", 0, 3},
                                     {"meets", 0, 4},
                                     {"overlaps", 2, 6},
                                     {"finished by", 2, 8},
                                     {"contains", 2, 10},
                                     {"starts", 4, 6},
                                     {"equals", 4, 8},
                                     {"started by", 4, 10},
                                     {"during", 5, 7},
                                     {"finishes", 6, 8},
                                     {"overlapped by", 6, 10},
                                     {"met by", 8, 12}}};

Judgement judged(const std::array<const Way*, 3>& ways) {
  const auto all = [&](auto&& holds) { return std::all_of(ways.begin(), ways.end(), holds); };
  if (!all([](const Way* w) { return w->low <= 8 && w->high >= 4; })) {
    return kApart;
  }
  if (!all([](const Way* w) { return w->low < 8 && w->high > 4; })) {
    return kTouching;
  }
  const bool within = all([](const Way* w) { return w->low >= 4 && w->high <= 8; });
  const bool around = all([](const Way* w) { return w->low <= 4 && w->high >= 8; });
  return within && around ? kDuplicate : within ? kOuter : around ? kInner : kPenetrating;
}

/// Borders from low to high, with one or none in between.
std::vector<double> borders(Random& random, double low, double high) {
  const double middle = low + (high - low) * random.integer(1, 3) / 4;
  return random.bits() % 3 == 0 ? std::vector<double>{low, middle, high} : std::vector<double>{low, high};
}

std::vector<std::array<int, 3>> random_points(Random& random, int n, int side) {
  std::vector<std::array<int, 3>> points;
  for (int i = 0; i < n; ++i) {
    points.push_back({random.integer(0, side), random.integer(0, side), random.integer(0, side)});
  }
  return points;
}

/// A hull that is not flat: closed, as Euler's formula says, and around something.
MeshData random_hull(Random& random, int n, int side) {
  while (true) {
    const MeshData mesh = hull(random_points(random, n, side), random.integer(0, 5));
    double volume = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
      const double* const a = &mesh.xyz[3 * mesh.triangles[t]];
      const double* const b = &mesh.xyz[3 * mesh.triangles[t + 1]];
      const double* const c = &mesh.xyz[3 * mesh.triangles[t + 2]];
      volume +=
          a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    if (volume > 0 && mesh.triangle_count() == 2 * mesh.vertex_count() - 4) {
      return mesh;
    }
  }
}

/// Six small cells a side; a part fills some, in cubes of one, two or three of them.
constexpr int kSide = 6;
using Filled = std::array<bool, kSide * kSide * kSide>;

std::size_t index_of(int i, int j, int k) { return static_cast<std::size_t>((i * kSide + j) * kSide + k); }

Filled random_cells(Random& random, int step, int percent) {
  const int from = random.integer(0, step - 1);
  Filled filled{};
  for (int i = from; i + step <= kSide; i += step) {
    for (int j = from; j + step <= kSide; j += step) {
      for (int k = from; k + step <= kSide; k += step) {
        if (random.integer(0, 99) >= percent) {
          continue;
        }
        for (int c = 0; c < step * step * step; ++c) {
          filled[index_of(i + c % step, j + c / step % step, k + c / step / step)] = true;
        }
      }
    }
  }
  return filled;
}

/// The cells that a closed cell of the part touches, itself among them.
Filled grown(const Filled& part) {
  Filled result{};
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      for (int k = 0; k < kSide; ++k) {
        for (int n = 0; n < 27 && part[index_of(i, j, k)]; ++n) {
          const int x = i + n % 3 - 1, y = j + n / 3 % 3 - 1, z = k + n / 9 - 1;
          if (std::min({x, y, z}) >= 0 && std::max({x, y, z}) < kSide) {
            result[index_of(x, y, z)] = true;
          }
        }
      }
    }
  }
  return result;
}

Judgement counted(const Filled& a, const Filled& b) {
  const Filled near_a = grown(a);
  bool common = false, only_a = false, only_b = false, near = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    common = common || (a[i] && b[i]);
    only_a = only_a || (a[i] && !b[i]);
    only_b = only_b || (b[i] && !a[i]);
    near = near || (near_a[i] && b[i]);
  }
  if (!common) {
    return near ? kTouching : kApart;
  }
  return only_a && only_b ? kPenetrating : only_a ? kOuter : only_b ? kInner : kDuplicate;
}

/// The coarsest grid that the cells allow: every `step` cells from `from`, so that the parts' triangles differ in size.
MeshData mesh_of(const Filled& filled, Random& random) {
  const auto fits = [&](int step, int from) {
    const auto cell = [&](int i) { return i < from ? i : from + (i - from) / step * step; };
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j) {
        for (int k = 0; k < kSide; ++k) {
          if (filled[index_of(i, j, k)] != filled[index_of(cell(i), cell(j), cell(k))]) {
            return false;
          }
        }
      }
    }
    return true;
  };
  int step = 1, from = 0;
  for (const std::array<int, 2>& way : {std::array{2, 1}, {2, 0}, {3, 2}, {3, 1}, {3, 0}}) {
    if (fits(way[0], way[1])) {
      step = way[0];
      from = way[1];
    }
  }
  std::vector<double> at;
  for (int i = 0; i < from; ++i) {
    at.push_back(i);
  }
  for (int i = from; i < kSide; i += step) {
    at.push_back(i);
  }
  at.push_back(kSide);
  const auto is_filled = [&](int i, int j, int k) {
    const auto first = [&](int c) { return static_cast<int>(at[static_cast<std::size_t>(c)]); };
    return filled[index_of(first(i), first(j), first(k))];
  };
  return boundary({at, at, at, is_filled}, random.bits() | 1);
}

Filled second_cells(Random& random, const Filled& a) {
  const int step = random.integer(1, 3);
  Filled b = random_cells(random, step, random.integer(20, 90));
  const int way = random.integer(0, 6);
  const Filled near_a = grown(a);
  for (std::size_t i = 0; i < b.size(); ++i) {
    switch (way) {
      case 0:  // part of a
        b[i] = b[i] && a[i];
        break;
      case 1:  // more than a
        b[i] = b[i] || a[i];
        break;
      case 2:  // what a leaves free
        b[i] = !a[i];
        break;
      case 3:  // part of that
        b[i] = b[i] && !a[i];
        break;
      case 4:
        b[i] = a[i];
        break;
      case 5:  // what a does not touch
        b[i] = !near_a[i];
        break;
      default:
        break;
    }
  }
  return b;
}

/// An integer matrix with a determinant that is not 0, of either sign.
std::array<double, 9> random_matrix(Random& random) {
  std::array<double, 9> m{};
  double determinant = 0;
  do {
    for (double& x : m) {
      x = random.integer(-2, 2);
    }
    determinant =
        m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
  } while (determinant == 0);
  return m;
}

MeshData mapped(MeshData mesh, const std::array<double, 9>& m) {
  for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) {
    const std::array<double, 3> p{mesh.xyz[i], mesh.xyz[i + 1], mesh.xyz[i + 2]};
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.xyz[i + k] = m[3 * k] * p[0] + m[3 * k + 1] * p[1] + m[3 * k + 2] * p[2];
    }
  }
  return mesh;
}

std::string numbered(const std::string& name, std::uint64_t seed, int i) {
  return name + ", seed " + std::to_string(seed) + " no. " + std::to_string(i);
}

}  // namespace

std::vector<SolidPair> interval_pairs(std::uint64_t seed) {
  Random random(seed);
  std::vector<SolidPair> pairs;
  for (std::size_t i = 0; i < kWays.size(); ++i) {
    for (std::size_t j = i; j < kWays.size(); ++j) {
      for (std::size_t k = j; k < kWays.size(); ++k) {
        const std::array<const Way*, 3> ways{&kWays[i], &kWays[j], &kWays[k]};
        std::array<std::vector<double>, 3> a, b;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          a[axis] = borders(random, 4, 8);
          b[axis] = borders(random, ways[axis]->low, ways[axis]->high);
        }
        pairs.push_back({std::string(ways[0]->name) + ", " + ways[1]->name + ", " + ways[2]->name,
                         block(a[0], a[1], a[2], random.bits() | 1), block(b[0], b[1], b[2], random.bits() | 1),
                         judged(ways)});
      }
    }
  }
  return pairs;
}

std::vector<SolidPair> convex_pairs(std::uint64_t seed, int n) {
  Random random(seed);
  std::vector<SolidPair> pairs;
  for (int i = 0; i < n; ++i) {
    const bool general = i % 4 == 3;
    const int side = general ? 1000 : random.integer(2, 4);
    const int points = random.integer(4, general ? 8 : 10);
    MeshData a = random_hull(random, points, side);
    const double reach = side * (general ? 0.75 : 1.0);
    const auto shift = [&] { return std::round(random.uniform(-reach, reach)); };
    const double x = shift(), y = shift();
    MeshData b = shifted(random_hull(random, random.integer(4, 8), side), x, y, shift());
    pairs.push_back({numbered(general ? "hulls in general position" : "hulls on a lattice", seed, i), std::move(a),
                     std::move(b), std::nullopt});
  }
  return pairs;
}

std::vector<SolidPair> voxel_pairs(std::uint64_t seed, int n) {
  Random random(seed);
  std::vector<SolidPair> pairs;
  const auto is_part = [](const Filled& f) { return std::find(f.begin(), f.end(), true) != f.end(); };
  while (static_cast<int>(pairs.size()) < n) {
    const Filled a = random_cells(random, random.integer(2, 3), random.integer(20, 90));
    const Filled b = second_cells(random, a);
    if (!is_part(a) || !is_part(b)) {
      continue;
    }
    const bool mapped_too = pairs.size() % 3 == 2;
    const std::array<double, 9> m =
        mapped_too ? random_matrix(random) : std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1};
    MeshData mesh_a = mapped(mesh_of(a, random), m);
    MeshData mesh_b = mapped(mesh_of(b, random), m);
    pairs.push_back({numbered(mapped_too ? "cells, mapped" : "cells", seed, static_cast<int>(pairs.size())),
                     std::move(mesh_a), std::move(mesh_b), counted(a, b)});
  }
  return pairs;
}

std::vector<Family> solid_families() {
  return {{"Overlapping", overlapping_pairs()},
          {"Flush", flush_pairs()},
          {"EdgesAndVertices", edge_and_vertex_pairs()},
          {"Inscribed", inscribed_pairs()},
          {"Nested", nested_pairs()},
          {"Cavities", cavity_pairs()},
          {"Duplicates", duplicate_pairs()},
          {"Inverted", inverted_pairs()},
          {"Shells", shell_pairs()},
          {"Concave", concave_pairs()},
          {"Thin", thin_pairs()},
          {"Surfaces", surface_pairs()},
          {"Degenerate", degenerate_pairs()},
          {"SelfPassing", self_passing_pairs()},
          {"Intervals", interval_pairs(1)},
          {"Convex", convex_pairs(1, 80)},
          {"Voxels", voxel_pairs(1, 80)}};
}

}  // namespace impinge::scenes
