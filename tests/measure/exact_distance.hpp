// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>

#include "impinge/mesh.hpp"
#include "tests/oracle/rational.hpp"

/// Squares of distances in rational numbers, by trying every feature that the nearest points may be on.
namespace oracle {

inline Vec vec(const impinge::Point& p) { return vec(p.x, p.y, p.z); }
inline Vec at(const Vec& p, const mpq_class& s, const Vec& d) {
  return {mpq_class(p[0] + s * d[0]), mpq_class(p[1] + s * d[1]), mpq_class(p[2] + s * d[2])};
}
inline mpq_class square(const Vec& p, const Vec& q) {
  const Vec r = q - p;
  return dot(r, r);
}

class Least {
 public:
  void offer(const mpq_class& value) {
    if (!value_ || value < *value_) value_ = value;
  }
  [[nodiscard]] const mpq_class& value() const { return *value_; }

 private:
  std::optional<mpq_class> value_;
};

inline void offer_point_and_segment(const Vec& p, const Vec& from, const Vec& to, Least& least) {
  least.offer(square(p, from));
  const Vec d = to - from;
  if (is_zero(d)) return;
  const mpq_class s = dot(p - from, d) / dot(d, d);
  if (s > 0 && s < 1) least.offer(square(p, at(from, s, d)));
}

inline void offer_lines(const Vec& p, const Vec& p_to, const Vec& q, const Vec& q_to, Least& least) {
  const Vec d = p_to - p, e = q_to - q, n = cross(d, e), r = q - p;
  if (is_zero(n)) return;  // parallel: an end is among the nearest
  const mpq_class nn = dot(n, n), s = dot(cross(r, e), n) / nn, t = dot(cross(r, d), n) / nn;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) least.offer(square(at(p, s, d), at(q, t, e)));
}

inline void offer_point_and_face(const Vec& p, const Corners& face, Least& least) {
  const Vec n = cross(face[1] - face[0], face[2] - face[0]);
  if (is_zero(n)) return;
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(cross(n, face[(i + 1) % 3] - face[i]), p - face[i]) < 0) return;
  const mpq_class height = dot(n, p - face[0]);
  least.offer(height * height / dot(n, n));
}

/// Whether a plane across an axis parts the corners: then nothing meets.
inline bool are_parted(const Corners& a, const Corners& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto of = [&](const Corners& corners) { return std::minmax({corners[0][k], corners[1][k], corners[2][k]}); };
    if (of(a).second < of(b).first || of(b).second < of(a).first) return true;
  }
  return false;
}

/// 0 if and only if the closed triangles share a point.
inline mpq_class square_distance(const impinge::Triangle& t, const impinge::Triangle& u) {
  const Corners a{vec(t[0]), vec(t[1]), vec(t[2])}, b{vec(u[0]), vec(u[1]), vec(u[2])};
  if (!are_parted(a, b) && meeting(simplified(a), simplified(b))) return 0;
  Least least;
  for (std::size_t i = 0; i < 3; ++i) {
    offer_point_and_face(a[i], b, least);
    offer_point_and_face(b[i], a, least);
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec &a_to = a[(i + 1) % 3], &b_to = b[(j + 1) % 3];
      offer_point_and_segment(a[i], b[j], b_to, least);
      offer_point_and_segment(b[j], a[i], a_to, least);
      offer_lines(a[i], a_to, b[j], b_to, least);
    }
  }
  return least.value();
}

/// Whether a distance whose square is given is within `error` of `distance`.
inline bool is_within(const mpq_class& square, double distance, double error) {
  const mpq_class low = mpq_class(distance) - mpq_class(error), high = mpq_class(distance) + mpq_class(error);
  return square <= high * high && (low <= 0 || square >= low * low);
}

}  // namespace oracle
