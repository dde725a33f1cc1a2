// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/precision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/text.hpp"

namespace impinge::io {
namespace {

constexpr double kMostRatio = 1e-6;

/// The distance between neighbouring floats at a coordinate.
double float_spacing(double coordinate) {
  constexpr int kSmallestExponent = std::numeric_limits<float>::min_exponent - 1;
  const int exponent = coordinate == 0 ? kSmallestExponent : std::max(std::ilogb(coordinate), kSmallestExponent);
  return std::ldexp(1.0, exponent - (std::numeric_limits<float>::digits - 1));
}

struct Extent {
  double size = 0;     ///< the longest side of the bounding box
  double largest = 0;  ///< the largest coordinate's magnitude
};

Extent extent_of(const Mesh& mesh) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Point low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  for (const Point& p : mesh.vertices()) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  if (mesh.vertices().empty()) return {};
  const double largest = std::max(
      {std::abs(low.x), std::abs(low.y), std::abs(low.z), std::abs(high.x), std::abs(high.y), std::abs(high.z)});
  return {std::max({high.x - low.x, high.y - low.y, high.z - low.z}), largest};
}

}  // namespace

void PrecisionCheck::add(std::string_view name, const Mesh& mesh, const Affine& world) {
  ++parts_;
  last_is_coarse_ = false;
  const Extent extent = extent_of(mesh);
  note(name, extent.largest, extent.size);
  double stretch = 0;  // how long the map makes a step along an axis, at most
  for (int column = 0; column < 3; ++column) {
    stretch = std::max(stretch, std::hypot(world.m[column], world.m[3 + column], world.m[6 + column]));
  }
  const double shift = std::max({std::abs(world.t[0]), std::abs(world.t[1]), std::abs(world.t[2])});
  note(name, shift, extent.size * stretch);
}

void PrecisionCheck::note(std::string_view name, double coordinate, double size) {
  if (!(size > 0) || !std::isfinite(coordinate) || coordinate == 0) return;
  const double spacing = float_spacing(coordinate);
  const double ratio = spacing / size;
  if (!(ratio > kMostRatio)) return;
  if (!last_is_coarse_) ++coarse_;
  last_is_coarse_ = true;
  if (ratio <= worst_ratio_) return;
  worst_ = name;
  worst_ratio_ = ratio;
  worst_spacing_ = spacing;
  worst_coordinate_ = coordinate;
  worst_size_ = size;
}

void PrecisionCheck::report(std::vector<std::string>& warnings) const {
  if (coarse_ == 0) return;
  warnings.push_back(sentence(
      "The coordinates are 32-bit floats, whose spacing exceeds a millionth of the part's size in ", coarse_, " of ",
      parts_, parts_ == 1 ? " object" : " objects", "; worst is '", worst_, "', of size ", worst_size_,
      " with a spacing of ", worst_spacing_, " at coordinate ", worst_coordinate_,
      ": gaps and overlaps below that are not in the file; move the parts nearer to the origin before the export, or "
      "export to a format with 64-bit numbers."));
}

}  // namespace impinge::io
