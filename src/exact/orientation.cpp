// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/orientation.hpp"

namespace impinge::exact {
namespace {

// With eps = 2^-53 the filters' rounding errors are at most (3 + 16 eps) eps and (7 + 56 eps) eps times the permanent
// as computed (Shewchuk 1997, section 4). 4 eps and 8 eps leave room for the rounding of the bound itself. Nothing
// underflows on the way: in the domain differences are multiples of 2^-358, so products of three are multiples of
// 2^-1074, the smallest denormal, and what is below 2^-1022 is computed without error.
constexpr double kOrient2dBound = 0x1p-51;
constexpr double kOrient3dBound = 0x1p-50;

// The second filter, for differences that are doubles exactly: products and sums in twice the precision, as rounded
// pairs. It settles the noise that a rotation leaves on flush faces. With M the magnitude of a component of the normal
// and P the permanent, that component is off by at most 4 eps^2 M, its product with w by 12 eps^2 |w| M, and each of
// the seven additions of lower halves by 8 eps^2 P: 68 eps^2 P in all. It loses nothing to underflow, as above.
constexpr double kTwofoldBound = 0x1p-98;  // 256 eps^2

bool is_double(const Vec3& from, const Vec3& to) {
  return two_difference(to.x, from.x).low == 0 && two_difference(to.y, from.y).low == 0 &&
         two_difference(to.z, from.z).low == 0;
}

Two product_difference(double a, double b, double c, double d) {
  const Two ab = two_product(a, b), cd = two_product(c, d);
  const Two high = two_difference(ab.high, cd.high);
  return {high.high, high.low + (ab.low - cd.low)};
}

std::array<Two, 3> twofold_cross(const Vec3& u, const Vec3& v) {
  return {product_difference(u.y, v.z, u.z, v.y), product_difference(u.z, v.x, u.x, v.z),
          product_difference(u.x, v.y, u.y, v.x)};
}

double twofold_dot(const Vec3& w, const std::array<Two, 3>& n) {
  const Two x = two_product(w.x, n[0].high), y = two_product(w.y, n[1].high), z = two_product(w.z, n[2].high);
  const Two xy = two_sum(x.high, y.high), xyz = two_sum(xy.high, z.high);
  const double low = ((x.low + w.x * n[0].low) + (y.low + w.y * n[1].low)) + (z.low + w.z * n[2].low);
  return xyz.high + ((xy.low + xyz.low) + low);
}

using ExactVector = std::array<Expansion<2>, 3>;

ExactVector difference(const Vec3& from, const Vec3& to) {
  return {expansion(two_difference(to.x, from.x)), expansion(two_difference(to.y, from.y)),
          expansion(two_difference(to.z, from.z))};
}

std::array<Expansion<16>, 3> cross(const ExactVector& u, const ExactVector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
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

Plane::Plane(const Vec3& a, const Vec3& b, const Vec3& c) : a_(a), b_(b), c_(c) {
  const Vec3 u = b - a, v = c - a;
  const double yz = u.y * v.z, zy = u.z * v.y, zx = u.z * v.x, xz = u.x * v.z, xy = u.x * v.y, yx = u.y * v.x;
  normal_ = {yz - zy, zx - xz, xy - yx};
  magnitude_ = {std::abs(yz) + std::abs(zy), std::abs(zx) + std::abs(xz), std::abs(xy) + std::abs(yx)};
}

int Plane::sign_along(const Vec3& from, const Vec3& to) {
  const Vec3 w = to - from;
  const double determinant = dot(w, normal_);
  const double permanent = dot(abs(w), magnitude_);
  const double bound = kOrient3dBound * permanent;
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  if (permanent == 0) return 0;  // axis-aligned coplanar data end here

  if (!twofold_) twofold_ = {is_double(a_, b_) && is_double(a_, c_), twofold_cross(b_ - a_, c_ - a_)};
  if (twofold_->edges_are_doubles && is_double(from, to)) {
    const double twofold = twofold_dot(w, twofold_->normal);
    const double twofold_bound = kTwofoldBound * permanent;
    if (twofold > twofold_bound) return 1;
    if (twofold < -twofold_bound) return -1;
  }

  if (!exact_normal_) exact_normal_ = cross(difference(a_, b_), difference(a_, c_));
  const ExactVector step = difference(from, to);
  const auto& n = *exact_normal_;
  return (n[0] * step[0] + n[1] * step[1] + n[2] * step[2]).sign();
}

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return Plane(a, b, c).side(d); }

}  // namespace impinge::exact
