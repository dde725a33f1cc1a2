// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <numbers>

#include "scenes/plant_bays.hpp"
#include "scenes/plant_solids.hpp"

/// Small things, each in a cell of its own: what two or three boxes, pins or pipes can be to each other.
namespace impinge::scenes {
namespace {

/// A cell's lowest corner; its things stay within [0, 500]^3 from there.
struct Cell {
  Bay& bay;
  Bay::Place corner;

  [[nodiscard]] Catalogue& parts() const { return bay.catalogue; }
  std::uint32_t put(std::string_view code, std::string_view kind, std::uint32_t mesh, Turn turn,
                    const Bay::Place& at) const {
    return bay.put(code, kind, mesh, turn, {corner[0] + at[0], corner[1] + at[1], corner[2] + at[2]});
  }
  [[nodiscard]] std::uint32_t box(const Bay::Place& low, const Bay::Place& size) const {
    return put("BX", "box", parts().box(size[0], size[1], size[2]), Turn::upright, low);
  }
};

/// Two equal boxes, moved apart along one, two or three axes: four, two or no common face planes.
void shifted_boxes(const Cell& cell) {
  const Bay::Place size{200, 120, 80};
  const int axes = cell.bay.random.integer(1, 3);
  Bay::Place at{};
  for (int k = 0; k < axes; ++k) at[k] = size[k] - cell.bay.length(1, 70);
  cell.bay.penetrating(cell.box({0, 0, 0}, size), cell.box(at, size),
                       axes == 1   ? "overlap, 4 common planes"
                       : axes == 2 ? "overlap, 2 common planes"
                                   : "overlap");
}

void boxes_with_common_planes(const Cell& cell) {
  const std::uint32_t plate = cell.box({0, 100, 0}, {200, 200, 60});
  if (cell.bay.random.integer(0, 1) == 0) {
    cell.bay.penetrating(plate, cell.box({50, 0, 0}, {60, 400, 100}), "overlap, 1 common plane");
  } else {
    cell.bay.penetrating(plate, cell.box({0, 100, 0}, {80, 80, 150}), "overlap, 3 common planes");
  }
}

void box_in_box(const Cell& cell) {
  const std::uint32_t outer = cell.box({0, 0, 0}, {300, 300, 200});
  const int touched = cell.bay.random.integer(0, 3);
  Bay::Place at{};
  for (int k = 0; k < 3; ++k) at[k] = k < touched ? 0 : cell.bay.length(1, 40);
  constexpr std::array<const char*, 4> kFamilies{"inside", "inside, 1 common plane", "inside, 2 common planes",
                                                 "inside, 3 common planes"};
  const std::uint32_t inner = cell.box(at, {100, 60, 50});
  cell.bay.inside(inner, outer, kFamilies[static_cast<std::size_t>(touched)]);
}

std::uint32_t any_small_part(const Cell& cell) {
  switch (cell.bay.random.integer(0, 4)) {
    case 0:
      return cell.parts().box(200, 100, 50);
    case 1:
      return cell.parts().bolt(10, 100);
    case 2:
      return cell.parts().flange(kPipeSizes[1]);
    case 3:
      return cell.parts().elbow(kPipeSizes[0], 12);
    default:
      return cell.parts().tank(200, 100, 100, 10);
  }
}

void twice(const Cell& cell) {
  const std::uint32_t mesh = any_small_part(cell);
  const auto put = [&](std::uint32_t m) { return cell.put("D", "double", m, Turn::upright, {150, 150, 50}); };
  const std::uint32_t first = put(mesh);
  switch (cell.bay.random.integer(0, 3)) {
    case 0:
      return cell.bay.duplicate(first, put(mesh), "placed twice");
    case 1:
      return cell.bay.duplicate(first, put(cell.parts().renumbered_of(mesh)), "twice, renumbered");
    case 2:
      return cell.bay.duplicate(first, put(cell.parts().inverted_of(mesh)), "twice, inside out");
    default:
      return cell.bay.duplicate(first, put(cell.parts().subdivided_of(mesh)), "twice, triangles cut in four");
  }
}

/// Thinner than four times the tolerance far out: it may excuse nothing here.
void thin_sheets(const Cell& cell) {
  const Bay::Place size{300, 300, 0.25};
  const double shift = cell.bay.random.integer(0, 1) * cell.bay.length(1, 100);
  cell.bay.penetrating(cell.box({0, 0, 0}, size), cell.box({shift, shift, 0.125}, size), "thin sheets");
}

void edge_or_corner_contact(const Cell& cell) {
  const Bay::Place size{100, 100, 100};
  const std::uint32_t first = cell.box({0, 0, 0}, size);
  switch (cell.bay.random.integer(0, 2)) {
    case 0:
      return cell.bay.touching(first, cell.box({100, 100, cell.bay.length(0, 50)}, size), "edge on edge");
    case 1:
      return cell.bay.touching(first, cell.box({100, 100, 100}, size), "corner on corner");
    default: {  // a corner of the hexagon lies on the y axis
      const std::uint32_t bar = cell.parts().cylinder(30, 150, 6);
      return cell.bay.touching(first, cell.put("BR", "bar", bar, Turn::upright, {50, 130, 0}), "edge on face");
    }
  }
}

void near_boxes(const Cell& cell) {
  // Apart along one axis, two or three: with an exact distance.
  constexpr std::array<std::array<double, 4>, 10> kShifts{{{3, 0, 0, 3},
                                                           {0, 0, 12, 12},
                                                           {3, 4, 0, 5},
                                                           {0, 8, 6, 10},
                                                           {5, 0, 12, 13},
                                                           {1, 2, 2, 3},
                                                           {2, 3, 6, 7},
                                                           {4, 7, 4, 9},
                                                           {6, 6, 7, 11},
                                                           {2, 14, 5, 15}}};
  const auto& shift = kShifts[static_cast<std::size_t>(cell.bay.random.integer(0, 9))];
  Bay::Place at{};
  for (std::size_t k = 0; k < 3; ++k) at[k] = shift[k] == 0 ? 30 : 100 + shift[k];
  cell.bay.near(cell.box({0, 0, 0}, {100, 100, 100}), cell.box(at, {100, 100, 100}), {shift[3], shift[3]},
                "boxes at an exact distance");
}

void pin_in_bushing(const Cell& cell) {
  constexpr double kBore = 30;
  constexpr int kSides = 32;
  const int fit = cell.bay.random.integer(-1, 1);
  const double room = fit == 0 ? 0 : fit * cell.bay.length(1, 4);
  const std::uint32_t bushing =
      cell.put("BU", "bushing", cell.parts().bushing(60, kBore, 120, kSides), Turn::along_x, {100, 100, 100});
  const std::uint32_t pin =
      cell.put("PN", "pin", cell.parts().cylinder(kBore - room, 200, kSides), Turn::along_x, {60, 100, 100});
  if (room < 0) cell.bay.penetrating(pin, bushing, "pin too wide");
  if (room == 0) cell.bay.touching(pin, bushing, "pin fits");
  if (room > 0) cell.bay.near(pin, bushing, radial_gap(kBore - room, kBore, kSides), "pin with room");
}

void box_in_cavity(const Cell& cell) {
  const std::uint32_t tank = cell.put("TK", "tank", cell.parts().tank(200, 160, 140, 20), Turn::upright, {0, 0, 0});
  switch (cell.bay.random.integer(0, 2)) {
    case 0:
      return cell.bay.touching(tank, cell.box({20, 20, 20}, {160, 120, 100}), "cavity filled");
    case 1:
      return cell.bay.touching(tank, cell.box({20, 20, 20}, {160, 120, 50}), "cavity half filled");
    default: {
      const double gap = cell.bay.length(1, 10);
      return cell.bay.near(tank, cell.box({20 + gap, 45, 45}, {100, 60, 50}), {gap, gap}, "box free in cavity");
    }
  }
}

void ball(const Cell& cell) {
  constexpr double kCavity = 100;
  constexpr int kSides = 32;
  const double gap = cell.bay.length(3, 15), radius = kCavity - gap;
  const std::uint32_t inner =
      cell.put("BL", "ball", cell.parts().sphere(radius, 0, kSides), Turn::upright, {150, 150, 150});
  if (cell.bay.random.integer(0, 1) == 0) {
    // A triangle of the cavity is off the sphere by two chords at most: across, and along a meridian.
    const double chord = std::cos(std::numbers::pi / kSides);
    const std::uint32_t shell =
        cell.put("SH", "shell", cell.parts().sphere(120, kCavity, kSides), Turn::upright, {150, 150, 150});
    return cell.bay.near(inner, shell, {kCavity * chord * chord - radius - 0x1p-8, gap + 0x1p-8}, "ball in shell");
  }
  cell.bay.inside(inner, cell.box({0, 0, 0}, {300, 300, 300}), "ball in block");
}

void bolt_to_plate(const Cell& cell) {
  const double gap = cell.bay.any_gap();
  if (gap > kPlantClearance) return near_boxes(cell);
  const double length = 120;
  const std::uint32_t bolt = cell.put("B", "bolt", cell.parts().bolt(8, length), Turn::along_x, {20, 100, 100});
  const std::uint32_t plate = cell.box({20 + length + gap, 50, 50}, {130, 100, 100});
  cell.bay.by_gap(bolt, plate, gap, "bolt's end at plate");
}

void crossing_pipes(const Cell& cell) {
  const PipeSize& size = kPipeSizes[static_cast<std::size_t>(cell.bay.random.integer(0, 2))];
  const double flat = flat_of(size.radius, size.sides);
  const std::uint32_t mesh = cell.parts().pipe(size, 450, 2);
  const std::uint32_t first = cell.put("P", "pipe", mesh, Turn::along_x, {20, 245, 100});
  if (cell.bay.random.integer(0, 2) == 0) {  // right through each other
    return cell.bay.penetrating(first, cell.put("P", "pipe", mesh, Turn::along_y, {245, 20, 100}), "pipe through pipe");
  }
  const double gap = std::max(cell.bay.any_gap(), -flat);
  cell.bay.by_gap(first, cell.put("P", "pipe", mesh, Turn::along_y, {245, 20, 100 + 2 * flat + gap}), gap,
                  "pipe over pipe");
}

void stiffener(const Cell& cell) {
  // Between the flanges of an H-beam of 200 mm, from its web outwards.
  const std::uint32_t beam = cell.put("BM", "beam", cell.parts().h_beam(200, 400), Turn::along_x, {0, 100, 100});
  const std::uint32_t plate = cell.box({150, 106.25, 12.5}, {10, 93.75, 175});
  cell.bay.touching(beam, plate, "stiffener in beam");
}

void bar_in_tube(const Cell& cell) {
  const std::uint32_t tube =
      cell.put("BM", "box beam", cell.parts().box_beam(100, 6, 300), Turn::along_x, {50, 50, 50});
  const double gap = cell.bay.random.integer(0, 1) * cell.bay.length(1, 15);
  const std::uint32_t bar = cell.box({0, 30, 6 + gap}, {400, 40, 40});
  cell.bay.by_gap(tube, bar, gap, "bar in tube");
}

void valve_with_pipe(const Cell& cell) {
  const PipeSize& size = kPipeSizes[static_cast<std::size_t>(cell.bay.random.integer(0, 1))];
  const std::uint32_t valve = cell.put("Q", "valve", cell.parts().valve(size), Turn::along_x, {0, 150, 150});
  const std::uint32_t pipe =
      cell.put("P", "pipe", cell.parts().pipe(size, 200, 1), Turn::along_x, {Catalogue::valve_length(size), 150, 150});
  cell.bay.touching(valve, pipe, "valve to pipe");
}

void bars_in_concrete(const Cell& cell) {
  const std::uint32_t block = cell.box({50, 0, 0}, {350, 200, 150});
  const auto bar = [&](double x, double y, double length) {
    return cell.put("BR", "rebar", cell.parts().cylinder(8, length, 12), Turn::along_x, {x, y, 75});
  };
  cell.bay.inside(bar(80, 40, 280), block, "rebar in concrete");
  cell.bay.inside(bar(50, 100, 280), block, "rebar in concrete, end flush");
  cell.bay.penetrating(bar(50 - cell.bay.length(1, 40), 160, 280), block, "rebar sticks out");
}

}  // namespace

void cells_bay(Bay& bay) {
  constexpr std::array kKinds{shifted_boxes,   boxes_with_common_planes,
                              box_in_box,      twice,
                              thin_sheets,     edge_or_corner_contact,
                              near_boxes,      pin_in_bushing,
                              box_in_cavity,   ball,
                              bolt_to_plate,   crossing_pipes,
                              stiffener,       bar_in_tube,
                              valve_with_pipe, bars_in_concrete};
  constexpr double kPitch = 620;
  for (int k = 0; k < 48; ++k) {
    const Bay::Place corner{(k % 4 - 2) * kPitch, (k / 4 % 4 - 2) * kPitch, (k / 16 - 1.5) * kPitch};
    kKinds[static_cast<std::size_t>(bay.random.integer(0, static_cast<int>(kKinds.size()) - 1))]({bay, corner});
  }
}

}  // namespace impinge::scenes
