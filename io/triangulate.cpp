// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/triangulate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "impinge/predicates.hpp"

namespace impinge::io {
namespace {

/// orient2d is exact below 2^300 for multiples of 2^-358, which every double from 2^-305 on is.
bool in_domain(double x) { return x == 0 || (std::abs(x) < 0x1p300 && std::abs(x) >= 0x1p-305); }

void append_triangle(std::vector<std::uint32_t>& triangles, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  triangles.insert(triangles.end(), {a, b, c});
}

}  // namespace

void Triangulator::append(std::span<const std::uint32_t> polygon, std::vector<std::uint32_t>& triangles) {
  if (polygon.size() < 3) return;
  if (polygon.size() > 3 && project(polygon) && !is_convex()) {
    cut_ears(polygon, triangles);
    return;
  }
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    append_triangle(triangles, polygon[0], polygon[i], polygon[i + 1]);
  }
}

/// Fills `corners_`; false where the polygon has no plane to speak of (flat, or beyond the predicates' domain).
bool Triangulator::project(std::span<const std::uint32_t> polygon) {
  const auto at = [&](std::size_t i, int axis) { return xyz_[3 * std::size_t{polygon[i]} + axis]; };
  std::array<double, 3> normal{};  // Newell's, about the first corner so that far-away polygons lose no digits
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const int y = (axis + 1) % 3, z = (axis + 2) % 3;
      normal[axis] +=
          (at(i, y) - at(0, y)) * (at(i + 1, z) - at(0, z)) - (at(i, z) - at(0, z)) * (at(i + 1, y) - at(0, y));
    }
  }
  int axis = 0;
  for (int other = 1; other < 3; ++other) {
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  }
  if (!std::isfinite(normal[axis]) || normal[axis] == 0) return false;
  const int u = normal[axis] > 0 ? (axis + 1) % 3 : (axis + 2) % 3;
  const int v = 3 - axis - u;
  const auto n = static_cast<std::uint32_t>(polygon.size());
  corners_.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    corners_[i] = {at(i, u), at(i, v), i == 0 ? n - 1 : i - 1, i + 1 == n ? 0 : i + 1, false, false};
    if (!in_domain(corners_[i].u) || !in_domain(corners_[i].v)) return false;
  }
  return true;
}

int Triangulator::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return orient2d(corners_[a].u, corners_[a].v, corners_[b].u, corners_[b].v, corners_[c].u, corners_[c].v);
}

/// Repeated corners may hide a turn to the right, so the fan itself is looked at too.
bool Triangulator::is_convex() const {
  for (std::uint32_t i = 0; i < corners_.size(); ++i) {
    if (turn(corners_[i].previous, i, corners_[i].next) < 0 || turn(0, i, corners_[i].next) < 0) return false;
  }
  return true;
}

std::uint32_t Triangulator::column(double u) const {
  return static_cast<std::uint32_t>(std::clamp((u - grid_.u0) * grid_.per_u, 0.0, grid_.columns - 1.0));
}
std::uint32_t Triangulator::row(double v) const {
  return static_cast<std::uint32_t>(std::clamp((v - grid_.v0) * grid_.per_v, 0.0, grid_.rows - 1.0));
}

/// Sorts the corners that block into about as many cells. `column` and `row` never decrease, so a corner between two
/// coordinates is in a cell between theirs, whatever the rounding.
void Triangulator::build_grid() {
  double u1 = corners_[0].u, v1 = corners_[0].v;
  grid_.u0 = u1;
  grid_.v0 = v1;
  std::size_t blocking = 0;
  for (const Corner& corner : corners_) {
    grid_.u0 = std::min(grid_.u0, corner.u);
    grid_.v0 = std::min(grid_.v0, corner.v);
    u1 = std::max(u1, corner.u);
    v1 = std::max(v1, corner.v);
    blocking += corner.blocks;
  }
  // Square cells, about as many as corners, in a row where the polygon is thin.
  const double width = u1 - grid_.u0, height = v1 - grid_.v0, most = static_cast<double>(blocking);
  const double columns = std::clamp(std::sqrt(width / height * most), 1.0, std::max(most, 1.0));
  grid_.columns = static_cast<std::uint32_t>(columns);
  grid_.rows = static_cast<std::uint32_t>(std::max(most / columns, 1.0));
  grid_.per_u = grid_.columns / width;
  grid_.per_v = grid_.rows / height;
  const auto cell = [&](const Corner& corner) { return row(corner.v) * grid_.columns + column(corner.u); };
  grid_.starts.assign(std::size_t{grid_.columns} * grid_.rows + 1, 0);
  for (const Corner& corner : corners_) {
    if (corner.blocks) ++grid_.starts[cell(corner) + 1];
  }
  for (std::size_t i = 1; i < grid_.starts.size(); ++i) grid_.starts[i] += grid_.starts[i - 1];
  grid_.corners.resize(blocking);
  std::vector<std::uint32_t> free(grid_.starts.begin(), grid_.starts.end() - 1);
  for (std::uint32_t i = 0; i < corners_.size(); ++i) {
    if (corners_[i].blocks) grid_.corners[free[cell(corners_[i])]++] = i;
  }
}

