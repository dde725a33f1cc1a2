// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/slab.hpp"

#include <cmath>

namespace impinge::clash {
namespace {

Vec3 unit(const Vec3& v) { return (1 / norm(v)) * v; }

HalfSpace beyond(const Vec3& point, const Vec3& outward, double margin) {
  return {outward, dot(outward, point) + margin};
}

/// The slab of a segment: a box.
Slab around(const Vec3& from, const Vec3& to, double side, double height) {
  const double length = norm(to - from);
  const Vec3 along = length > 0 ? unit(to - from) : Vec3{1, 0, 0};
  const Vec3 size = abs(along);
  const Vec3 least = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                     : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                          : Vec3{0, 0, 1};
  const Vec3 across = unit(cross(along, least)), up = cross(along, across);
  Slab slab;
  slab.sides = {beyond(to, along, side), beyond(from, -1.0 * along, side), beyond(from, across, side),
                beyond(from, -1.0 * across, side)};
  slab.size = 4;
  slab.top = beyond(from, up, height), slab.bottom = beyond(from, -1.0 * up, height);
  return slab;
}

}  // namespace

// Let W be the scale, L the longest edge, u = 2^-53 and t the tolerance, t >= 2^-36 W. Local coordinates are off by u W
// each. Sides stand off by e = 2^-10 t >= 2^-46 W, and where a corner is sharper than 29 degrees one more side cuts it
// off, so that no point between the sides is more than 4 e from the triangle as seen along the normal. The computed
// normal is off by an angle of at most 2^-50 / s, s being the sine of the two shorter edges' angle: over the triangle
// that lifts a point by no more than E = 2^-50 (L + W) / s. Top and bottom stand off by h = t (1 - 2^-16) - E.
//   - The slab holds every point within e / 2 of the triangle, for h - E > e / 2 and cuts are off by 2^-48 W at most.
//   - Its points are within sqrt((4 e)² + (h + E)²) of it, less than h + E + 2^-17 t, which leaves 2^-17 t for
//   roundings.
// Where E > t / 4 its plane is not known well enough. If its width is below e / 2, it is within that of its longest
// edge, and a box of sides 2 e about that holds it as well.
std::optional<Slab> make_slab(const Triangle& triangle, double tolerance, double scale) {
  std::size_t apex = 0;  // opposite of the longest edge
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = norm(triangle[(i + 2) % 3] - triangle[(i + 1) % 3]);
    if (length > longest) longest = length, apex = i;
  }
  const double margin = 0x1p-10 * tolerance, height = tolerance * (1 - 0x1p-16);
  const Vec3 &from = triangle[(apex + 1) % 3], &to = triangle[(apex + 2) % 3];
  const Vec3 first = from - triangle[apex], second = to - triangle[apex];
  const Vec3 normal = cross(first, second);
  const double product = norm(first) * norm(second), sine = product > 0 ? norm(normal) / product : 0;
  const double lift = 0x1p-50 * (longest + scale) / sine;
  std::optional<Slab> slab;
  if (lift <= tolerance / 4) {
    const Vec3 up = unit(normal);
    slab.emplace();
    slab->top = beyond(triangle[apex], up, height - lift);
    slab->bottom = beyond(triangle[apex], -1.0 * up, height - lift);
    std::array<Vec3, 3> along;
    for (std::size_t i = 0; i < 3; ++i) along[i] = unit(triangle[(i + 1) % 3] - triangle[i]);
    for (std::size_t i = 0; i < 3; ++i) slab->sides[slab->size++] = beyond(triangle[i], cross(along[i], up), margin);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 in = along[(i + 2) % 3], out = along[i];
      if (dot(in, out) < -0.87) slab->sides[slab->size++] = beyond(triangle[i], unit(in - out), margin);
    }
    slab->has_plane = true;
  } else if (longest * sine < margin / 2) {
    slab = around(from, to, 2 * margin, height);
  } else {
    return std::nullopt;
  }
  const Vec3 reach{2 * tolerance, 2 * tolerance, 2 * tolerance};
  slab->box = box_of(triangle);
  slab->box = {slab->box.lo - reach, slab->box.hi + reach};
  return slab;
}

// A cube of half size t / 4: what triangles in vertex contact share is within t / 8 of its middle, and they have a
// corner within t / 4 of that, no farther from any point of the cube than t (1 + sqrt(3)) / 4.
Slab make_corner_slab(const Vec3& corner, double tolerance) {
  const double half = tolerance / 4;
  Slab slab;
  slab.sides = {beyond(corner, {1, 0, 0}, half), beyond(corner, {-1, 0, 0}, half), beyond(corner, {0, 1, 0}, half),
                beyond(corner, {0, -1, 0}, half)};
  slab.size = 4;
  slab.top = beyond(corner, {0, 0, 1}, half), slab.bottom = beyond(corner, {0, 0, -1}, half);
  const Vec3 reach{2 * half, 2 * half, 2 * half};
  slab.box = {corner - reach, corner + reach};
  return slab;
}

Polygon between(Polygon piece, const Slab& slab) {
  for (std::size_t i = 0; i < slab.size && piece.size() > 0; ++i) piece = cut(piece, slab.sides[i]).within;
  return piece;
}

}  // namespace impinge::clash
