// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/impact_search.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

#include "core/number.hpp"
#include "core/stopped.hpp"
#include "motion/approach.hpp"
#include "motion/filter.hpp"
#include "motion/impact.hpp"
#include "motion/leaf_features.hpp"

namespace impinge::motion {

namespace {

bool in_order(const Impact& x, const Impact& y) {
  return std::tie(x.feature, x.a, x.b) < std::tie(y.feature, y.a, y.b);
}

bool sooner(const Interval& x, const Interval& y) { return std::tie(x.lo, x.hi) < std::tie(y.lo, y.hi); }

/// Nodes of one level of both trees.
struct NodePair {
  std::size_t level, a, b;
};

/// What a task needs; kept for the next one.
class Scratch {
 public:
  FeaturePairs pairs;

  /// `trees`: one or two.
  explicit Scratch(std::size_t trees) : entries_(kEntries / trees) {}

  /// The features of a leaf of tree `which`; those of `kept` stay.
  const LeafFeatures& features_of(const PathTree& tree, const Features& features, std::size_t which, std::size_t leaf,
                                  const LeafFeatures* kept) {
    const std::size_t usual = leaf % entries_ + which * entries_;
    const std::size_t i = &features_[usual] == kept && leaves_[usual] != leaf ? kEntries : usual;
    if (leaves_[i] != leaf) features_[i].read(tree, features, leaf), leaves_[i] = leaf;
    return features_[i];
  }

 private:
  static constexpr std::size_t kEntries = 256;
  std::size_t entries_;  ///< of each tree
  std::vector<std::size_t> leaves_ = std::vector<std::size_t>(kEntries + 1, ~std::size_t{0});
  std::unique_ptr<LeafFeatures[]> features_ = std::make_unique_for_overwrite<LeafFeatures[]>(kEntries + 1);
};

class Search {
 public:
  Search(const MovingMesh& a, const MovingMesh* b, const ImpactQuery& query)
      : a_(a), b_(b != nullptr ? *b : a), itself_(b == nullptr), query_(query), end_(query.end) {
    if (itself_ && query.separation > 0) neighbours_.emplace(a.features);
  }

  Impacts run() {
    if (a_.features.corners.empty() || b_.features.corners.empty()) return {};
    std::vector<NodePair> open{{a_.tree.levels.size() - 1, 0, 0}};
    // Enough pairs of nodes for every thread, level by level.
    constexpr std::size_t kTasks = 64;
    while (open.size() < kTasks && !open.empty() && open.front().level > 0) {
      std::vector<NodePair> next;
      for (const NodePair& pair : open) open_up(pair, next);
      open = std::move(next);
    }
    run_each(query_.for_each, open.size(), [&](std::size_t i) { walk(open[i]); });
    return finish();
  }

 private:
  struct Found {
    std::vector<Impact> impacts;
    std::optional<Interval> earliest;
    bool truncated = false;
  };

  /// What is still of interest, of the trees' time rounded up.
  [[nodiscard]] Sought sought() const {
    const double end = end_.load(std::memory_order_relaxed);
    if (end >= a_.tree.end_time) return {query_.reach, 1};
    return {query_.reach, std::min(1.0f, std::nextafter(static_cast<float>(end / a_.tree.end_time), 2.0f))};
  }

  /// Calls `visit` with each pair of children that may meet.
  template <class Visit>
  void visit_children(const NodePair& pair, const Visit& visit) const {
    std::uint64_t bits = may_meet(a_.tree.levels[pair.level][pair.a], b_.tree.levels[pair.level][pair.b], sought());
    for (; bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(bits));
      const std::size_t a = kWidth * pair.a + bit / kWidth, b = kWidth * pair.b + bit % kWidth;
      if (!itself_ || a <= b) visit(a, b);
    }
  }
  void open_up(const NodePair& pair, std::vector<NodePair>& next) const {
    visit_children(pair, [&](std::size_t a, std::size_t b) { next.push_back({pair.level - 1, a, b}); });
  }

