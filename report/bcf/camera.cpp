// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numbers>

#include "report/bcf/raster.hpp"

namespace impinge::report {
namespace {

/// From coordinates with Z up to those of the files.
Point with_up(const Point& p, bool y_up) { return y_up ? Point{p.x, p.z, -p.y} : p; }

/// How far around the middle is shown.
double shown(const Place& place, std::array<double, 2> radii) {
  const double clash = length(0.5 * (place.box.hi - place.box.lo));
  const double smaller = std::min(radii[0], radii[1]), larger = std::max(radii[0], radii[1]);
  // A spot on two large parts says little without some of them around it; more than all of both is never needed.
  const double around = std::max({smaller / 2, larger / 16, std::min(3 * smaller, larger / 5)});
  const double radius = std::min(std::max(2 * clash, around), clash + 2 * larger);
  return radius > 0 ? radius : 1;
}

}  // namespace

std::array<View, 8> views_of(const Place& place, std::array<double, 2> radii, bool y_up) {
  const double half_angle = kFieldOfView / 2 * std::numbers::pi / 180;
  const double distance = shown(place, radii) / std::sin(half_angle);
  const Point target = middle(place.box.lo, place.box.hi);
  constexpr double kSlope = 0.6;
  std::array<View, 8> views;
  for (std::size_t i = 0; i < views.size(); ++i) {
    // Not along diagonals: from there a box shows edges behind edges.
    constexpr std::array<std::array<double, 2>, 4> kSides{{{0.5, -0.9}, {0.9, 0.5}, {-0.5, 0.9}, {-0.9, -0.5}}};
    const auto [x, y] = kSides[i % 4];
    View& view = views[i];
    const Point to_eye = unit({x, y, i < 4 ? kSlope : -kSlope});
    const Point forward = -1.0 * to_eye, right = unit(cross(forward, {0, 0, 1}));
    view.forward = with_up(forward, y_up);
    view.right = with_up(right, y_up);
    view.up = with_up(cross(right, forward), y_up);
    view.eye = target - distance * view.forward;
    view.distance = distance;
  }
  return views;
}

}  // namespace impinge::report
