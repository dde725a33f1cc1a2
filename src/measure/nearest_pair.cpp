// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "core/shapes.hpp"
#include "exact/triangle_pair.hpp"
#include "measure/nearest.hpp"
#include "measure/pair_queue.hpp"
#include "measure/pair_walk.hpp"
#include "measure/triangle_distance.hpp"

namespace impinge::measure {
namespace {

class PairSearch {
 public:
  PairSearch(const PairWalk& walk, double within, double enough, PairMemory& memory)
      : walk_(walk),
        memory_(memory),
        enough_(enough),
        tolerance_(walk.are_remote() ? kRemoteTolerance : 0),
        limit_(within) {}

  std::optional<NearestPair> run(const std::stop_token& stop) {
    const bool is_whole = search_pairs(
        walk_, memory_, limit_, stop, [this](NodePair& pair) { return search_or_open(pair); },
        [this] { return is_done(); });
    if (!is_whole || !found_) return std::nullopt;
    best_.error = best_.distance == 0 ? 0 : std::max(best_.error, best_.distance - least_);
    return best_;
  }

 private:
  /// Between bodies that are remote from each other, the distances of very many pairs differ by a few roundings of
  /// single precision only; to separate them would take as long as testing all pairs.
  static constexpr double kRemoteTolerance = 0x1p-34;

  [[nodiscard]] bool is_done() const { return found_ && (best_.distance == 0 || best_.distance < enough_); }

  /// Whether it was two leaves.
  bool search_or_open(NodePair& pair) {
    walk_.reach(pair);
    if (pair.a.is_leaf() && pair.b.is_leaf()) {
      search_leaves(pair);
      return true;
    }
    memory_.children.clear();
    walk_.open(pair, limit_, memory_.children);
    return false;
  }

  void search_leaves(const NodePair& pair) {
    std::vector<NearTriangles>& near = memory_.near;
    walk_.open_leaves(pair, limit_, Wanted::nearest, near);
    const auto is_near = [&](const NearTriangles& candidate) {
      return !is_done() && walk_.world_length(candidate.lower) <= limit_;
    };
    nearest_first(near, is_near, [&](const NearTriangles& candidate) {
      test(pair.a.leaf().ids()[candidate.a], pair.b.leaf().ids()[candidate.b]);
    });
  }

  void test(std::uint32_t id_a, std::uint32_t id_b) {
    const Triangle a = world_triangle(walk_.a(), id_a), b = world_triangle(walk_.b(), id_b);
    if (overlap(box_of(a), box_of(b)) && exact::classify(a, b)) {
      const auto [p, q] = common_point(a, b);
      found_ = true, limit_ = 0, best_ = {0, 0, p, q, id_a, id_b};
      return;
    }
    const TriangleDistance d = triangle_distance(a, b, limit_, best_.b - best_.a);
    least_ = std::min(least_, d.lower);
    if (d.lower > limit_ || d.distance > limit_) return;
    // They share no point, even if the distance was rounded to 0.
    const double distance = std::max(d.distance, std::numeric_limits<double>::denorm_min());
    found_ = true, limit_ = distance * (1 - tolerance_), best_ = {distance, d.margin, d.a, d.b, id_a, id_b};
    least_ = std::min(least_, limit_);
  }

  const PairWalk& walk_;
  PairMemory& memory_;
  const double enough_, tolerance_;
  double limit_;                                            ///< what is farther is of no interest
  double least_ = std::numeric_limits<double>::infinity();  ///< nothing that was passed over is nearer
  bool found_ = false;
  NearestPair best_{};
};

}  // namespace

std::optional<NearestPair> nearest_pair(const hierarchy::PlacedTree& a, const hierarchy::PlacedTree& b, double within,
                                        double enough, const SearchMeans& means) {
  if (a.mesh->triangles.empty() || b.mesh->triangles.empty()) return std::nullopt;
  const PairWalk walk(a, b, means.for_each);
  std::optional<PairMemory> own;
  PairMemory& memory = means.memory != nullptr ? *means.memory : own.emplace();
  std::optional<NearestPair> found = PairSearch(walk, within, enough, memory).run(means.stop);
  if (found && walk.is_swapped()) std::swap(found->a, found->b), std::swap(found->triangle_a, found->triangle_b);
  return found;
}

}  // namespace impinge::measure