  void walk(const NodePair& from) {
    Found found;
    std::unique_ptr<Scratch> scratch = take_scratch();
    std::vector<NodePair> open{from};
    while (!open.empty()) {
      throw_if_stopped(query_.stop);
      const NodePair pair = open.back();
      open.pop_back();
      if (pair.level > 0)
        open_up(pair, open);
      else
        visit_children(pair, [&](std::size_t a, std::size_t b) { pair_leaves(a, b, *scratch, found); });
    }
    for (const Feature feature : {Feature::vertex_face, Feature::face_vertex, Feature::edge_edge})
      test(feature, *scratch, found);
    const std::scoped_lock lock(mutex_);
    scratches_.push_back(std::move(scratch));
    found_.impacts.insert(found_.impacts.end(), found.impacts.begin(), found.impacts.end());
    found_.truncated |= found.truncated;
    note(found.earliest, found_);
    cut(found_);
  }

  std::unique_ptr<Scratch> take_scratch() {
    const std::scoped_lock lock(mutex_);
    if (scratches_.empty()) return std::make_unique<Scratch>(itself_ ? 1 : 2);
    std::unique_ptr<Scratch> scratch = std::move(scratches_.back());
    scratches_.pop_back();
    return scratch;
  }

  void pair_leaves(std::size_t i, std::size_t j, Scratch& scratch, Found& found) {
    const LeafFeatures& a = scratch.features_of(a_.tree, a_.features, 0, i, nullptr);
    const LeafFeatures& b = scratch.features_of(b_.tree, b_.features, itself_ ? 0 : 1, j, &a);
    add_pairs(a, b,
              !itself_ ? Leaves::of_two_meshes
              : i == j ? Leaves::the_same
                       : Leaves::of_one_mesh,
              sought(), scratch.pairs);
    for (const Feature feature : {Feature::vertex_face, Feature::face_vertex, Feature::edge_edge})
      if (scratch.pairs.lists[static_cast<std::size_t>(feature)].count + FeaturePairs::kMost > FeaturePairs::kRoom)
        test(feature, scratch, found);
  }

  /// The points of a pair of features at one end.
  [[nodiscard]] FourPoints points_of(Feature feature, const std::array<std::uint32_t, 2>& pair, bool at_end) const {
    const auto of = [at_end](const MovingMesh& mesh) { return at_end ? mesh.vertices.to : mesh.vertices.from; };
    const auto a = of(a_), b = of(b_);
    if (feature == Feature::edge_edge) {
      const auto &e = a_.features.edges[pair[0]], &f = b_.features.edges[pair[1]];
      return {a[e[0]], a[e[1]], b[f[0]], b[f[1]]};
    }
    const bool swapped = feature == Feature::face_vertex;
    const Corners& c = (swapped ? a_ : b_).features.corners[pair[1]];
    const auto vertices = swapped ? b : a, faces = swapped ? a : b;
    return {vertices[pair[0]], faces[c[0]], faces[c[1]], faces[c[2]]};
  }

  [[nodiscard]] bool are_neighbours(Feature feature, const std::array<std::uint32_t, 2>& pair) const {
    if (!neighbours_) return false;
    return feature == Feature::edge_edge ? neighbours_->edges(pair[0], pair[1])
                                         : neighbours_->vertex_and_face(pair[0], pair[1]);
  }

