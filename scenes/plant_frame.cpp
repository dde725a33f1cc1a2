// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/plant_bays.hpp"
#include "scenes/plant_solids.hpp"

namespace impinge::scenes {
namespace {

constexpr double kX = 1200, kY = 900;          // of the columns
constexpr double kFloor = -1350, kTop = 3000;  // the floor's height in the bay, and the columns' above it
constexpr double kSide = 200, kHalf = kSide / 2;

/// A column on its plate on its foundation, and four anchors: cast in, or too short.
std::uint32_t put_column(Bay& bay, double x, double y) {
  constexpr double kPlate = 400, kThick = 30, kAt = 160, kAnchor = 10, kBlock = 500, kShort = 20;
  Catalogue& parts = bay.catalogue;
  const std::uint32_t column = bay.put("C", "column", parts.h_beam(kSide, kTop), Turn::upright, {x, y, kFloor});
  const std::uint32_t plate = bay.put("BP", "base plate", parts.base_plate(kPlate, kThick, kAt, kAnchor + kHoleRoom),
                                      Turn::upright, {x, y, kFloor - kThick});
  const std::uint32_t block = bay.put("F", "foundation", parts.box(kBlock, kBlock, 300), Turn::upright,
                                      {x - kBlock / 2, y - kBlock / 2, kFloor - kThick - 300});
  bay.touching(column, plate, "column on plate");
  bay.touching(plate, block, "plate on foundation");
  for (const double dx : {-kAt, kAt}) {
    for (const double dy : {-kAt, kAt}) {
      const bool is_short = bay.random.integer(0, 3) == 0;
      const std::uint32_t anchor =
          bay.put("B", "anchor", parts.bolt(kAnchor, is_short ? kShort : 150), Turn::down, {x + dx, y + dy, kFloor});
      bay.touching(anchor, plate, "anchor's head on plate");
      if (is_short)
        bay.near(anchor, block, {kThick - kShort, kThick - kShort}, "short anchor");
      else
        bay.penetrating(anchor, block, "anchor in foundation");
    }
  }
  return column;
}

/// Two pieces in line from `from` to `to`, the second of them by a gap further away from the first, or into it.
struct InLine {
  std::uint32_t first, second;
  double gap;
};
template <class Put>
InLine put_in_line(Bay& bay, std::string_view family, double from, double to, const Put& put) {
  const double gap = std::max(bay.any_gap(), -60.0), middle = (from + to) / 2;
  const InLine pieces{put(from, middle), put(middle + gap, to), gap};
  bay.by_gap(pieces.first, pieces.second, gap, family);
  return pieces;
}

}  // namespace

void frame_bay(Bay& bay) {
  Catalogue& parts = bay.catalogue;
  // Beams along x are nearer to the floor than those along y, so that they do not meet at the columns.
  constexpr double kLow = kFloor + 2400, kHigh = kFloor + 2800, kBox = kFloor + 1000;
  std::array<std::array<std::uint32_t, 2>, 2> columns{};
  for (const int i : {0, 1})
    for (const int j : {0, 1}) columns[i][j] = put_column(bay, i == 0 ? -kX : kX, j == 0 ? -kY : kY);
  std::array<std::uint32_t, 2> low{}, high{};
  for (const int i : {0, 1}) {
    const double x = i == 0 ? -kX : kX, y = i == 0 ? -kY : kY, reach = kY - kHalf;
    low[i] = bay.put("BM", "beam", parts.h_beam(kSide, 2 * (kX - kHalf)), Turn::along_x, {-kX + kHalf, y, kLow});
    high[i] = bay.put("BM", "beam", parts.h_beam(kSide, 2 * reach), Turn::along_y, {x, -reach, kHigh});
    for (const int j : {0, 1}) {
      bay.touching(low[i], columns[j][i], "beam to column");
      bay.touching(high[i], columns[i][j], "beam to column");
    }
    const InLine pieces = put_in_line(bay, "box beams in line", -reach, reach, [&](double from, double to) {
      return bay.put("BM", "box beam", parts.box_beam(100, 6, to - from), Turn::along_y, {x, from, kBox});
    });
    bay.touching(pieces.first, columns[i][0], "box beam to column");
    bay.touching(pieces.second, columns[i][1], "box beam to column");
  }
  // Trays lie on the high beams: their mesh stands with its floor in z, y is across, x up.
  const double tray_width = 300, tray_gap = bay.length(1, 9), on_beams = kHigh + kHalf;
  std::array<InLine, 2> trays{};
  for (const int i : {0, 1}) {
    const double y = i == 0 ? -500 : -500 + tray_width + tray_gap;
    trays[i] = put_in_line(bay, "trays in line", -kX - 150, kX + 150, [&](double from, double to) {
      return bay.put("T", "tray", parts.tray(tray_width, to - from), Turn::along_x, {from, y, on_beams});
    });
    bay.touching(trays[i].first, high[0], "tray on beam");
    bay.touching(trays[i].second, high[1], "tray on beam");
  }
  const auto side_by_side = [&](std::uint32_t i, std::uint32_t j, double along) {
    const double distance = std::hypot(tray_gap, std::max(along, 0.0));
    if (distance < kPlantClearance) bay.near(i, j, {distance, distance}, "trays side by side");
  };
  side_by_side(trays[0].first, trays[1].first, 0);
  side_by_side(trays[0].second, trays[1].second, 0);
  side_by_side(trays[0].first, trays[1].second, trays[1].gap);
  side_by_side(trays[0].second, trays[1].first, trays[0].gap);

  const PipeSize& through = kPipeSizes[static_cast<std::size_t>(bay.random.integer(0, 2))];
  const std::uint32_t pipe = bay.put("P", "pipe", parts.pipe(through, 500, 2), Turn::along_y, {300, -kY - 250, kLow});
  bay.penetrating(pipe, low[0], "pipe through web");
  const double gap = bay.length(1, 15);
  const std::uint32_t above = bay.put("P", "pipe", parts.pipe(through, 1800, 5), Turn::along_x,
                                      {-900, kY, kLow + kHalf + gap + flat_of(through.radius, through.sides)});
  bay.near(above, low[1], {gap, gap}, "pipe above beam");
}

}  // namespace impinge::scenes
