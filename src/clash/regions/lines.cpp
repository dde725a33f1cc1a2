// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/lines.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <tuple>

#include "core/stopped.hpp"

namespace impinge::clash {
namespace {

/// The graph of the pieces: for each point, in lexicographic order, the pieces that meet there.
class Net {
 public:
  Net(std::vector<Piece> pieces, const std::stop_token& stop) : pieces_(std::move(pieces)), used_(pieces_.size()) {
    for (const Piece& p : pieces_) points_.insert(points_.end(), {p.from, p.to});
    std::sort(points_.begin(), points_.end(), until_stopped(stop, less));
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      const std::uint32_t from = point_at(pieces_[i].from), to = point_at(pieces_[i].to);
      ways_.push_back({from, to, i, true});
      ways_.push_back({to, from, i, false});
    }
    const auto before = [](const Way& x, const Way& y) { return std::tie(x.from, x.to) < std::tie(y.from, y.to); };
    std::sort(ways_.begin(), ways_.end(), until_stopped(stop, before));
    first_.assign(points_.size() + 1, 0);
    for (const Way& way : ways_) ++first_[way.from + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  }

  std::vector<Polyline> lines() {
    std::vector<Polyline> found;
    for (const bool odd : {true, false})
      for (std::uint32_t p = 0; p < points_.size(); ++p) {
        if (odd && !is_odd(p)) continue;
        while (const Way* way = unused(p, 0)) found.push_back(line(*way));
      }
    return found;
  }

 private:
  struct Way {
    std::uint32_t from, to, piece;
    bool forward;
  };

  [[nodiscard]] std::uint32_t point_at(const Vec3& p) const {
    return static_cast<std::uint32_t>(std::lower_bound(points_.begin(), points_.end(), p, less) - points_.begin());
  }
  [[nodiscard]] bool is_odd(std::uint32_t p) const { return (first_[p + 1] - first_[p]) % 2 != 0; }
  [[nodiscard]] double flow(const Way& way) const {
    return way.forward ? pieces_[way.piece].flow : -pieces_[way.piece].flow;
  }

  /// The unused way out of a point that leads to the lowest point; where lines cross, the first one that continues the
  /// flow of the last piece.
  [[nodiscard]] const Way* unused(std::uint32_t p, double last_flow) const {
    const Way* best = nullptr;
    for (std::uint32_t i = first_[p]; i < first_[p + 1]; ++i) {
      if (used_[ways_[i].piece]) continue;
      if (best == nullptr) best = &ways_[i];
      if (flow(ways_[i]) * last_flow > 0) return &ways_[i];
    }
    return best;
  }

  Polyline line(const Way& first) {
    Polyline result;
    result.points.push_back(points_[first.from]);
    for (const Way* way = &first; way != nullptr;) {
      used_[way->piece] = true;
      result.points.push_back(points_[way->to]);
      result.flow += flow(*way);
      const bool ends = way->to == first.from || is_odd(way->to);
      way = ends ? nullptr : unused(way->to, flow(*way));
    }
    return result;
  }

  std::vector<Piece> pieces_;
  std::vector<bool> used_;
  std::vector<Vec3> points_;
  std::vector<Way> ways_;
  std::vector<std::uint32_t> first_;  ///< way out of each point
};

}  // namespace

bool less(const Vec3& p, const Vec3& q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); }
bool is_before(const Piece& x, const Piece& y) { return x.from != y.from ? less(x.from, y.from) : less(x.to, y.to); }

Piece piece(const Vec3& p, const Vec3& q, double flow) { return less(q, p) ? Piece{q, p, -flow} : Piece{p, q, flow}; }

std::vector<Piece> merged(std::vector<Piece> pieces, const std::stop_token& stop) {
  const auto before = [](const Piece& x, const Piece& y) {
    return x.from != y.from || x.to != y.to ? is_before(x, y) : x.flow < y.flow;
  };
  std::sort(pieces.begin(), pieces.end(), until_stopped(stop, before));
  std::size_t kept = 0;
  for (const Piece& next : pieces) {
    if (kept > 0 && !is_before(pieces[kept - 1], next)) {
      pieces[kept - 1].flow += next.flow;
    } else if (next.from != next.to) {
      pieces[kept++] = next;
    }
  }
  pieces.resize(kept);
  return pieces;
}

std::vector<Piece> thinned(std::vector<Piece> pieces, const std::stop_token& stop) {
  std::sort(pieces.begin(), pieces.end(), until_stopped(stop, is_before));
  std::size_t kept = 0;
  for (const Piece& next : pieces)
    if (kept > 1 && !is_before(pieces[kept - 2], next))
      --kept;
    else
      pieces[kept++] = next;
  pieces.resize(kept);
  return pieces;
}

std::vector<Polyline> joined(std::vector<Piece> pieces, const std::stop_token& stop) {
  return Net(merged(std::move(pieces), stop), stop).lines();
}

}  // namespace impinge::clash
