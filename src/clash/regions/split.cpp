// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/split.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "core/stopped.hpp"

namespace impinge::clash {

Splitter::Splitter(std::vector<Vec3> points, const Setting& setting)
    : setting_(setting), points_(sorted(std::move(points))), tree_(local(points_), setting_.stop) {}

std::vector<Vec3> Splitter::sorted(std::vector<Vec3> points) const {
  std::sort(points.begin(), points.end(), until_stopped(setting_.stop, less));
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

std::vector<Vec3> Splitter::local(const std::vector<Vec3>& points) const {
  std::vector<Vec3> result;
  result.reserve(points.size());
  for (const Vec3& p : points) result.push_back(local(p));
  return result;
}

// Twice `within` leaves room for the rounding of clipped ends, which is a few 2^-53 of coordinates up to 2.
std::vector<Splitter::Found> Splitter::points_beside(const Segment& edge) const {
  std::vector<Found> found;
  const Vec3 way = edge[1] - edge[0];
  const double square = dot(way, way);
  tree_.near(edge, 2 * setting_.within + 0x1p-48, [&](std::uint32_t i) {
    const Point point{local(points_[i]), points_[i]};
    const Vec3 from = point.local - edge[0];
    const double along = dot(from, way);
    if (!(along > 0 && along < square) || point.local == edge[1]) return;
    const double share = along / square, off = norm(from - share * way);
    if (off <= setting_.within) found.push_back({share, off, point});
  });
  return found;
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
    pieces = tidy(std::move(parts), setting_.stop);
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
  for (const Piece& whole : pieces) {
    throw_if_stopped(setting_.stop);
    const Segment edge{local(whole.from), local(whole.to)};
    std::vector<Found> found = points_beside(edge);
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
