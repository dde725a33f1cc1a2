// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/manifold/manifold.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "core/hash.hpp"

namespace impinge::clash {
namespace {

/// Shares below which something counts as 0: of a contour's length, where it closes; of a line's length, what lies
/// beside it.
constexpr double kClosed = 0x1p-20, kBeside = 0x1p-20;
/// By what share an extent must be the least to count as less than that of a facet's normal.
constexpr double kClearlyLess = 0x1p-20;
/// The share of the greatest depth as which shallower ones count where points are chosen.
constexpr double kShallow = 0x1p-10;

/// What is summed over the contour of a region.
struct Contour {
  Vec3 about{0, 0, 0};  ///< the mean of its points, from which sums are taken
  double length = 0;
  Vec3 moment{0, 0, 0};  ///< of the lines
  Vec3 gap{0, 0, 0};     ///< the sum of the lines' directions: 0 where they close
  Vec3 flush_area{0, 0, 0};
  Vec3 twice_area{0, 0, 0};  ///< that the lines run round
  double weight = 0;
  std::array<Vec3, 2> normals{};  ///< weighted by length if there is any

  [[nodiscard]] bool is_closed() const { return length > 0 && norm(gap) <= kClosed * length; }
  [[nodiscard]] Vec3 area() const { return flush_area + (is_closed() ? 0.5 * twice_area : Vec3{0, 0, 0}); }
  [[nodiscard]] bool has_area() const { return norm(area()) > kRounding * length; }
};

double weight_of(const Touch& touch, bool by_length) {
  return !by_length ? 1 : touch.has_length() ? norm(touch.shared.points[1] - touch.shared.points[0]) : 0;
}

Vec3 mean_of(std::span<const Vec3> points) {
  Vec3 sum{0, 0, 0};
  for (const Vec3& p : points) sum = sum + p;
  return (1.0 / static_cast<double>(points.size())) * sum;
}

/// Where only one of the two surfaces is flat, its normal is the direction, as in `Region`.
Vec3 direction_without_area(const Contour& contour) {
  const auto is_flat = [&](const Vec3& n) { return norm(n) >= (1 - 0x1p-30) * contour.weight; };
  const auto& [a, b] = contour.normals;
  const Vec3 direction = is_flat(a) == is_flat(b) ? a - b : is_flat(a) ? a : -1.0 * b;
  return norm(direction) > kClosed * contour.weight ? unit_or_zero(direction) : Vec3{0, 0, 0};
}

struct Range {
  double low = kInfinity, high = -kInfinity;
  void add(std::span<const Vec3> points, const Vec3& n) {
    for (const Vec3& p : points) {
      const double at = dot(p, n);
      low = std::min(low, at), high = std::max(high, at);
    }
  }
};

/// The two patches of a region, with the contour that both share.
struct Patches {
  std::span<const Vec3> contour;
  std::array<std::span<const Vec3>, 2> inner;

