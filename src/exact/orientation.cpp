// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/orientation.hpp"

#include "exact/expansion.hpp"

namespace impinge::exact {
namespace {

// With eps = 2^-53 the filters' rounding errors are at most (3 + 16 eps) eps and (7 + 56 eps) eps times the permanent
// as computed (Shewchuk 1997, section 4). 4 eps and 8 eps leave room for the rounding of the bound itself. Nothing
// underflows on the way: in the domain differences are multiples of 2^-358, so products of three are multiples of
// 2^-1074, the smallest denormal, and what is below 2^-1022 is computed without error.
constexpr double kOrient2dBound = 0x1p-51;
constexpr double kOrient3dBound = 0x1p-50;

struct Difference {
  std::array<Two, 3> v;  ///< exact
  explicit Difference(const Vec3& from, const Vec3& to)
      : v{two_difference(to.x, from.x), two_difference(to.y, from.y), two_difference(to.z, from.z)} {}
  [[nodiscard]] bool is_exact() const { return v[0].low == 0 && v[1].low == 0 && v[2].low == 0; }
};

// The usual case of real data: the differences are doubles, and the expansions stay short.
int determinant_of_doubles(const Difference& a, const Difference& b, const Difference& c) {
  const auto minor = [&](int i, int j) {
    return (expansion(two_product(a.v[i].high, b.v[j].high)) - expansion(two_product(a.v[j].high, b.v[i].high)));
  };
  return (minor(1, 2) * c.v[0].high + minor(2, 0) * c.v[1].high + minor(0, 1) * c.v[2].high).sign();
}

int determinant_of_expansions(const Difference& a, const Difference& b, const Difference& c) {
  const auto minor = [&](int i, int j) {
    return expansion(a.v[i]) * expansion(b.v[j]) - expansion(a.v[j]) * expansion(b.v[i]);
  };
  return (minor(1, 2) * expansion(c.v[0]) + minor(2, 0) * expansion(c.v[1]) + minor(0, 1) * expansion(c.v[2])).sign();
}

}  // namespace

int orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const double left = (ax - cx) * (by - cy);
  const double right = (ay - cy) * (bx - cx);
  const double determinant = left - right;
  const double permanent = std::abs(left) + std::abs(right);
  const double bound = kOrient2dBound * permanent;
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  if (permanent == 0) return 0;  // a difference is zero only if it is so exactly, and products do not underflow
  const Expansion<8> exact_left = expansion(two_difference(ax, cx)) * expansion(two_difference(by, cy));
  const Expansion<8> exact_right = expansion(two_difference(ay, cy)) * expansion(two_difference(bx, cx));
  return (exact_left - exact_right).sign();
}

int determinant_sign(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1, const Vec3& c0, const Vec3& c1) {
  const Vec3 a = a1 - a0, b = b1 - b0, c = c1 - c0;
  const double yz = a.y * b.z, zy = a.z * b.y, zx = a.z * b.x, xz = a.x * b.z, xy = a.x * b.y, yx = a.y * b.x;
  const double determinant = c.x * (yz - zy) + c.y * (zx - xz) + c.z * (xy - yx);
  const double permanent = std::abs(c.x) * (std::abs(yz) + std::abs(zy)) +
                           std::abs(c.y) * (std::abs(zx) + std::abs(xz)) +
                           std::abs(c.z) * (std::abs(xy) + std::abs(yx));
  const double bound = kOrient3dBound * permanent;
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  if (permanent == 0) return 0;  // axis-aligned coplanar data end here

  const Difference da(a0, a1), db(b0, b1), dc(c0, c1);
  if (da.is_exact() && db.is_exact() && dc.is_exact()) return determinant_of_doubles(da, db, dc);
  return determinant_of_expansions(da, db, dc);
}

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return determinant_sign(a, b, a, c, a, d); }

}  // namespace impinge::exact
