// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene/vertex_numbers.hpp"

#include <algorithm>

#include "core/hash.hpp"
#include "core/vec3.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/vertex_numbers.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/mix-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::scene::HWY_NAMESPACE {

using Doubles = hwy::HWY_NAMESPACE::CappedTag<double, 8>;

/// Three vectors hold as many vertices as one has lanes, each lane a coordinate of its own. `xyz` holds whole runs.
void measure(const double* xyz, VertexNumbers& numbers, Box* boxes, std::size_t runs) {
  namespace hn = hwy::HWY_NAMESPACE;
  const Doubles d;
  const hn::RebindToUnsigned<Doubles> du;
  constexpr std::size_t kNumbers = 3 * VertexNumbers::kRun;
  const std::size_t lanes = hn::Lanes(d);
  const auto infinity = hn::Set(d, kInfinity);
  const auto fraction_bits = hn::Set(du, (std::uint64_t{1} << 52) - 1);
  auto least = hn::Set(d, numbers.least), last_place = hn::Set(d, numbers.last_place);
  auto finite = hn::Eq(least, least);
  for (std::size_t run = 0; run < runs; ++run, xyz += kNumbers) {
    auto lo_0 = hn::LoadU(d, xyz), lo_1 = hn::LoadU(d, xyz + lanes), lo_2 = hn::LoadU(d, xyz + 2 * lanes);
    auto hi_0 = lo_0, hi_1 = lo_1, hi_2 = lo_2;
    const auto take = [&](const double* from, auto& lo, auto& hi) HWY_ATTR {
      const auto x = hn::LoadU(d, from), size = hn::Abs(x);
      lo = hn::Min(lo, x), hi = hn::Max(hi, x);
      finite = hn::And(finite, hn::Lt(size, infinity));
      // Without its lowest bit a number lacks that bit's value, exactly. If no bit of the fraction is set, that is the
      // number's own.
      const auto bits = hn::BitCast(du, x);
      const auto without = hn::BitCast(d, hn::And(bits, hn::Sub(bits, hn::Set(du, 1))));
      const auto is_power = hn::RebindMask(d, hn::Eq(hn::And(bits, fraction_bits), hn::Zero(du)));
      const auto place = hn::IfThenElse(is_power, size, hn::Abs(hn::Sub(x, without)));
      const auto is_zero = hn::Eq(x, hn::Zero(d));
      least = hn::Min(least, hn::IfThenElse(is_zero, infinity, size));
      last_place = hn::Min(last_place, hn::IfThenElse(is_zero, infinity, place));
    };
    for (std::size_t i = 0; i < kNumbers; i += 3 * lanes)
      take(xyz + i, lo_0, hi_0), take(xyz + i + lanes, lo_1, hi_1), take(xyz + i + 2 * lanes, lo_2, hi_2);
    alignas(64) double lo[24], hi[24];
    hn::Store(lo_0, d, lo), hn::Store(lo_1, d, lo + lanes), hn::Store(lo_2, d, lo + 2 * lanes);
    hn::Store(hi_0, d, hi), hn::Store(hi_1, d, hi + lanes), hn::Store(hi_2, d, hi + 2 * lanes);
    for (std::size_t i = 3; i < 3 * lanes; ++i)
      lo[i % 3] = std::min(lo[i % 3], lo[i]), hi[i % 3] = std::max(hi[i % 3], hi[i]);
    boxes[run] = {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
  }
  numbers.is_finite = numbers.is_finite && hn::AllTrue(d, finite);
  numbers.least = hn::GetLane(hn::MinOfLanes(d, least));
  numbers.last_place = hn::GetLane(hn::MinOfLanes(d, last_place));
}

std::uint64_t vertex_hash(std::span<const Vec3> vertices) {
  namespace hn = hwy::HWY_NAMESPACE;
  const impinge::HWY_NAMESPACE::HashLanes d;
  const Doubles of_doubles;
  const std::size_t lanes = hn::Lanes(d), whole = vertices.size() / lanes * lanes;
  auto sum = hn::Zero(d), number = hn::Iota(d, 0);
  const auto bits = [&](auto x) HWY_ATTR {
    return hn::BitCast(d, hn::IfThenZeroElse(hn::Eq(x, hn::Zero(of_doubles)), x));  // -0 taken as +0
  };
  for (std::size_t i = 0; i < whole; i += lanes, number = hn::Add(number, hn::Set(d, lanes))) {
    hn::Vec<Doubles> x, y, z;
    hn::LoadInterleaved3(of_doubles, &vertices[i].x, x, y, z);
    using impinge::HWY_NAMESPACE::mix;
    sum = hn::Add(sum, mix(mix(mix(number, bits(x)), bits(y)), bits(z)));
  }
  std::uint64_t result = impinge::HWY_NAMESPACE::sum_of_lanes(sum);
  for (std::size_t i = whole; i < vertices.size(); ++i) {
    const Vec3& v = vertices[i];
    using impinge::mix;
    result += mix(mix(mix(i, number_bits(v.x)), number_bits(v.y)), number_bits(v.z));
  }
  return result;
}

// No fused operations here: squares are those of single points.
double greatest_square(std::span<const Vec3> points, const Vec3& middle, double scale, const Vec3& center) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<double, 8> d;
  const std::size_t lanes = hn::Lanes(d), whole = points.size() / lanes * lanes;
  const auto square = [&](auto x, double from, double to) HWY_ATTR {
    const auto moved = hn::Sub(hn::Mul(hn::Set(d, scale), hn::Sub(x, hn::Set(d, from))), hn::Set(d, to));
    return hn::Mul(moved, moved);
  };
  auto most = hn::Zero(d);
  for (std::size_t i = 0; i < whole; i += lanes) {
    hn::Vec<decltype(d)> x, y, z;
    hn::LoadInterleaved3(d, &points[i].x, x, y, z);
    const auto xx = square(x, middle.x, center.x), yy = square(y, middle.y, center.y),
               zz = square(z, middle.z, center.z);
    most = hn::Max(most, hn::Add(hn::Add(xx, yy), zz));
  }
  double greatest = hn::GetLane(hn::MaxOfLanes(d, most));
  for (const Vec3& p : points.subspan(whole)) {
    const Vec3 moved = scale * (p - middle) - center;
    greatest = std::max(greatest, dot(moved, moved));
  }
  return greatest;
}

}  // namespace impinge::scene::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::scene {

