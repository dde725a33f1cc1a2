// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/rounded_roots.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "exact/expansion.hpp"

// Numbers are unevaluated sums of two doubles (Dekker 1971; Joldes, Muller and Popescu, "Tight and rigorous error
// bounds for basic building blocks of double-word arithmetic", 2017). With e = 2^-103 a product is off by e of itself,
// and a sum by e of the two numbers' absolute values.
//
// Let D_k be the largest |component k| of the six differences, which are exact, and V = D_x D_y D_z. A component of a
// cross product is below 2 D_i D_j and off by 4 e D_i D_j: two products and a sum. A determinant is below 6 V and off
// by 28 e V: three products of 2 V, each off by 2 e V and by 4 e V more for its factor, and two sums. A coefficient, a
// sum of up to three of them, is below 18 V and off by 3 * 28 + 30 = 114 e V, less than 2^-96 V. The value at a time
// takes 222 e V more: less than 2^-94 V in all. Underflow takes less than 2^-1070 times one of the D, which is nothing
// where these are from 2^-250 to 2^320.
namespace impinge::motion {

namespace {

using exact::Two;

Two operator+(const Two& a, const Two& b) {
  const Two sum = exact::two_sum(a.high, b.high);
  return exact::two_sum(sum.high, sum.low + (a.low + b.low));
}
Two operator-(const Two& a, const Two& b) { return a + Two{-b.high, -b.low}; }
Two operator*(const Two& a, const Two& b) {
  const Two product = exact::two_product(a.high, b.high);
  return exact::fast_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

using TwoVector = std::array<Two, 3>;
TwoVector cross(const TwoVector& a, const TwoVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Two dot(const TwoVector& a, const TwoVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// c0 s^3 + c1 s^2 t + c2 s t^2 + c3 t^3 with s = 1 - t.
class Volume {
 public:
  Volume(const FourPoints& from, const FourPoints& to, const Spanning& spanning) {
    std::array<std::array<TwoVector, 2>, 3> d;  // by difference and end
    std::array<double, 3> largest{0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t end = 0; end < 2; ++end) {
        const FourPoints& points = end == 0 ? from : to;
        for (int axis = 0; axis < 3; ++axis) {
          const Two x =
              exact::two_difference(component(points[spanning[i][1]], axis), component(points[spanning[i][0]], axis));
          d[i][end][static_cast<std::size_t>(axis)] = x;
          largest[static_cast<std::size_t>(axis)] = std::max(largest[static_cast<std::size_t>(axis)], std::abs(x.high));
        }
      }
    valid_ = std::ranges::all_of(largest, [](double x) { return x >= 0x1p-250 && x <= 0x1p320; });
    if (!valid_) return;
    size_ = largest[0] * largest[1] * largest[2];
    for (std::size_t u = 0; u < 2; ++u)
      for (std::size_t v = 0; v < 2; ++v) {
        const TwoVector normal = cross(d[0][u], d[1][v]);
        for (std::size_t w = 0; w < 2; ++w) c_[u + v + w] = c_[u + v + w] + dot(normal, d[2][w]);
      }
    for (std::size_t i = 0; i < 4; ++i) valid_ = valid_ && sign_of(c_[i], 0x1p-96) != 0;
  }

  /// All coefficients have signs that are certain.
  [[nodiscard]] bool is_valid() const { return valid_; }
  [[nodiscard]] int variations() const {
    int changes = 0;
    for (std::size_t i = 1; i < 4; ++i) changes += int{(c_[i].high > 0) != (c_[i - 1].high > 0)};
    return changes;
  }
  [[nodiscard]] int first_sign() const { return c_[0].high > 0 ? 1 : -1; }
  [[nodiscard]] int last_sign() const { return c_[3].high > 0 ? 1 : -1; }

  [[nodiscard]] Two at(double t) const {
    const Two s = exact::two_difference(1, t), s2 = s * s, time{t, 0};
    return ((c_[3] * time + c_[2] * s) * time + c_[1] * s2) * time + c_[0] * (s2 * s);
  }
  /// 0 if that is open.
  [[nodiscard]] int sign_of(const Two& value, double error = 0x1p-94) const {
    return int{value.high > error * size_} - int{value.high < -error * size_};
  }
  [[nodiscard]] double rounded(double t) const {
    const double s = 1 - t;
    return ((c_[3].high * t + c_[2].high * s) * t + c_[1].high * (s * s)) * t + c_[0].high * (s * s * s);
  }
  [[nodiscard]] double slope(double t) const {
    const auto q = differences();
    const double s = 1 - t;
    return 3 * ((q[0] * s + 2 * q[1] * t) * s + q[2] * t * t);
  }
  /// About where the slope is zero, in their order: two times, or none.
  [[nodiscard]] std::array<double, 2> extremes() const {
    const auto q = differences();
    const double a = q[0] - 2 * q[1] + q[2], b = q[0] - q[1], root = std::sqrt(b * b - a * q[0]);
    const double larger = b + std::copysign(root, b);
    const double one = q[0] / larger, two = larger / a;
    return {std::min(one, two), std::max(one, two)};
  }

 private:
  /// Of the coefficients in Bernstein form.
  [[nodiscard]] std::array<double, 3> differences() const {
    return {c_[1].high / 3 - c_[0].high, (c_[2].high - c_[1].high) / 3, c_[3].high - c_[2].high / 3};
  }

  std::array<Two, 4> c_{};
  double size_ = 0;
  bool valid_;
};

double neighbour(double t, bool above) {
  return std::bit_cast<double>(std::bit_cast<std::int64_t>(t) + (above ? 1 : -1));
}

/// The root between two times, at which the volume has the sign `sign` and the other one.
std::optional<Interval> root_between(const Volume& volume, double start, double end, int sign) {
  // Newton's method, kept within bounds. How near it comes costs time alone.
  double t = (start + end) / 2, lo = start, hi = end;
  for (int i = 0; i < 30; ++i) {
    const double value = volume.rounded(t);
    ((value > 0) == (sign > 0) ? lo : hi) = t;
    double next = t - value / volume.slope(t);
    if (!(next > lo && next < hi)) next = (lo + hi) / 2;
    const bool settled = std::abs(next - t) <= 0x1p-50 * t;
    t = next;
    if (settled) break;
  }
  // From there on with signs that are certain.
  for (int i = 0; i < 8 && t > start && t < end; ++i) {
    const Two value = volume.at(t);
    const int here = volume.sign_of(value);
    if (here == 0) return std::nullopt;
    const double other = neighbour(t, here == sign);
    const double next = t - value.high / volume.slope(t);
    const bool is_near = !(std::abs(next - t) > 4 * std::abs(other - t));
    if (is_near) {
      const int there = volume.sign_of(volume.at(other));
      if (there == 0) return std::nullopt;
      if (there != here) return Interval{std::min(t, other), std::max(t, other)};
    }
    t = is_near ? other : next;
  }
  return std::nullopt;
}

}  // namespace

std::optional<RootTimes> rounded_roots(const FourPoints& from, const FourPoints& to, const Spanning& spanning) {
  const Volume volume(from, to, spanning);
  if (!volume.is_valid()) return std::nullopt;
  // Signs that alternate as often as the coefficients' do have a root between each two, and by Descartes' rule there is
  // no other.
  const int variations = volume.variations();
  std::array<double, 4> times{0, 1};
  std::size_t count = variations > 0 ? 1 : 0;
  if (variations > 1) {
    int sign = volume.first_sign();
    for (const double t : volume.extremes()) {
      if (!(t > 0 && t < 1) || volume.sign_of(volume.at(t)) != -sign) continue;
      times[count++] = t;
      sign = -sign;
    }
    if (count != static_cast<std::size_t>(variations)) return std::nullopt;
    times[count] = 1;
  }
  RootTimes roots;
  int sign = volume.first_sign();
  for (std::size_t i = 0; i < count; ++i, sign = -sign) {
    const auto time = root_between(volume, times[i], times[i + 1], sign);
    if (!time) return std::nullopt;
    roots.times[roots.count++] = *time;
  }
  return roots;
}

}  // namespace impinge::motion