/// Whether corner p lies in the closed triangle (a, b, c), which turns left. A corner at the same point as one of the
/// three does not count: outlines with bridges to their holes pass twice through a point.
bool Triangulator::is_in_ear(std::uint32_t p, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const auto same = [&](std::uint32_t q) { return corners_[p].u == corners_[q].u && corners_[p].v == corners_[q].v; };
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0 && !same(a) && !same(b) && !same(c);
}

bool Triangulator::is_ear(std::uint32_t corner) {
  const std::uint32_t a = corners_[corner].previous, c = corners_[corner].next;
  if (turn(a, corner, c) <= 0) return false;
  const auto [u_low, u_high] = std::minmax({corners_[a].u, corners_[corner].u, corners_[c].u});
  const auto [v_low, v_high] = std::minmax({corners_[a].v, corners_[corner].v, corners_[c].v});
  const std::uint32_t left = column(u_low), right = column(u_high), bottom = row(v_low), top = row(v_high);
  for (std::uint32_t y = bottom; y <= top; ++y) {
    const std::uint32_t first = grid_.starts[y * grid_.columns + left],
                        last = grid_.starts[y * grid_.columns + right + 1];
    spend(last - first + 1);
    for (std::uint32_t i = first; i < last; ++i) {
      const std::uint32_t p = grid_.corners[i];
      const Corner& at = corners_[p];
      if (!at.blocks || at.u < u_low || at.u > u_high || at.v < v_low || at.v > v_high) continue;
      if (p != a && p != corner && p != c && is_in_ear(p, a, corner, c)) return false;
    }
  }
  return true;
}

void Triangulator::unlink(std::uint32_t corner) {
  const std::uint32_t a = corners_[corner].previous, c = corners_[corner].next;
  corners_[a].next = c;
  corners_[c].previous = a;
  corners_[corner].blocks = false;
  corners_[corner].is_cut = true;
  for (const std::uint32_t i : {a, c}) {  // in a simple outline a corner that turns left goes on doing so
    if (corners_[i].blocks) corners_[i].blocks = turn(corners_[i].previous, i, corners_[i].next) <= 0;
  }
}

/// All corners that turn left, going round from one of them. The walk counts as work.
void Triangulator::collect_candidates(std::uint32_t start, std::size_t left) {
  spend(left);
  candidates_.clear();
  std::uint32_t corner = start;
  for (std::size_t i = 0; i < left; ++i, corner = corners_[corner].next) {
    if (!corners_[corner].blocks) candidates_.push_back(corner);
  }
}

/// The first corner that lies straight between its neighbours, going round; none leaves `found` alone.
bool Triangulator::find_flat(std::uint32_t start, std::size_t left, std::uint32_t& found) {
  spend(left);
  std::uint32_t corner = start;
  for (std::size_t i = 0; i < left; ++i, corner = corners_[corner].next) {
    if (turn(corners_[corner].previous, corner, corners_[corner].next) != 0) continue;
    found = corner;
    return true;
  }
  return false;
}

void Triangulator::cut_ears(std::span<const std::uint32_t> polygon, std::vector<std::uint32_t>& triangles) {
  for (std::uint32_t i = 0; i < corners_.size(); ++i) {
    corners_[i].blocks = turn(corners_[i].previous, i, corners_[i].next) <= 0;
  }
  build_grid();
  std::size_t left = polygon.size();
  std::uint32_t start = 0;  // a corner that is left
  const auto cut = [&](std::uint32_t corner) {
    const Corner at = corners_[corner];
    append_triangle(triangles, polygon[at.previous], polygon[corner], polygon[at.next]);
    unlink(corner);
    --left;
    start = at.next;
  };
  bool found_ear = true;  // in this round
  candidates_.clear();
  for (std::size_t next = 0; left > 3 && work_left_ > 0;) {
    if (next == candidates_.size()) {
      if (std::uint32_t flat = 0; !found_ear) {
        if (!find_flat(start, left, flat)) break;
        cut(flat);
      }
      collect_candidates(start, left);
      found_ear = false;
      next = 0;
      if (candidates_.empty()) continue;
    }
    const std::uint32_t corner = candidates_[next++];
    if (corners_[corner].is_cut || !is_ear(corner)) continue;
    found_ear = true;
    const std::uint32_t a = corners_[corner].previous, c = corners_[corner].next;
    cut(corner);
    for (const std::uint32_t neighbour : {a, c}) {
      if (!corners_[neighbour].blocks) candidates_.push_back(neighbour);
    }
  }
  if (left > 3) ++fanned_;
  for (std::uint32_t second = corners_[start].next; left >= 3;
       --left) {  // the last triangle, or the fan of what is left
    const std::uint32_t third = corners_[second].next;
    append_triangle(triangles, polygon[start], polygon[second], polygon[third]);
    second = third;
  }
}

}  // namespace impinge::io
