// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/root.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/number.hpp"

namespace impinge::motion {

namespace {

/// Halvings of an interval before it is asked whether the roots in it are one.
constexpr int kHalvings = 6;

Dyadic lower_half(const Dyadic& of) { return {of.first << 1, of.level + 1}; }
Dyadic upper_half(const Dyadic& of) { return {(of.first << 1) + 1, of.level + 1}; }
const Dyadic kLower{0, 1}, kUpper{1, 1};

struct Piece {
  Polynomial inside;  ///< over the interval
  Dyadic interval;
};

}  // namespace

Root Root::at(Integer rest, Integer time) {
  Root root;
  root.be(std::move(rest), std::move(time));
  return root;
}

Root::Root(Polynomial of, Dyadic interval) : of_(std::move(of)), interval_(std::move(interval)) {
  if (of_.degree == 1)
    be(abs(of_.coefficients[1]), abs(of_.coefficients[0]));
  else
    inside_ = restricted(of_, interval_);
}

Root Root::only_one(const Polynomial& of, const Interval& between) {
  Root root;
  root.of_ = of;
  root.narrow(between);
  return root;
}

void Root::be(Integer rest, Integer time) {
  rational_ = true;
  rest_ = std::move(rest);
  time_ = std::move(time);
}

void Root::halve() {
  const int middle = inside_.sign(1, 1);
  if (middle == 0) {
    const Dyadic upper = upper_half(interval_);
    return be((Integer(1) << upper.level) - upper.first, upper.first);
  }
  Polynomial lower = restricted(inside_, kLower);
  const bool in_lower = lower.variations() % 2 == 1;
  interval_ = in_lower ? lower_half(interval_) : upper_half(interval_);
  inside_ = in_lower ? std::move(lower) : restricted(inside_, kUpper);
}

int Root::sign(const Polynomial& p) {
  if (p.variations() == 0) {  // then it can only be zero at the ends of time
    const int first = p.first_sign();
    if (first == 0 || !rational_ || (!rest_.is_zero() && !time_.is_zero())) return first;
  }
  for (bool first = true; !rational_; first = false) {
    const Polynomial over = restricted(p, interval_);
    if (over.variations() == 0) return over.first_sign();
    // Every root of the divisor is one of `of_`, which has one inside the interval. Where it is none of p, halves will
    // tell.
    if (first && restricted(common_divisor(of_, p), interval_).variations() % 2 == 1) return 0;
    halve();
  }
  return p.sign(rest_, time_);
}

/// -1 if t is less than the root, 0 if it is the root, else 1.
int Root::side_of(double t) const {
  if (t <= 0) return rational_ && time_.is_zero() ? (t < 0 ? -1 : 0) : -1;
  const int unit = std::min(lowest_bit(t), 0);
  const Integer time = integer(t, unit), whole = Integer(1) << -unit;
  if (rational_) return Integer(time * (rest_ + time_) - whole * time_).sign();
  const Integer place = (time << interval_.level) - (interval_.first << -unit);
  if (place.sign() <= 0) return -1;
  if (place >= whole) return 1;
  const int sign = inside_.sign(whole - place, place);
  return sign == 0 ? 0 : (sign == inside_.first_sign() ? -1 : 1);
}

Interval Root::bounds() const {
  // A first guess, by halves: its error costs time alone.
  const auto guess = [&] {
    if (rational_) {
      const Integer whole = rest_ + time_;
      const int drop = std::max<int>(0, static_cast<int>(msb(whole)) - 1000);
      return static_cast<double>(Integer(time_ >> drop)) / static_cast<double>(Integer(whole >> drop));
    }
    std::array<double, 4> c{};
    int top = 0;
    for (const Integer& x : inside_.coefficients)
      if (!x.is_zero()) top = std::max(top, static_cast<int>(msb(abs(x))));
    const int drop = std::max(0, top - 900);
    for (int i = 0; i <= inside_.degree; ++i) c[i] = static_cast<double>(Integer(inside_.coefficients[i] >> drop));
    const auto value = [&](double t) {
      double sum = c[inside_.degree], power = 1;
      for (int i = inside_.degree; i-- > 0;) {
        power *= 1 - t;
        sum = sum * t + c[i] * power;
      }
      return sum;
    };
    double lo = 0, hi = 1;
    for (int i = 0; i < 60; ++i) {
      const double middle = (lo + hi) / 2;
      ((value(middle) > 0) == (inside_.first_sign() > 0) ? lo : hi) = middle;
    }
    return std::ldexp(static_cast<double>(interval_.first) + lo, -static_cast<int>(interval_.level));
  };
  const double start = std::clamp(guess(), 0.0, 1.0);
  const int side = side_of(start);
  if (side == 0) return {start, start};
  // Steps that double until the root is passed, then halves of what is between: in order of the doubles' bits, in which
  // neighbours are neighbours.
  const auto bits = [](double t) { return std::bit_cast<std::int64_t>(t); };
  std::int64_t lo = bits(start), hi = lo;
  for (std::int64_t step = 1;; step *= 2) {
    std::int64_t& moving = side < 0 ? hi : lo;
    (side < 0 ? lo : hi) = moving;
    moving = std::clamp(moving - side * step, bits(0), bits(1));
    const int now = side_of(std::bit_cast<double>(moving));
    if (now == 0) return {std::bit_cast<double>(moving), std::bit_cast<double>(moving)};
    if (now != side) break;
  }
  while (hi - lo > 1) {
    const std::int64_t middle = lo + (hi - lo) / 2;
    const int now = side_of(std::bit_cast<double>(middle));
    if (now == 0) return {std::bit_cast<double>(middle), std::bit_cast<double>(middle)};
    (now < 0 ? lo : hi) = middle;
  }
  return {std::bit_cast<double>(lo), std::bit_cast<double>(hi)};
}

void Root::narrow(const Interval& bounds) {
  if (rational_) return;
  const double width = bounds.hi - bounds.lo;  // a power of two, of which neighbouring doubles are multiples
  const int unit = width > 0 ? exponent(width) : lowest_bit(bounds.lo);
  const Dyadic between{integer(bounds.lo, unit), static_cast<unsigned>(-unit)};
  if (width == 0) return be((Integer(1) << between.level) - between.first, between.first);
  // Of two such intervals with a point inside both, one holds the other. Between neighbouring doubles there may be
  // another root, which the interval leaves out.
  if (between.level <= interval_.level) return;
  interval_ = between;
  inside_ = restricted(of_, interval_);
}

std::vector<Root> roots(const Polynomial& p) {
  std::vector<Root> found;
  if (p.coefficients[0].is_zero()) found.push_back(Root::at(1, 0));
  if (p.coefficients[p.degree].is_zero()) found.push_back(Root::at(0, 1));
  Polynomial simple = without_ends(p);
  std::vector<Piece> pieces{{simple, {}}};
  while (!pieces.empty()) {
    const Piece piece = std::move(pieces.back());
    pieces.pop_back();
    const int variations = piece.inside.variations();
    if (variations == 0) continue;
    if (variations == 1) {
      found.push_back(Root(simple, piece.interval));
      continue;
    }
    if (piece.interval.level == kHalvings) {  // roots that are this close may be one
      const Polynomial repeated = common_divisor(simple, derivative(simple));
      if (repeated.degree > 0) {
        // The factor that is left has each root once. All roots are then real, so that Descartes counts them exactly,
        // and pieces that wait have at most one.
        simple = quotient(simple, repeated);
        pieces.push_back({restricted(simple, piece.interval), piece.interval});
        continue;
      }
    }
    const Dyadic upper = upper_half(piece.interval);
    if (piece.inside.sign(1, 1) == 0) found.push_back(Root::at((Integer(1) << upper.level) - upper.first, upper.first));
    pieces.push_back({restricted(piece.inside, kLower), lower_half(piece.interval)});
    pieces.push_back({restricted(piece.inside, kUpper), upper});
  }
  return found;
}

}  // namespace impinge::motion
