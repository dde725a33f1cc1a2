// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/bcf/snapshot.hpp"

#include <png.h>

#include <algorithm>
#include <cstddef>
#include <new>

namespace impinge::report {
namespace {

struct Drawing {
  std::array<Layer, 2> layers;
  std::vector<unsigned char> marks;
  Layer around;  ///< empty where nobody looks at it
};

Drawing drawing_of(const Scenery& scenery, const Lens& lens, double line_width) {
  Drawing drawing{{layer_of(scenery.parts[0], lens), layer_of(scenery.parts[1], lens)}, {}, {}};
  drawing.marks = marks_of(scenery.lines, drawing.layers, lens, line_width);
  return drawing;
}

using Colour = std::array<double, 3>;

Colour colour_of(unsigned rgb) {
  return {static_cast<double>(rgb >> 16U & 0xFFU), static_cast<double>(rgb >> 8U & 0xFFU),
          static_cast<double>(rgb & 0xFFU)};
}
Colour mixed(const Colour& a, const Colour& b, double share_of_b) {
  Colour c{};
  for (std::size_t i = 0; i < 3; ++i) c[i] = a[i] + share_of_b * (b[i] - a[i]);
  return c;
}

constexpr unsigned char kBackgroundLevel = 0xF7;

bool is_background(const Drawing& drawing, std::size_t at) {
  return drawing.layers[0].nearness[at] == 0 && drawing.layers[1].nearness[at] == 0 && drawing.marks[at] == kNone &&
         drawing.around.nearness[at] == 0;
}

Colour pixel_of(const Drawing& drawing, std::optional<std::size_t> glass, std::size_t at) {
  static const Colour kBackground{kBackgroundLevel, kBackgroundLevel, kBackgroundLevel}, kLine = colour_of(0xC2004D);
  static const std::array<Colour, 2> kParts{colour_of(kPartColours[0]), colour_of(kPartColours[1])};
  const auto shaded = [&](std::size_t part) {
    return mixed({0, 0, 0}, kParts[part], static_cast<double>(drawing.layers[part].shading[at]) / 255);
  };
  Colour colour = kBackground;
  static const Colour kAround = colour_of(0xE4E6EA), kAroundDark = colour_of(0x9A9DA6);
  if (drawing.around.nearness[at] > 0)
    colour = mixed(kAroundDark, kAround, static_cast<double>(drawing.around.shading[at]) / 255);
  const std::array<float, 2> near{drawing.layers[0].nearness[at], drawing.layers[1].nearness[at]};
  const std::size_t front = near[1] > near[0] ? 1 : 0;
  constexpr double kThroughParts = 0.35, kThroughGlass = 0.7;
  if (near[front] > 0)
    colour = near[1 - front] > 0
                 ? mixed(shaded(front), shaded(1 - front), front == glass ? kThroughGlass : kThroughParts)
                 : shaded(front);
  constexpr double kHiddenLine = 0.55;
  const unsigned char mark = drawing.marks[at];
  return mark == kNone ? colour : mixed(colour, kLine, mark == kVisible ? 1.0 : kHiddenLine);
}

}  // namespace

View clearest(const Scenery& scenery, const std::array<View, 8>& views) {
  constexpr std::size_t kWidth = 160, kHeight = 120;
  std::size_t best = 0;
  std::ptrdiff_t most = -1;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Lens lens{views[i], kWidth, kHeight};
    const Drawing drawing = drawing_of(scenery, lens, 1.5);
    const std::ptrdiff_t visible = std::count(drawing.marks.begin(), drawing.marks.end(), kVisible);
    if (visible > most) best = i, most = visible;
  }
  return views[best];
}

Picture draw(const Scenery& scenery, const View& view) {
  constexpr std::size_t kWidth = kSnapshotWidth, kHeight = kSnapshotHeight,
                        kFiner = 2;  // each pixel is the mean of so many by so many
  const Lens lens{view, kFiner * kWidth, kFiner * kHeight};
  Drawing drawing = drawing_of(scenery, lens, 2.5 * kFiner);
  drawing.around = layer_of(scenery.around, scenery.kept, lens);
  Picture picture{kWidth, kHeight, {}};
  picture.rgb.assign(3 * kWidth * kHeight, kBackgroundLevel);
  for (std::size_t y = 0; y < kHeight; ++y) {
    for (std::size_t x = 0; x < kWidth; ++x) {
      std::array<std::size_t, kFiner * kFiner> finer;
      for (std::size_t i = 0; i < finer.size(); ++i)
        finer[i] = (kFiner * y + i / kFiner) * lens.width + kFiner * x + i % kFiner;
      // Most of a picture.
      if (std::ranges::all_of(finer, [&](std::size_t at) { return is_background(drawing, at); })) continue;
      Colour sum{};
      for (const std::size_t at : finer) {
        const Colour one = pixel_of(drawing, scenery.glass, at);
        for (std::size_t k = 0; k < 3; ++k) sum[k] += one[k];
      }
      for (std::size_t k = 0; k < 3; ++k)
        picture.rgb[3 * (kWidth * y + x) + k] = static_cast<unsigned char>(sum[k] / (kFiner * kFiner) + 0.5);
    }
  }
  return picture;
}

std::string png_of(const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr) == 0)
    throw std::bad_alloc();  // there is room for the largest
  bytes.resize(size);
  bytes.shrink_to_fit();  // it is a hundredth of that
  return bytes;
}

}  // namespace impinge::report
