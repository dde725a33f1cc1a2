// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/split.hpp"

#include <algorithm>
#include <utility>

namespace impinge::clash {
namespace {

constexpr std::size_t kFew = 8;

int next_axis(int axis) { return axis == 2 ? 0 : axis + 1; }

/// The part of a segment below a bound along an axis, or above it.
bool clip(Segment& segment, int axis, double bound, bool below) {
  const double sign = below ? 1 : -1;
  const double from = sign * (component(segment[0], axis) - bound), to = sign * (component(segment[1], axis) - bound);
  if (from > 0 && to > 0) return false;
  if (from <= 0 && to <= 0) return true;
  segment[from > 0 ? 0 : 1] = segment[0] + (from / (from - to)) * (segment[1] - segment[0]);
  return true;
}

}  // namespace

Splitter::Splitter(std::vector<Vec3> points, const Setting& setting) : setting_(setting) {
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  points_.reserve(points.size());
  for (const Vec3& p : points) points_.push_back({local(p), p});
  build(0, points_.size(), 0);
}

void Splitter::build(std::size_t begin, std::size_t end, int axis) {
  if (end - begin <= kFew) return;
  const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t middle = begin + (end - begin) / 2;
  std::nth_element(at(begin), at(middle), at(end), [axis](const Point& p, const Point& q) {
    return component(p.local, axis) < component(q.local, axis);
  });
  build(begin, middle, next_axis(axis));
  build(middle + 1, end, next_axis(axis));
}

// A point beside an end, as far from it as the piece is long, would make a detour of the piece rather than part it: of
// three such points each is beside the others' piece, and there would be no end of parts.
void Splitter::look_at(const Segment& edge, const Point& point, std::vector<Found>& found) const {
  const Vec3 way = edge[1] - edge[0], from = point.local - edge[0];
  const double along = dot(from, way), square = dot(way, way);
  if (!(along > 0 && along < square) || point.local == edge[1]) return;
  const Vec3 to = point.local - edge[1];
  if (std::max(dot(from, from), dot(to, to)) > (1 - 0x1p-20) * square && setting_.within > 0x1p-40) return;
  const double share = along / square;
  if (norm(from - share * way) <= setting_.within) found.push_back({share, point.world});
}

// Twice `within` leaves room for the rounding of clipped ends, which is a few 2^-53 of coordinates up to 2.
void Splitter::search(const Segment& edge, const Segment& rest, std::size_t begin, std::size_t end, int axis,
                      std::vector<Found>& found) const {
  if (end - begin <= kFew) {
    for (std::size_t i = begin; i < end; ++i) look_at(edge, points_[i], found);
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  look_at(edge, points_[middle], found);
  const double bound = component(points_[middle].local, axis), margin = 2 * setting_.within + 0x1p-48;
  if (Segment low = rest; clip(low, axis, bound + margin, true))
    search(edge, low, begin, middle, next_axis(axis), found);
  if (Segment high = rest; clip(high, axis, bound - margin, false))
    search(edge, high, middle + 1, end, next_axis(axis), found);
}

std::vector<Piece> Splitter::split(std::vector<Piece> pieces, int rounds, Tidy tidy) const {
  const std::size_t most = 64 * (pieces.size() + points_.size()) + (1 << 16);
  for (int round = 0; round < rounds; ++round) {
    const std::size_t before = pieces.size();
    pieces = split_once(std::move(pieces), most);
    if (pieces.size() == before) break;
    if (round + 1 < rounds) pieces = tidy(std::move(pieces));
  }
  return pieces;
}

std::vector<Piece> Splitter::split_once(std::vector<Piece> pieces, std::size_t most) const {
  std::vector<Piece> result;
  std::vector<Found> found;
  for (const Piece& whole : pieces) {
    const Segment edge{local(whole.from), local(whole.to)};
    found.clear();
    search(edge, edge, 0, points_.size(), 0, found);
    std::sort(found.begin(), found.end(), [](const Found& x, const Found& y) {
      return x.along != y.along ? x.along < y.along : less(x.point, y.point);
    });
    Vec3 from = whole.from;
    double along = 0;
    found.push_back({1, whole.to});
    for (const Found& next : found) {
      result.push_back(piece(from, next.point, (next.along - along) * whole.flow));
      from = next.point, along = next.along;
    }
    if (result.size() > most) return pieces;
  }
  return result;
}

}  // namespace impinge::clash
