// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "report/bcf/raster.hpp"

namespace impinge::report {

/// 3 bytes a pixel, red, green, blue, row by row from the top.
struct Picture {
  std::size_t width = 0, height = 0;
  std::vector<unsigned char> rgb;
};

/// What a picture of a clash shows: two parts and lines, in the world.
struct Scenery {
  std::array<Placed, 2> parts;
  std::optional<std::size_t> glass;       ///< the part that the other lies in, which must be seen through
  std::vector<Placed> around;             ///< parts that say where it is
  std::vector<HalfSpace> kept;            ///< what of these is drawn: the rest would hide the clash
  std::vector<std::vector<Point>> lines;  ///< where they meet, or between their nearest points; a point is a dot
};

/// The colours of the two parts, 0xRRGGBB: told apart by those who see no red or no green as well.
constexpr std::array<unsigned, 2> kPartColours{0x3B78B5, 0xE39A33};

/// The view of several in which most of the lines can be seen; the first of those.
View clearest(const Scenery& scenery, const std::array<View, 8>& views);

/// In pixels.
constexpr std::size_t kSnapshotWidth = 640, kSnapshotHeight = 480;

/// Both parts, what is behind the nearer one shining through it, and the lines, which are bright where they are not
/// hidden; behind all of it, pale, what is around. By a depth buffer.
Picture draw(const Scenery& scenery, const View& view);

/// As a PNG (ISO/IEC 15948), always the same for the same picture.
std::string png_of(const Picture& picture);

}  // namespace impinge::report
