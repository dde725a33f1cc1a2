// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "flat_overlaps.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>

namespace impinge::test {
namespace {

namespace geometry = boost::geometry;
using Polygon = geometry::model::polygon<geometry::model::d2::point_xy<double>, false, false>;

Polygon outline(const scenes::FlatPart& part, double seconds) {
  const scenes::FlatPose pose = scenes::at(part, seconds);
  const double c = std::cos(pose.angle), s = std::sin(pose.angle);
  Polygon polygon;
  for (const scenes::Flat& p : part.outline)
    geometry::append(polygon.outer(), geometry::model::d2::point_xy<double>(c * p[0] - s * p[1] + pose.place[0],
                                                                            s * p[0] + c * p[1] + pose.place[1]));
  return polygon;
}

bool overlap(const scenes::FlatPart& a, const scenes::FlatPart& b, double seconds) {
  if (a.low >= b.high || b.low >= a.high) return false;
  std::vector<Polygon> common;
  geometry::intersection(outline(a, seconds), outline(b, seconds), common);
  double area = 0;
  for (const Polygon& polygon : common) area += geometry::area(polygon);
  return area > 1e-12;
}

}  // namespace

std::vector<Overlap> overlaps(const std::vector<scenes::FlatPart>& parts, double seconds) {
  constexpr int kSteps = 1500;
  std::vector<Overlap> found;
  for (std::size_t a = 0; a < parts.size(); ++a)
    for (std::size_t b = a + 1; b < parts.size(); ++b) {
      bool was = overlap(parts[a], parts[b], 0);
      if (was) found.push_back({a, b, std::nullopt, std::nullopt});
      for (int i = 1; i <= kSteps; ++i) {
        double lo = seconds * (i - 1) / kSteps, hi = seconds * i / kSteps;
        const bool is = overlap(parts[a], parts[b], hi);
        if (is == was) continue;
        for (int k = 0; k < 40; ++k) {
          const double middle = (lo + hi) / 2;
          (overlap(parts[a], parts[b], middle) == was ? lo : hi) = middle;
        }
        if (is) found.push_back({a, b, lo, std::nullopt});
        if (!is) found.back().to = lo;
        was = is;
      }
    }
  return found;
}

}  // namespace impinge::test
