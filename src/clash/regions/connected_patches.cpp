// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/connected_patches.hpp"

#include <algorithm>
#include <utility>

#include "clash/regions/lines.hpp"
#include "core/disjoint_sets.hpp"

namespace impinge::clash {
namespace {

/// The coordinate along which lines of sight run, and the one across.
struct Axes {
  int along, across;
};

/// The axes of the coordinate plane that is most nearly parallel to the triangle.
Axes axes_of(const Triangle& t) {
  const Vec3 normal = abs(cross(t[1] - t[0], t[2] - t[0]));
  if (normal.x >= std::max(normal.y, normal.z)) return {1, 2};
  return normal.y >= normal.z ? Axes{2, 0} : Axes{0, 1};
}

/// Connects marks that have an end in common.
DisjointSets chains_of(std::span<const Mark> marks) {
  std::vector<std::pair<Vec3, std::uint32_t>> ends;
  for (std::uint32_t i = 0; i < marks.size(); ++i)
    for (const Vec3& end : {marks[i].from, marks[i].to}) ends.emplace_back(end, i);
  std::sort(ends.begin(), ends.end(), [](const auto& x, const auto& y) { return less(x.first, y.first); });
  DisjointSets chains(marks.size());
  for (std::size_t i = 1; i < ends.size(); ++i)
    if (ends[i].first == ends[i - 1].first) chains.join(ends[i].second, ends[i - 1].second);
  return chains;
}

/// Segments in strips along the lines of sight. There are about as many strips as the square root of the number of
/// segments, so that long segments, which are in many strips, do not fill the memory.
class Strips {
 public:
  Strips(std::span<const Segment> segments, const Axes& axes) : segments_(segments), axes_(axes) {
    lo_ = std::numeric_limits<double>::infinity();
    double hi = -lo_;
    for (const Segment& s : segments) {
      const auto [low, high] = range(s);
      lo_ = std::min(lo_, low), hi = std::max(hi, high);
    }
    strips_.resize(1 + static_cast<std::size_t>(std::sqrt(static_cast<double>(segments.size()))));
    scale_ = hi > lo_ ? static_cast<double>(strips_.size()) / (hi - lo_) : 0;
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
      const auto [low, high] = range(segments[i]);
      for (std::size_t s = strip_of(low); s <= strip_of(high); ++s) strips_[s].push_back(i);
    }
  }

  /// The first segment that counts on the line of sight from a point, and where it is met.
  template <class Counts>
  [[nodiscard]] std::pair<std::uint32_t, Vec3> first_from(const Vec3& from, const Counts& counts) const {
    std::uint32_t best = kNone;
    Vec3 at{};
    for (const std::uint32_t i : strips_[strip_of(component(from, axes_.across))]) {
      const auto& [p, q] = segments_[i];
      const double height = component(from, axes_.across);
      const double from_p = component(p, axes_.across) - height, from_q = component(q, axes_.across) - height;
      if ((from_p > 0) == (from_q > 0) || !counts(i)) continue;
      const double share = from_p / (from_p - from_q);
      const Vec3 hit = p + share * (q - p);
      const double where = component(hit, axes_.along);
      if (where > component(from, axes_.along) && (best == kNone || where < component(at, axes_.along)))
        best = i, at = hit;
    }
    return {best, at};
  }
  static constexpr std::uint32_t kNone = 0xffffffff;

 private:
  [[nodiscard]] std::pair<double, double> range(const Segment& s) const {
    return std::minmax({component(s[0], axes_.across), component(s[1], axes_.across)});
  }
  [[nodiscard]] std::size_t strip_of(double x) const {
    const double strip = std::clamp(scale_ * (x - lo_), 0.0, static_cast<double>(strips_.size() - 1));
    return static_cast<std::size_t>(strip);
  }

  std::span<const Segment> segments_;
  Axes axes_;
  double lo_, scale_;
  std::vector<std::vector<std::uint32_t>> strips_;
};

}  // namespace

std::vector<Sight> sights(const Triangle& triangle, std::span<const Mark> marks) {
  const Axes axes = axes_of(triangle);
  const auto n = static_cast<std::uint32_t>(marks.size());
  DisjointSets chains = chains_of(marks);
  std::vector<bool> anchored(n);
  std::vector<Vec3> outermost(n);
  const auto is_farther = [&](const Vec3& p, const Vec3& q) {
    const double x = component(p, axes.along), y = component(q, axes.along);
    return x != y ? x > y : component(p, axes.across) > component(q, axes.across);
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t chain = chains.find(i);
    if (chain == i) outermost[i] = marks[i].from;
    if (marks[i].on_border) anchored[chain] = true;
    for (const Vec3& end : {marks[i].from, marks[i].to})
      if (is_farther(end, outermost[chain])) outermost[chain] = end;
  }
  std::vector<Segment> segments;
  for (const Mark& mark : marks) segments.push_back({mark.from, mark.to});
  for (int e = 0; e < 3; ++e) segments.push_back({triangle[e], triangle[(e + 1) % 3]});
  const Strips strips(segments, axes);
  std::vector<Sight> found;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (chains.find(i) != i || anchored[i]) continue;
    const auto [hit, at] =
        strips.first_from(outermost[i], [&](std::uint32_t s) { return s >= n || chains.find(s) != i; });
    if (hit == Strips::kNone) continue;  // rounding has put the patch beyond the border
    found.push_back({outermost[i], at, marks[i].contact, hit < n ? marks[hit].contact : Sight::kBorder + (hit - n)});
  }
  return found;
}

}  // namespace impinge::clash