HWY_EXPORT(measure);
HWY_EXPORT(vertex_hash);
HWY_EXPORT(greatest_square);

VertexNumbers vertex_numbers(std::span<const Vec3> vertices) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  VertexNumbers numbers;
  if (vertices.empty()) return numbers;
  constexpr std::size_t kRun = VertexNumbers::kRun;
  const std::size_t runs = vertices.size() / kRun, rest = vertices.size() % kRun;
  numbers.boxes.resize(runs + (rest > 0 ? 1 : 0));
  HWY_DYNAMIC_DISPATCH(measure)(&vertices[0].x, numbers, numbers.boxes.data(), runs);
  if (rest > 0) {
    Vec3 last[kRun];
    std::fill(std::copy(vertices.end() - static_cast<std::ptrdiff_t>(rest), vertices.end(), last), last + kRun,
              vertices.back());
    HWY_DYNAMIC_DISPATCH(measure)(&last[0].x, numbers, &numbers.boxes.back(), 1);
  }
  return numbers;
}

Box VertexNumbers::box() const {
  Box all = boxes[0];
  for (const Box& each : boxes) all = {min(all.lo, each.lo), max(all.hi, each.hi)};
  return {all.lo + Vec3{}, all.hi + Vec3{}};  // +0 for -0, whichever of them was met
}

double greatest_square(std::span<const Vec3> points, const Vec3& middle, double scale, const Vec3& center) {
  return HWY_DYNAMIC_DISPATCH(greatest_square)(points, middle, scale, center);
}

std::uint64_t vertex_hash(std::span<const Vec3> vertices) { return HWY_DYNAMIC_DISPATCH(vertex_hash)(vertices); }

}  // namespace impinge::scene
#endif  // HWY_ONCE
