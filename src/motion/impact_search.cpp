// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/impact_search.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

#include "core/stopped.hpp"
#include "motion/impact.hpp"

namespace impinge::motion {

namespace {

bool in_order(const Impact& x, const Impact& y) {
  return std::tie(x.feature, x.a, x.b) < std::tie(y.feature, y.a, y.b);
}

bool sooner(const Interval& x, const Interval& y) { return std::tie(x.lo, x.hi) < std::tie(y.lo, y.hi); }

/// Subtrees of both trees.
struct Pair {
  PathTree::Part a, b;
};

class Search {
 public:
  Search(const MovingMesh& a, const MovingMesh* b, const ImpactQuery& query)
      : a_(a), b_(b != nullptr ? *b : a), itself_(b == nullptr), query_(query), end_(query.end) {}

  Impacts run() {
    if (a_.features.corners.empty() || b_.features.corners.empty()) return {};
    std::vector<Pair> open{{a_.tree.root(), b_.tree.root()}};
    // Enough pairs of subtrees for every thread, level by level.
    constexpr std::size_t kTasks = 512;
    while (open.size() < kTasks) {
      std::vector<Pair> next;
      bool split = false;
      for (const Pair& pair : open) {
        if (is_leaves(pair))
          next.push_back(pair);
        else
          split = true, open_up(pair, next);
      }
      open = std::move(next);
      if (!split) break;
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

  [[nodiscard]] static bool is_leaves(const Pair& pair) { return pair.a.leaves == 1 && pair.b.leaves == 1; }

  void open_up(const Pair& pair, std::vector<Pair>& next) const {
    const auto add = [&](const PathTree::Part& a, const PathTree::Part& b) {
      const bool same = itself_ && a.node == b.node;
      if (same || !stay_apart(a_.tree.nodes[a.node], b_.tree.nodes[b.node], end_.load(std::memory_order_relaxed)))
        next.push_back({a, b});
    };
    if (itself_ && pair.a.node == pair.b.node) {
      add(pair.a.left(), pair.a.left());
      add(pair.a.left(), pair.a.right());
      add(pair.a.right(), pair.a.right());
    } else if (pair.a.leaves >= pair.b.leaves) {
      add(pair.a.left(), pair.b);
      add(pair.a.right(), pair.b);
    } else {
      add(pair.a, pair.b.left());
      add(pair.a, pair.b.right());
    }
  }

  void walk(const Pair& from) {
    Found found;
    std::vector<Pair> open{from};
    for (std::size_t steps = 0; !open.empty(); ++steps) {
      if (steps % 64 == 0) throw_if_stopped(query_.stop);
      const Pair pair = open.back();
      open.pop_back();
      if (is_leaves(pair))
        test_leaves(pair, found);
      else
        open_up(pair, open);
    }
    const std::scoped_lock lock(mutex_);
    found_.impacts.insert(found_.impacts.end(), found.impacts.begin(), found.impacts.end());
    found_.truncated |= found.truncated;
    note(found.earliest, found_);
    cut(found_);
  }

  struct Triangles {
    std::array<BoxPath, PathTree::kLeafSize> paths;
    std::array<std::uint32_t, PathTree::kLeafSize> indices;
    std::size_t count = 0;
  };
  /// Those of a leaf that may meet what is in the other.
  static Triangles near(const MovingMesh& mesh, std::span<const std::uint32_t> leaf, const BoxPath& other, double end) {
    Triangles result;
    for (const std::uint32_t i : leaf) {
      result.paths[result.count] = path_of(mesh.vertices, mesh.features.corners[i]);
      result.indices[result.count] = i;
      result.count += std::size_t{!stay_apart(result.paths[result.count], other, end)};
    }
    return result;
  }

  void test_leaves(const Pair& pair, Found& found) {
    const double end = end_.load(std::memory_order_relaxed);
    const bool same = itself_ && pair.a.node == pair.b.node;
    const Triangles a = near(a_, a_.tree.triangles_of(pair.a), b_.tree.nodes[pair.b.node], end);
    if (a.count == 0) return;
    const Triangles b = near(b_, b_.tree.triangles_of(pair.b), a_.tree.nodes[pair.a.node], end);
    for (std::size_t i = 0; i < a.count; ++i)
      for (std::size_t j = same ? i + 1 : 0; j < b.count; ++j)
        if (!stay_apart(a.paths[i], b.paths[j], end)) test(a.indices[i], b.indices[j], found);
  }

  void test(std::uint32_t i, std::uint32_t j, Found& found) {
    const std::uint8_t care_i = a_.features.care[i], care_j = b_.features.care[j];
    for (int k = 0; k < 3; ++k) {
      if ((care_i >> k & 1) != 0) test_vertex(a_, i, k, b_, j, Feature::vertex_face, found);
      if ((care_j >> k & 1) != 0)
        test_vertex(b_, j, k, a_, i, itself_ ? Feature::vertex_face : Feature::face_vertex, found);
    }
    for (int k = 0; k < 3; ++k)
      for (int l = 0; (care_i >> (3 + k) & 1) != 0 && l < 3; ++l)
        if ((care_j >> (3 + l) & 1) != 0) test_edges(a_.features.sides[i][k], b_.features.sides[j][l], found);
  }

  void test_vertex(const MovingMesh& of, std::uint32_t triangle, int corner, const MovingMesh& other,
                   std::uint32_t face, Feature feature, Found& found) {
    const std::uint32_t vertex = of.features.corners[triangle][corner];
    const Corners& c = other.features.corners[face];
    if (itself_ && (c[0] == vertex || c[1] == vertex || c[2] == vertex)) return;
    const FourPoints from{of.vertices.from[vertex], other.vertices.from[c[0]], other.vertices.from[c[1]],
                          other.vertices.from[c[2]]};
    const FourPoints to{of.vertices.to[vertex], other.vertices.to[c[0]], other.vertices.to[c[1]],
                        other.vertices.to[c[2]]};
    const bool swapped = feature == Feature::face_vertex;
    add({feature, swapped ? face : vertex, swapped ? vertex : face, {}, {}, {}}, vertex_face_impact(from, to), found);
  }

  void test_edges(std::uint32_t i, std::uint32_t j, Found& found) {
    if (itself_ && i > j) std::swap(i, j);
    const auto& e = a_.features.edges[i];
    const auto& f = b_.features.edges[j];
    if (itself_ && (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1])) return;
    const FourPoints from{a_.vertices.from[e[0]], a_.vertices.from[e[1]], b_.vertices.from[f[0]],
                          b_.vertices.from[f[1]]};
    const FourPoints to{a_.vertices.to[e[0]], a_.vertices.to[e[1]], b_.vertices.to[f[0]], b_.vertices.to[f[1]]};
    add({Feature::edge_edge, i, j, {}, {}, {}}, edge_edge_impact(from, to), found);
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
      const Vec3 a = at(a_.vertices, e[0], t), u = at(a_.vertices, e[1], t) - a;
      const Vec3 b = at(b_.vertices, f[0], t), v = at(b_.vertices, f[1], t) - b;
      normal = cross(u, v);
      // The points of two lines that are nearest to each other; where they are parallel, that of `a` nearest to b's
      // middle.
      const double nn = dot(normal, normal), uu = dot(u, u);
      double s = nn > 0 ? dot(cross(b - a, v), normal) / nn : uu > 0 ? dot(b + 0.5 * v - a, u) / uu : 0;
      s = s >= 0 ? std::min(s, 1.0) : 0;  // far from 1 it may be no number
      impact.point = a + s * u;
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
    const double length = norm(normal);
    const double sign = dot(normal, way) < 0 ? -1 : 1;
    impact.normal = length > 0 && std::isfinite(length) ? (sign / length) * normal : Vec3{0, 0, 0};
  }

  const MovingMesh &a_, &b_;
  bool itself_;
  const ImpactQuery& query_;
  std::atomic<double> end_;  ///< of the time that is still of interest
  std::mutex mutex_;
  Found found_;
};

}  // namespace

Impacts find_impacts(const MovingMesh& a, const MovingMesh* b, const ImpactQuery& query) {
  return Search(a, b, query).run();
}

}  // namespace impinge::motion
