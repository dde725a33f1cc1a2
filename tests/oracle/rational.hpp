// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

/// What meets what, in rational numbers and by one argument, so that there is no case to get wrong.
///
/// A triangle, segment or point A is a convex polygon given by its corners. B is one given by closed half-spaces.
/// Cutting A by them one after the other leaves the corners of A and B in common: they meet iff a corner is left. The
/// mean c of those corners lies in the relative interior of the common part. If the relative interiors of A and B meet,
/// their intersection is the relative interior of the common part (true of any two convex sets), so they meet iff c
/// lies in both: the kind needs no cases either.
///
/// This shares no code and no method with the library: there are no orientation signs of corners anywhere.
namespace oracle {

using Vec = std::array<mpq_class, 3>;

inline Vec vec(double x, double y, double z) { return {mpq_class(x), mpq_class(y), mpq_class(z)}; }
inline Vec operator-(const Vec& a, const Vec& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
inline mpq_class dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec cross(const Vec& a, const Vec& b) {
  return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
          mpq_class(a[0] * b[1] - a[1] * b[0])};
}
inline bool is_zero(const Vec& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }
inline Vec negated(const Vec& a) { return {mpq_class(-a[0]), mpq_class(-a[1]), mpq_class(-a[2])}; }

/// Corners of a point, a segment or a proper triangle: no three on a line.
using Corners = std::vector<Vec>;

/// The point, segment or triangle that three corners span.
inline Corners simplified(const Corners& corners) {
  if (corners.size() == 3 && !is_zero(cross(corners[1] - corners[0], corners[2] - corners[0]))) return corners;
  // On one line, lexicographic order is the order along it.
  const Vec* low = corners.data();
  const Vec* high = corners.data();
  for (const Vec& corner : corners) {
    low = corner < *low ? &corner : low;
    high = *high < corner ? &corner : high;
  }
  return *low == *high ? Corners{*low} : Corners{*low, *high};
}

/// The points x with normal . x >= offset.
struct HalfSpace {
  Vec normal;
  mpq_class offset;
  [[nodiscard]] mpq_class height(const Vec& x) const { return dot(normal, x) - offset; }
};

/// `flat`: pairs of opposite half-spaces, together the plane, line or point that carries the shape. `sides`: the shape
/// is their intersection with it, its relative interior that of their open forms.
struct HalfSpaces {
  std::vector<HalfSpace> flat, sides;
};

inline HalfSpace half_space(const Vec& normal, const Vec& through) { return {normal, dot(normal, through)}; }

inline HalfSpaces half_spaces(const Corners& shape) {
  HalfSpaces result;
  const auto keep_on = [&](const Vec& normal) {
    result.flat.push_back(half_space(normal, shape[0]));
    result.flat.push_back(half_space(negated(normal), shape[0]));
  };
  if (shape.size() == 3) {
    const Vec normal = cross(shape[1] - shape[0], shape[2] - shape[0]);
    keep_on(normal);
    for (std::size_t i = 0; i < 3; ++i)
      result.sides.push_back(half_space(cross(normal, shape[(i + 1) % 3] - shape[i]), shape[i]));
    return result;
  }
  const std::array<Vec, 3> axes{vec(1, 0, 0), vec(0, 1, 0), vec(0, 0, 1)};
  if (shape.size() == 2) {
    const Vec along = shape[1] - shape[0];
    for (const Vec& axis : axes) keep_on(cross(along, axis));  // the three span the plane across the segment
    result.sides = {half_space(along, shape[0]), half_space(negated(along), shape[1])};
  } else {
    for (const Vec& axis : axes) keep_on(axis);
  }
  return result;
}

/// Sutherland and Hodgman's cut of a convex polygon, which may have shrunk to a segment or a point.
inline Corners cut(const Corners& polygon, const HalfSpace& by) {
  Corners result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec& from = polygon[i];
    const Vec& to = polygon[(i + 1) % polygon.size()];
    const mpq_class at_from = by.height(from);
    const mpq_class at_to = by.height(to);
    if (at_from >= 0) result.push_back(from);
    if (sgn(at_from) * sgn(at_to) < 0) {
      const mpq_class s = at_from / (at_from - at_to);
      const Vec step = to - from;
      result.push_back(
          {mpq_class(from[0] + s * step[0]), mpq_class(from[1] + s * step[1]), mpq_class(from[2] + s * step[2])});
    }
  }
  return result;
}

/// Corners of what two shapes have in common, some perhaps twice.
inline Corners common_part(const Corners& a, const HalfSpaces& b) {
  Corners rest = a;
  for (const std::vector<HalfSpace>* const group : {&b.flat, &b.sides})
    for (const HalfSpace& by : *group) {
      rest = cut(rest, by);
      if (rest.empty()) return rest;
    }
  return rest;
}

inline bool in_open_sides(const Vec& x, const HalfSpaces& shape) {
  for (const HalfSpace& side : shape.sides)
    if (side.height(x) <= 0) return false;
  return true;
}

/// The numbers of the files and of impinge::Kind.
enum class Meeting : unsigned char { crossing = 0, touching = 1, coplanar = 2 };

inline bool in_one_plane(const Corners& a, const HalfSpaces& b) {
  for (const Vec& corner : a)
    if (b.flat[0].height(corner) != 0) return false;
  return true;
}

/// How two shapes (as `simplified` gives them) meet; nothing if they share no point.
inline std::optional<Meeting> meeting(const Corners& a, const Corners& b) {
  const HalfSpaces b_spaces = half_spaces(b);
  const Corners common = common_part(a, b_spaces);
  if (common.empty()) return std::nullopt;
  if (a.size() != 3 || b.size() != 3) return Meeting::touching;
  if (in_one_plane(a, b_spaces)) return Meeting::coplanar;
  Vec mean = vec(0, 0, 0);
  for (const Vec& corner : common)
    for (std::size_t k = 0; k < 3; ++k) mean[k] += corner[k];
  for (mpq_class& x : mean) x /= static_cast<unsigned long>(common.size());
  const bool in_both = in_open_sides(mean, b_spaces) && in_open_sides(mean, half_spaces(a));
  return in_both ? Meeting::crossing : Meeting::touching;
}

/// Whether two proper triangles in one plane have more than a segment in common.
inline bool common_area(const Corners& a, const Corners& b) {
  if (a.size() != 3 || b.size() != 3) return false;
  const HalfSpaces b_spaces = half_spaces(b);
  if (!in_one_plane(a, b_spaces)) return false;
  const Corners common = common_part(a, b_spaces);
  for (std::size_t i = 2; i < common.size(); ++i)
    for (std::size_t j = 1; j < i; ++j)
      if (!is_zero(cross(common[j] - common[0], common[i] - common[0]))) return true;
  return false;
}

}  // namespace oracle