  [[nodiscard]] Range range(std::size_t side, const Vec3& n) const {
    Range range;
    range.add(contour, n), range.add(inner[side], n);
    return range;
  }
  [[nodiscard]] double extent(const Vec3& n) const { return range(0, n).high - range(1, n).low; }
};

/// Collects the points of a region's contour, and what is summed over it.
Contour contour_of(std::span<const Touch> touches, std::span<const std::uint32_t> region, std::vector<Vec3>& points) {
  points.clear();
  bool by_length = false;
  for (const std::uint32_t i : region) {
    const SharedPoints& shared = touches[i].shared;
    by_length |= shared.size == 2 && shared.points[0] != shared.points[1];
    points.insert(points.end(), shared.points.begin(), shared.points.begin() + shared.size);
  }
  Contour contour{.about = mean_of(points)};
  for (const std::uint32_t i : region) {
    const Touch& touch = touches[i];
    const SharedPoints& shared = touch.shared;
    const double weight = weight_of(touch, by_length);
    contour.weight += weight;
    for (const std::size_t s : {0, 1}) contour.normals[s] = contour.normals[s] + weight * touch.normals[s];
    if (touch.is_flush()) {
      Vec3 twice{0, 0, 0};
      for (std::size_t k = 0; k < shared.size; ++k)
        twice = twice + cross(shared.points[k] - contour.about, shared.points[(k + 1) % shared.size] - contour.about);
      contour.flush_area = contour.flush_area + (0.25 * norm(twice)) * (touch.normals[0] - touch.normals[1]);
    } else if (touch.has_length()) {
      const Vec3 p = shared.points[0] - contour.about, q = shared.points[1] - contour.about;
      const double length = norm(q - p);
      contour.length += length, contour.gap = contour.gap + (q - p);
      contour.moment = contour.moment + (0.5 * length) * (p + q);
      contour.twice_area = contour.twice_area + cross(p, q);
    }
  }
  return contour;
}

/// The direction of the contour's area; or the normal of one of the two facets nearest to it in direction, where the
/// patches' extent along that is clearly less: facets are exact. `is_bound`: the patches are known to their last
/// vertex.
Vec3 normal_of(const Contour& contour, const Patches& patches, bool is_bound, std::span<const Touch> touches,
               std::span<const std::uint32_t> region) {
  const bool has_area = contour.has_area();
  Vec3 normal = has_area ? unit_or_zero(contour.area()) : direction_without_area(contour);
  double extent = patches.extent(normal);
  if (!has_area && !(is_bound && extent > kRounding)) return normal;
  std::array<Vec3, 2> nearest{normal, normal};
  std::array<double, 2> cosine{0, 0};
  for (const std::uint32_t i : region)
    for (const std::size_t s : {0, 1}) {
      const Vec3 outward = (s == 0 ? 1.0 : -1.0) * touches[i].normals[s];
      if (const double along = dot(outward, normal); along > cosine[s]) cosine[s] = along, nearest[s] = outward;
    }
  extent *= 1 + kClearlyLess;
  for (const Vec3& facet : nearest)
    if (const double other = patches.extent(facet); other < extent) extent = other, normal = facet;
  return normal;
}

/// Up to four points: the deepest, of several the farthest from the middle; the one with the greatest depth times
/// distance from it; and with the greatest depth times distance from the line through both, on either side. A depth
/// counts as no less than a small share of the greatest, so that where nothing is deep distance alone decides.
std::uint32_t choose(std::span<const ManifoldCandidate> candidates, double deepest, const Vec3& middle, const Vec3& n,
                     std::array<ManifoldCandidate, 4>& chosen) {
  using Candidate = ManifoldCandidate;
  const double least = std::max(kShallow * deepest, kRounding);
  const auto weight = [&](const Candidate& c) { return std::max(c.depth, least); };
  const auto across = [&](const Vec3& v) { return v - dot(v, n) * n; };
  const auto square = [](const Vec3& v) { return dot(v, v); };
  double best = -1;
  for (const Candidate& c : candidates) {
    if (c.depth < deepest - kRounding) continue;
    const double far = square(across(c.point - middle));
    if (far > best) best = far, chosen[0] = c;
  }
  const Vec3 first = chosen[0].point;
  best = 0;
  for (const Candidate& c : candidates) {
    const double far = square(across(c.point - first)), worth = weight(c) * weight(c) * far;
    if (worth > best && far > kRounding * kRounding) best = worth, chosen[1] = c;
  }
  if (best == 0) return 1;
  const Vec3 line = across(chosen[1].point - first), beside = unit_or_zero(cross(n, line));
  const double nearest = std::max(kBeside * norm(line), kRounding);
  std::array<double, 2> most{0, 0};  // on either side
  std::array<Candidate, 2> found;
  for (const Candidate& c : candidates) {
    const double off = dot(beside, c.point - first), worth = weight(c) * std::abs(off);
    const std::size_t side = off > 0 ? 0 : 1;
    if (worth > most[side] && std::abs(off) > nearest) most[side] = worth, found[side] = c;
  }
  std::uint32_t size = 2;
  for (const std::size_t side : {0, 1})
    if (most[side] > 0) chosen[size++] = found[side];
  return size;
}

}  // namespace

void ManifoldMaker::append(const ContactRow& row, std::vector<Manifold>& manifolds) {
  list_touches(row);
  group(row.surfaces);
  inner_.restart(row.surfaces, touches_);
  // Regions in the order of their first touches, and touches in their own.
  order_.resize(touches_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  const auto region = [&](std::uint32_t i) { return touches_[i].region; };
  std::sort(order_.begin(), order_.end(),
            [&](std::uint32_t i, std::uint32_t j) { return std::pair(region(i), i) < std::pair(region(j), j); });
  for (std::size_t begin = 0, end = 0; begin < order_.size(); begin = end) {
    while (end < order_.size() && region(order_[end]) == region(order_[begin])) ++end;
    manifolds.push_back(measure(std::span(order_).subspan(begin, end - begin), row.surfaces));
  }
}

void ManifoldMaker::list_touches(const ContactRow& row) {
  touches_.clear();
  Facet a{};
  for (std::size_t i = 0; i < row.pairs.size(); ++i) {
    const TrianglePair& pair = row.pairs[i];
    if (i == 0 || pair.a != row.pairs[i - 1].a) a = row.surfaces[0].facet(pair.a);
    const Facet b = row.surfaces[1].facet(pair.b);
    const SharedPoints shared = shared_points(a, b);
    touches_.push_back({.triangles = {pair.a, pair.b}, .normals = {a.normal, b.normal}, .shared = shared, .region = 0});
  }
}

/// The first touch at a pair of positions.
std::uint32_t ManifoldMaker::first_at(std::uint64_t key, std::uint32_t touch) {
  std::size_t at = mix(key) & (slots_.size() - 1);
  while (slots_[at].round == round_ && slots_[at].key != key) at = (at + 1) & (slots_.size() - 1);
  if (slots_[at].round != round_) slots_[at] = {key, touch, round_};
  return slots_[at].touch;
}

/// Joins touches whose triangles have a position in common in both surfaces.
void ManifoldMaker::group(const std::array<PlacedSurface, 2>& surfaces) {
  const std::size_t room = std::bit_ceil(2 * 9 * touches_.size() + 1);
  if (++round_ == 0 || slots_.size() < room) slots_.assign(std::max(room, slots_.size()), Slot{0, 0, 0}), round_ = 1;
  groups_.restart(touches_.size());
  for (std::uint32_t i = 0; i < touches_.size(); ++i) {
    const auto& [a, b] = touches_[i].triangles;
    std::uint32_t group = i;
    for (const std::uint32_t vertex_a : surfaces[0].mesh->triangles[a])
      for (const std::uint32_t vertex_b : surfaces[1].mesh->triangles[b]) {
        const std::uint64_t position_a = surfaces[0].topology->position[vertex_a];
        group = groups_.join(group, first_at(position_a << 32 | surfaces[1].topology->position[vertex_b], i));
      }
  }
  for (std::uint32_t i = 0; i < touches_.size(); ++i) touches_[i].region = groups_.find(i);
}

Manifold ManifoldMaker::measure(std::span<const std::uint32_t> region, const std::array<PlacedSurface, 2>& surfaces) {
  const LocalFrame& frame = surfaces[0].frame;
  const Contour contour = contour_of(touches_, region, contour_);
  // Along sides that are flush the lines of both patches are listed, so that those of two solids need not close.
  const bool is_bound = contour.is_closed() || (surfaces[0].topology->closed && surfaces[1].topology->closed);
  Patches patches{contour_, {}};
  if (is_bound)
    for (const int side : {0, 1})
      patches.inner[static_cast<std::size_t>(side)] = inner_.patch(touches_[region.front()].region, side);
  const Vec3 normal = normal_of(contour, patches, is_bound, touches_, region);

  Manifold manifold;
  const Vec3 middle = contour.length > 0 ? contour.about + (1 / contour.length) * contour.moment : contour.about;
  const Range a = patches.range(0, normal), b = patches.range(1, normal);
  const bool a_is_reference = a.high - a.low <= b.high - b.low;
  // Points of b lie below the plane that touches a's patch from above; of a above the one that touches b's from below.
  const std::size_t side = a_is_reference ? 1 : 0;
  const Vec3 outward = a_is_reference ? -1.0 * normal : normal;
  const double plane = a_is_reference ? -a.high : b.low;
  const double deepest = std::max(0.0, a.high - b.low);
  manifold.middle = frame.to_world(middle), manifold.normal = normal, manifold.depth = deepest / frame.unit;
  candidates_.clear();
  for (const std::span<const Vec3> some : {patches.contour, patches.inner[side]})
    for (const Vec3& p : some) candidates_.push_back({p, std::max(0.0, dot(p, outward) - plane)});
  std::array<ManifoldCandidate, 4> chosen;
  manifold.size = choose(candidates_, deepest, middle, normal, chosen);
  for (std::size_t i = 0; i < manifold.size; ++i) {
    const Vec3 beyond = chosen[i].point - chosen[i].depth * outward;
    manifold.points[i] = {.a = frame.to_world(a_is_reference ? beyond : chosen[i].point),
                          .b = frame.to_world(a_is_reference ? chosen[i].point : beyond),
                          .depth = chosen[i].depth / frame.unit};
  }
  return manifold;
}

}  // namespace impinge::clash
