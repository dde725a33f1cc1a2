// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/split.hpp"

#include <algorithm>
#include <iterator>
#include <map>
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

void Splitter::look_at(const Segment& edge, const Point& point, std::vector<Found>& found) const {
  const Vec3 way = edge[1] - edge[0], from = point.local - edge[0];
  const double along = dot(from, way), square = dot(way, way);
  if (!(along > 0 && along < square) || point.local == edge[1]) return;
  const double share = along / square, off = norm(from - share * way);
  if (off <= setting_.within) found.push_back({share, off, point});
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

std::vector<Piece> Splitter::split(const std::vector<Piece>& pieces) const {
  return split(pieces, budget(pieces), false);
}

std::vector<Piece> Splitter::split_closely(std::vector<Piece> pieces, Tidy tidy) const {
  constexpr int kRounds = 8;
  const std::size_t most = budget(pieces);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Piece> parts = split(pieces, most, true);
    if (parts.size() == pieces.size()) break;
    pieces = tidy(std::move(parts));
  }
  return pieces;
}

std::size_t Splitter::budget(const std::vector<Piece>& pieces) const {
  return 64 * (pieces.size() + points_.size()) + (1 << 16);
}

std::vector<Piece> Splitter::split(const std::vector<Piece>& pieces, std::size_t most, bool closely) const {
  const auto by_way = [](const Found& x, const Found& y) {
    return x.along != y.along ? x.along < y.along : less(x.point.world, y.point.world);
  };
  std::vector<Piece> result;
  std::vector<Found> found;
  for (const Piece& whole : pieces) {
    const Segment edge{local(whole.from), local(whole.to)};
    found.clear();
    search(edge, edge, 0, points_.size(), 0, found);
    if (closely) keep_what_shortens(edge, found);
    std::sort(found.begin(), found.end(), by_way);
    Vec3 from = whole.from;
    double along = 0;
    found.push_back({1, 0, {edge[1], whole.to}});
    for (const Found& next : found) {
      result.push_back(piece(from, next.point.world, (next.along - along) * whole.flow));
      from = next.point.world, along = next.along;
    }
    if (result.size() > most) return pieces;
  }
  return result;
}

void Splitter::keep_what_shortens(const Segment& edge, std::vector<Found>& found) {
  std::sort(found.begin(), found.end(), [](const Found& x, const Found& y) {
    if (x.off != y.off) return x.off < y.off;
    return x.along != y.along ? x.along < y.along : less(x.point.world, y.point.world);
  });
  std::multimap<double, Vec3> chain{{0, edge[0]}, {1, edge[1]}};
  std::erase_if(found, [&](const Found& next) {
    const auto after = chain.lower_bound(next.along);
    const Vec3 &from = std::prev(after)->second, &to = after->second, &at = next.point.local;
    constexpr double kShorter = 1 - 0x1p-20;
    if (std::max(norm(at - from), norm(to - at)) > kShorter * norm(to - from)) return true;
    chain.emplace_hint(after, next.along, at);
    return false;
  });
}

}  // namespace impinge::clash
