// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Two triangles from bytes; impinge's predicates, and its answers on two meshes of a triangle each, must agree with
/// rational numbers, in either order.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "impinge/impinge.hpp"
#include "tests/oracle/points.hpp"

namespace {

using impinge::Point;
using impinge::Triangle;

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  /// Zeros once the bytes have run out.
  template <class T>
  T take() {
    T value{};
    const std::size_t count = sizeof(T) < size_ - at_ ? sizeof(T) : size_ - at_;
    if (count != 0) {
      std::memcpy(&value, data_ + at_, count);
    }
    at_ += count;
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

/// Any double of the domain: below 2^300 and a multiple of 2^-358. Other bit patterns are folded into it.
double in_domain(double x) {
  if (!std::isfinite(x)) {
    return 0;
  }
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const double folded = std::ldexp(fraction, (exponent % 300 + 300) % 300 - (exponent < 0 ? 300 : 0));
  // Multiples of 2^-358: whole after scaling by it, which is exact (2^-300 * 2^358 and up are normal).
  return std::ldexp(std::trunc(std::ldexp(folded, 358)), -358);
}

double small_integer(Bytes& bytes) { return static_cast<double>(bytes.take<std::int8_t>() % 4); }

double moved_by_ulps(double x, int steps) {
  for (; steps != 0 && x != 0; steps -= steps > 0 ? 1 : -1) {  // the neighbours of zero lie outside the domain
    x = std::nextafter(x, steps > 0 ? HUGE_VAL : -HUGE_VAL);
  }
  return x;
}

/// A corner of a lattice that is tilted and rounded, some ulps off.
Point near_lattice(Bytes& bytes) {
  const int i = bytes.take<std::int8_t>() % 4;
  const int j = bytes.take<std::int8_t>() % 4;
  const int k = bytes.take<std::int8_t>() % 2;
  const double x = 0.1 + 0.7 * i + 0.3 * j - 0.2 * k;
  const double y = 12.3 - 0.2 * i + 0.9 * j + 0.4 * k;
  const double z = -7.7 + 0.6 * i + 0.1 * j + 0.8 * k;
  const int dx = bytes.take<std::int8_t>() % 4;
  const int dy = bytes.take<std::int8_t>() % 4;
  return {moved_by_ulps(x, dx), moved_by_ulps(y, dy), moved_by_ulps(z, bytes.take<std::int8_t>() % 4)};
}

Point corner(Bytes& bytes, unsigned mode) {
  if (mode == 0) {
    const double x = in_domain(bytes.take<double>());
    const double y = in_domain(bytes.take<double>());
    return {x, y, in_domain(bytes.take<double>())};
  }
  if (mode == 1) {
    const double x = small_integer(bytes);
    const double y = small_integer(bytes);
    return {x, y, small_integer(bytes)};
  }
  return near_lattice(bytes);
}

void demand(bool holds, const char* what, const Triangle& a, const Triangle& b) {
  if (holds) {
    return;
  }
  std::fprintf(stderr, "%s differs from rational numbers on\n", what);
  for (const Triangle* const t : {&a, &b}) {
    for (const Point& p : *t) {
      std::fprintf(stderr, "  %a %a %a\n", p.x, p.y, p.z);
    }
  }
  std::abort();
}

impinge::Mesh mesh_of(const Triangle& t) {
  const std::array<double, 9> xyz{t[0].x, t[0].y, t[0].z, t[1].x, t[1].y, t[1].z, t[2].x, t[2].y, t[2].z};
  const std::array<std::uint32_t, 3> index{0, 1, 2};
  return impinge::Mesh::create(std::span<const double>(xyz), index).value();
}

std::optional<impinge::Kind> found(const impinge::Mesh& a, const impinge::Mesh& b, const char* backend) {
  const auto contacts = impinge::collide(a, {}, b, {}, {.threads = 1, .backend = backend}).value();
  return contacts.kinds.empty() ? std::nullopt : std::optional(contacts.kinds[0]);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const unsigned mode = bytes.take<std::uint8_t>() % 3;
  Triangle a{}, b{};
  for (Point& p : a) {
    p = corner(bytes, mode);
  }
  for (Point& p : b) {
    p = corner(bytes, mode);
  }
  const unsigned shared = bytes.take<std::uint8_t>() % 8;  // common corners
  for (unsigned i = 0; i < 3; ++i) {
    if ((shared >> i & 1) != 0) {
      b[i] = a[(i + 1) % 3];
    }
  }
  const auto exact_a = impinge::points::exact_corners(a);
  const auto exact_b = impinge::points::exact_corners(b);
  const auto meeting = oracle::meeting(exact_a, exact_b);
  const auto expected = meeting ? std::optional(static_cast<impinge::Kind>(*meeting)) : std::nullopt;
  demand(impinge::intersects(a, b) == expected, "intersects(a, b)", a, b);
  demand(impinge::intersects(b, a) == expected, "intersects(b, a)", a, b);
  demand(impinge::share_area(a, b) == oracle::common_area(exact_a, exact_b), "share_area(a, b)", a, b);
  const impinge::Mesh mesh_a = mesh_of(a), mesh_b = mesh_of(b);
  for (const char* backend : {"simd", "paper"}) {
    demand(found(mesh_a, mesh_b, backend) == expected, backend, a, b);
    demand(found(mesh_b, mesh_a, backend) == expected, backend, b, a);
  }
  const impinge::Segment edge{a[0], a[1]};
  const bool edge_meets = oracle::meeting(impinge::points::exact_corners(edge), exact_b).has_value();
  demand(impinge::intersects(edge, b) == edge_meets, "intersects(edge of a, b)", a, b);
  return 0;
}
