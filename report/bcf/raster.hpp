// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "report/place.hpp"

/// Where a clash is looked at from; triangles and lines into pixels, with a depth buffer for each part.
namespace impinge::report {

/// From where a picture is taken. Vectors are of length 1 and at right angles.
struct View {
  Point eye{}, right{}, up{}, forward{};
  double distance = 1;  ///< of what is looked at
};

/// From top to bottom, in degrees: BCF 2.1 allows 45 to 60.
constexpr double kFieldOfView = 60;

/// Ways to look at a clash of two parts of these radii, so that it fills a good part of the picture and enough is seen
/// around it: from eight sides, those from above first.
std::array<View, 8> views_of(const Place& place, std::array<double, 2> radii, bool y_up);

/// A point of the picture: pixels to the right and down, and 1 / distance, which is linear in the picture.
struct Projected {
  double x, y, nearness;
};

/// A picture's size, and how points come into it.
struct Lens {
  const View& view;
  std::size_t width, height;

  /// To the right, up and forward of the eye.
  [[nodiscard]] Point seen(const Point& world) const {
    const Point p = world - view.eye;
    return {dot(p, view.right), dot(p, view.up), dot(p, view.forward)};
  }
  /// Of a point in front of the eye.
  [[nodiscard]] Projected project(const Point& p) const {
    const double scale = static_cast<double>(height) / 2 / std::tan(kFieldOfView / 2 * std::numbers::pi / 180);
    return {static_cast<double>(width) / 2 + scale * p.x / p.z, static_cast<double>(height) / 2 - scale * p.y / p.z,
            1 / p.z};
  }
  /// Nothing nearer to the eye than this is drawn.
  [[nodiscard]] double least() const { return 1e-3 * view.distance; }
};

/// A part in the world.
struct Placed {
  std::vector<Point> vertices;
  std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// One part as it is seen.
struct Layer {
  std::vector<float> nearness;         ///< of each pixel, 0 where there is nothing
  std::vector<unsigned char> shading;  ///< how much light falls there
};
Layer layer_of(const Placed& part, const Lens& lens);

/// What is kept of a scene that is cut open: the points with dot(normal, point) up to `most`.
struct HalfSpace {
  Point normal{};
  double most = 0;
};

/// Several parts, cut open by planes, in one layer. The insides of what is cut are dark.
Layer layer_of(std::span<const Placed> parts, std::span<const HalfSpace> kept, const Lens& lens);

/// Whether a line is seen in a pixel; hidden behind a part counts for less.
enum Mark : unsigned char { kNone, kHidden, kVisible };

/// Of each pixel, where lines of this width lie on or between two parts; a line of one point is a dot.
std::vector<unsigned char> marks_of(const std::vector<std::vector<Point>>& lines, const std::array<Layer, 2>& layers,
                                    const Lens& lens, double width);

}  // namespace impinge::report