  /// Of those that were listed, the ones that are to keep a distance. What is left in the list are the others.
  void test_separation(Feature feature, FeaturePairs::List& list, Found& found) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < list.count; ++i) {
      throw_if_stopped(query_.stop);  // one pair may take thousands of parts of the time
      const auto pair = list.pairs[i];
      if (are_neighbours(feature, pair)) {
        list.pairs[left++] = pair;
        continue;
      }
      const FourPoints from = points_of(feature, pair, false), to = points_of(feature, pair, true);
      const double until = end_.load(std::memory_order_relaxed);
      const auto near = feature == Feature::edge_edge ? edge_edge_approach(from, to, query_.separation, until)
                                                      : vertex_face_approach(from, to, query_.separation, until);
      if (!near) continue;
      const bool swapped = feature == Feature::face_vertex;
      add({feature, pair[swapped ? 1 : 0], pair[swapped ? 0 : 1], {}, {}, (swapped ? -1 : 1) * near->normal},
          Interval{near->time, near->time}, found);
    }
    list.count = left;
  }

  /// All of one kind that were listed.
  void test(Feature feature, Scratch& scratch, Found& found) {
    FeaturePairs::List& list = scratch.pairs.lists[static_cast<std::size_t>(feature)];
    if (query_.separation > 0) test_separation(feature, list, found);
    const bool on_edges = feature == Feature::edge_edge;
    for (std::size_t first = 0; first < list.count; first += FourPointsBlock::kLanes) {
      throw_if_stopped(query_.stop);
      FourPointsBlock block;
      const std::size_t count = std::min<std::size_t>(FourPointsBlock::kLanes, list.count - first);
      for (std::size_t lane = 0; lane < FourPointsBlock::kLanes; ++lane) {
        const auto& pair = list.pairs[first + std::min(lane, count - 1)];
        const FourPoints from = points_of(feature, pair, false), to = points_of(feature, pair, true);
        for (int i = 0; i < 4; ++i)
          for (int axis = 0; axis < 3; ++axis) {
            block.from[i][axis][lane] = component(from[i], axis);
            block.to[i][axis][lane] = component(to[i], axis);
          }
      }
      const double until = end_.load(std::memory_order_relaxed);
      std::uint32_t bits = on_edges ? edges_may_meet(block, until) : faces_may_meet(block, until);
      for (bits &= (1u << count) - 1; bits != 0; bits &= bits - 1) {
        const auto& pair = list.pairs[first + static_cast<std::size_t>(std::countr_zero(bits))];
        const FourPoints from = points_of(feature, pair, false), to = points_of(feature, pair, true);
        const auto time = on_edges ? edge_edge_impact(from, to) : vertex_face_impact(from, to);
        const bool swapped = feature == Feature::face_vertex;
        add({feature, pair[swapped ? 1 : 0], pair[swapped ? 0 : 1], {}, {}, {}}, time, found);
      }
    }
    list.count = 0;
  }

  void add(Impact impact, const std::optional<Interval>& time, Found& found) {
    if (!time || time->hi > query_.end) return;
    impact.time = *time;
    if (query_.earliest) {
      if (time->lo > end_.load(std::memory_order_relaxed)) return;
      for (double end = end_; time->hi < end && !end_.compare_exchange_weak(end, time->hi);) {
      }
    }
    note(time, found);
    found.impacts.push_back(impact);
    if (found.impacts.size() >= 4096 && (query_.earliest || found.impacts.size() / 2 >= query_.limit)) cut(found);
  }

  static void note(const std::optional<Interval>& time, Found& found) {
    if (time && (!found.earliest || sooner(*time, *found.earliest))) found.earliest = time;
  }

  /// To what is asked for.
  void cut(Found& found) const {
    if (query_.earliest) {
      std::erase_if(found.impacts, [&](const Impact& x) { return sooner(*found.earliest, x.time); });
      const auto first = std::min_element(found.impacts.begin(), found.impacts.end(), in_order);
      if (first != found.impacts.end()) found.impacts = {*first};
    } else if (found.impacts.size() > query_.limit) {
      const auto last = found.impacts.begin() + static_cast<std::ptrdiff_t>(query_.limit);
      std::nth_element(found.impacts.begin(), last, found.impacts.end(), in_order);
      found.impacts.erase(last, found.impacts.end());
      found.truncated = true;
    }
  }

  Impacts finish() {
    std::sort(found_.impacts.begin(), found_.impacts.end(), in_order);
    for (Impact& impact : found_.impacts) {
      place(impact);
      if (impact.feature != Feature::edge_edge) continue;
      for (std::uint32_t* edge : {&impact.a, &impact.b})
        if (const auto& names = a_.features.names; !names.empty()) *edge = names[*edge];
    }
    return {std::move(found_.impacts), found_.earliest, found_.truncated};
  }

  /// Where it happens, and the normal: up to rounding.
  void place(Impact& impact) const {
    const auto at = [](const Vertices& v, std::uint32_t i, double t) { return (1 - t) * v.from[i] + t * v.to[i]; };
    const double t = impact.time.lo;
    Vec3 normal, way;
    if (impact.feature == Feature::edge_edge) {
      const auto& e = a_.features.edges[impact.a];
      const auto& f = b_.features.edges[impact.b];
      FourPoints points{at(a_.vertices, e[0], t), at(a_.vertices, e[1], t), at(b_.vertices, f[0], t),
                        at(b_.vertices, f[1], t)};
      // Times a power of two, so that products neither overflow nor vanish.
      double largest = 0;
      for (const Vec3& p : points) largest = std::max(largest, max_component(abs(p)));
      const double scale = largest > 0 ? std::ldexp(1.0, std::clamp(-2 - exponent(largest), -1000, 1000)) : 1;
      const Vec3 start = points[0], end = points[1];
      for (Vec3& p : points) p = scale * p;
      const Vec3 a = points[0], u = points[1] - a, b = points[2], v = points[3] - b;
      normal = cross(u, v);
      // The points of two lines that are nearest to each other; where they are parallel, that of `a` nearest to b's
      // middle.
      const double nn = dot(normal, normal), uu = dot(u, u);
      double s = nn > 0 ? dot(cross(b - a, v), normal) / nn : uu > 0 ? dot(b + 0.5 * v - a, u) / uu : 0;
      s = s >= 0 ? std::min(s, 1.0) : 0;  // far from 1 it may be no number
      if (const double vv = dot(v, v); query_.separation > 0 && uu > 0 && vv > 0)
        s = std::clamp(dot(b + std::clamp(dot(a + s * u - b, v) / vv, 0.0, 1.0) * v - a, u) / uu, 0.0, 1.0);
      impact.point = (1 - s) * start + s * end;
      way = at(a_.vertices, e[0], 0) - at(b_.vertices, f[0], 0);
    } else {
      const bool swapped = impact.feature == Feature::face_vertex;
      const MovingMesh &face_of = swapped ? a_ : b_, &vertex_of = swapped ? b_ : a_;
      const Corners& c = face_of.features.corners[swapped ? impact.a : impact.b];
      const std::uint32_t vertex = swapped ? impact.b : impact.a;
      const Vec3 p = at(face_of.vertices, c[0], t);
      normal = cross(at(face_of.vertices, c[1], t) - p, at(face_of.vertices, c[2], t) - p);
      impact.point = at(vertex_of.vertices, vertex, t);
      way = at(vertex_of.vertices, vertex, 0) - at(face_of.vertices, c[0], 0);
      if (swapped) way = -1 * way;
    }
    if (impact.normal != Vec3{0, 0, 0}) return;  // known, since they are apart
    const double length = norm(normal);
    const double sign = dot(normal, way) < 0 ? -1 : 1;
    impact.normal = length > 0 && std::isfinite(length) ? (sign / length) * normal : Vec3{0, 0, 0};
  }

  const MovingMesh &a_, &b_;
  bool itself_;
  const ImpactQuery& query_;
  std::optional<Neighbours> neighbours_;  ///< where a mesh is to keep a distance from itself
  std::vector<std::unique_ptr<Scratch>> scratches_;
  std::atomic<double> end_;  ///< of the time that is still of interest
  std::mutex mutex_;
  Found found_;
};

}  // namespace

Impacts find_impacts(const MovingMesh& a, const MovingMesh* b, const ImpactQuery& query) {
  return Search(a, b, query).run();
}

}  // namespace impinge::motion
