// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/plant_bays.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "scenes/plant_solids.hpp"

namespace impinge::scenes {

std::uint32_t Bay::put(std::string_view code, std::string_view kind, std::uint32_t mesh, Turn turn, const Place& at) {
  parts.push_back({mesh, turn, at, code, kind});
  return static_cast<std::uint32_t>(parts.size() - 1);
}

void Bay::expect(std::uint32_t i, std::uint32_t j, PlantPair pair) {
  pair.first = std::min(i, j);
  pair.second = std::max(i, j);
  pairs.push_back(pair);
}

void Bay::touching(std::uint32_t i, std::uint32_t j, std::string_view family) {
  expect(i, j, {.verdict = Verdict::touching, .family = family});
}
void Bay::penetrating(std::uint32_t i, std::uint32_t j, std::string_view family) {
  expect(i, j, {.verdict = Verdict::penetrating, .family = family});
}
void Bay::duplicate(std::uint32_t i, std::uint32_t j, std::string_view family) {
  expect(i, j, {.verdict = Verdict::duplicate, .family = family});
}
void Bay::inside(std::uint32_t inner, std::uint32_t outer, std::string_view family) {
  expect(inner, outer, {.verdict = Verdict::inside, .inner = inner < outer ? 0 : 1, .family = family});
}
void Bay::near(std::uint32_t i, std::uint32_t j, const Interval& distance, std::string_view family) {
  expect(i, j, {.verdict = Verdict::apart, .distance = distance, .family = family});
}

void Bay::by_gap(std::uint32_t i, std::uint32_t j, double gap, std::string_view family) {
  assert((gap == 0 || std::fabs(gap) >= 1) && std::fabs(gap - kPlantClearance) >= 2);
  if (gap < 0) penetrating(i, j, family);
  if (gap == 0) touching(i, j, family);
  if (gap > 0 && gap < kPlantClearance) near(i, j, {gap, gap}, family);
}

double Bay::length(double low, double high) {
  return low + random.integer(0, static_cast<int>((high - low) * 8)) / 8.0;
}

double Bay::any_gap() {
  switch (random.integer(0, 3)) {
    case 0:
      return -length(1, random.integer(0, 1) == 0 ? 4 : 100);
    case 1:
      return 0;
    case 2:
      return length(1, 15);
    default:
      return length(30, 120);
  }
}

Interval radial_gap(double inner, double outer, int outer_sides) {
  // Some corner of the inner wall is so far from the outer one, and no point is nearer than the inner circle to a side.
  constexpr double kSnap = 0x1p-8;
  return {outer * std::cos(std::numbers::pi / outer_sides) - inner - kSnap, outer - inner + kSnap};
}

namespace {

const PipeSize& any_size(Random& random, int largest = 5) {
  return kPipeSizes[static_cast<std::size_t>(random.integer(0, largest))];
}

/// Rings along a pipe of such a length: as a tessellator that keeps triangles from growing thin.
int rings(double length) { return 1 + static_cast<int>(length) / 280; }

struct FlangePair {
  std::uint32_t left, gasket, right;
};

void bolt_up(Bay& bay, const PipeSize& size, double y, double z, const FlangePair& flanges) {
  const double back = kGasket / 2 + size.thickness;
  const std::uint32_t bolt = bay.catalogue.bolt(size.bolt, 2 * back + kNut + kBoltEnd);
  const double room = bay.random.integer(0, 1) == 0 ? 0 : kNutRoom;
  const std::uint32_t nut = bay.catalogue.nut(size.bolt, room);
  const Interval hole_gap = radial_gap(size.bolt, size.bolt + kHoleRoom, kHoleSides);
  for (int k = 0; k < size.holes; ++k) {
    const auto at = Catalogue::hole(size, k);
    const std::uint32_t b = bay.put("B", "bolt", bolt, Turn::along_x, {-back, y + at[0], z + at[1]});
    const std::uint32_t n = bay.put("N", "nut", nut, Turn::along_x, {back, y + at[0], z + at[1]});
    bay.touching(b, flanges.left, "bolt head on flange");
    bay.near(b, flanges.gasket, hole_gap, "bolt in hole");
    bay.near(b, flanges.right, hole_gap, "bolt in hole");
    bay.touching(n, flanges.right, "nut on flange");
    if (room == 0)
      bay.touching(n, b, "tight nut on bolt");
    else
      bay.near(n, b, radial_gap(size.bolt, size.bolt + room, kBoltSides), "wide nut on bolt");
  }
}

/// A box under the middle of a pipe along x, against its lowest side.
void support(Bay& bay, const PipeSize& size, std::uint32_t pipe, double x, double y, double z) {
  constexpr double kWidth = 160, kHeight = 300;
  const double top = z - flat_of(size.radius, size.sides);
  const std::uint32_t box = bay.put("S", "support", bay.catalogue.box(kWidth, kWidth, kHeight), Turn::upright,
                                    {x - kWidth / 2, y - kWidth / 2, top - kHeight});
  bay.touching(pipe, box, "pipe on support");
}

void pipeline(Bay& bay, double z) {
  const PipeSize& size = any_size(bay.random);
  const double left = 100 * bay.random.integer(8, 20), right = 100 * bay.random.integer(8, 20);
  const double face = kGasket / 2, neck = face + size.thickness + kNeck, bend = Catalogue::bend(size);
  Catalogue& parts = bay.catalogue;
  const std::uint32_t pipe1 = bay.put("P", "pipe", parts.pipe(size, left, rings(left)), Turn::against_x, {-neck, 0, z});
  const std::uint32_t flange1 = bay.put("FL", "flange", parts.flange(size), Turn::against_x, {-face, 0, z});
  const std::uint32_t gasket = bay.put("G", "gasket", parts.gasket(size), Turn::along_x, {-face, 0, z});
  const std::uint32_t flange2 = bay.put("FL", "flange", parts.flange(size), Turn::along_x, {face, 0, z});
  const std::uint32_t pipe2 = bay.put("P", "pipe", parts.pipe(size, right, rings(right)), Turn::along_x, {neck, 0, z});
  const std::uint32_t elbow = bay.put("E", "elbow", parts.elbow(size, 12), Turn::along_x, {neck + right, 0, z});
  const std::uint32_t pipe3 =
      bay.put("P", "pipe", parts.pipe(size, 600, rings(600)), Turn::along_y, {neck + right + bend, bend, z});
  bay.touching(pipe1, flange1, "pipe to neck");
  bay.touching(flange1, gasket, "flange to gasket");
  bay.touching(gasket, flange2, "flange to gasket");
  bay.near(flange1, flange2, {kGasket, kGasket}, "flanges across gasket");
  bay.touching(flange2, pipe2, "pipe to neck");
  bay.touching(pipe2, elbow, "pipe to elbow");
  bay.touching(elbow, pipe3, "pipe to elbow");
  bolt_up(bay, size, 0, z, {flange1, gasket, flange2});
  support(bay, size, pipe1, -neck - left / 2, 0, z);
  support(bay, size, pipe2, neck + right / 2, 0, z);
}

/// A pipe along y over those of a rack: where its underside may be for this gap to the highest, so that no other pipe
/// comes too near to touching or to the clearance.
bool is_clear_cut(const std::vector<double>& tops, double underside) {
  for (const double top : tops) {
    const double gap = underside - top;
    if ((gap != 0 && std::fabs(gap) < 1) || std::fabs(gap - kPlantClearance) < 2) return false;
  }
  return true;
}

}  // namespace

void line_bay(Bay& bay) {
  pipeline(bay, -900);
  pipeline(bay, 900);
}

void rack_bay(Bay& bay) {
  constexpr double kLength = 5000, kWidth = 3000;
  Catalogue& parts = bay.catalogue;
  std::vector<std::uint32_t> beams, pipes;
  std::vector<double> tops;
  for (const double x : {-2000.0, 0.0, 2000.0}) {
    beams.push_back(bay.put("BM", "beam", parts.h_beam(200, kWidth), Turn::along_y, {x, -kWidth / 2, -100}));
  }
  const PipeSize* last = nullptr;
  for (double y = -kWidth / 2 + 20; pipes.size() < 12;) {
    const PipeSize& size = last && bay.random.integer(0, 1) == 0 ? *last : any_size(bay.random);
    const double flat = flat_of(size.radius, size.sides);
    double gap = bay.length(30, 120);
    if (last == &size) {
      // Cut in no deeper than leaves one pipe outside of the other's bore.
      gap = std::max(bay.any_gap(), -size.wall);
    }
    const double center = pipes.empty() ? y + flat : y + gap + flat;
    if (center + flat > kWidth / 2 - 20) break;
    const std::uint32_t pipe =
        bay.put("P", "pipe", parts.pipe(size, kLength, rings(kLength)), Turn::along_x, {-kLength / 2, center, flat});
    for (const std::uint32_t beam : beams) bay.touching(pipe, beam, "pipe on beam");
    if (last == &size) bay.by_gap(pipes.back(), pipe, gap, "pipes side by side");
    pipes.push_back(pipe);
    tops.push_back(2 * flat);
    last = &size;
    y = center + flat;
  }
  const double highest = *std::max_element(tops.begin(), tops.end());
  for (const double x : {-1500.0, -1000.0, -500.0, 500.0, 1000.0, 1500.0}) {
    const PipeSize& size = any_size(bay.random, 3);
    double underside = highest + bay.any_gap();
    while (!is_clear_cut(tops, underside) || underside < 1) underside = highest + bay.any_gap();
    const double flat = flat_of(size.radius, size.sides);
    const std::uint32_t pipe = bay.put("P", "pipe", parts.pipe(size, kWidth, rings(kWidth)), Turn::along_y,
                                       {x, -kWidth / 2, underside + flat});
    for (std::size_t i = 0; i < pipes.size(); ++i) bay.by_gap(pipe, pipes[i], underside - tops[i], "pipe over pipe");
  }
}

void vessel_bay(Bay& bay) {
  constexpr double kRadius = 600, kWall = 20, kLong = 2400;
  constexpr int kSides = 64;
  const double outer = flat_of(kRadius, kSides), inner = flat_of(kRadius - kWall, kSides);
  Catalogue& parts = bay.catalogue;
  const std::uint32_t vessel =
      bay.put("V", "vessel", parts.vessel(kRadius, kLong, kWall, kSides), Turn::along_x, {0, 0, 0});
  for (const double x : {-900.0, 700.0}) {
    const std::uint32_t saddle =
        bay.put("S", "saddle", parts.box(200, 600, 300), Turn::upright, {x, -300, -outer - 300});
    bay.touching(vessel, saddle, "vessel on saddle");
  }
  const PipeSize& size = any_size(bay.random, 2);
  const auto nozzle = [&](double x, double z) {
    return bay.put("P", "nozzle", parts.pipe(size, 400, 2), Turn::upright, {x, 0, z});
  };
  bay.penetrating(nozzle(-700, outer - 200), vessel, "nozzle through wall");
  bay.penetrating(nozzle(-300, outer - bay.length(1, 15)), vessel, "nozzle into wall");
  const double gap = bay.length(1, 15);
  // Only the nozzle's middle is over the highest side; the wall falls away beside it.
  bay.near(nozzle(100, outer + gap), vessel, {gap, gap}, "nozzle above wall");
  // A side of the vessel's wall is 57 mm wide; the wall between two sides is 19.9 mm thick.
  const std::uint32_t sensor = parts.box(40, 8, 8);
  const auto put_sensor = [&](double x, double z) { return bay.put("I", "sensor", sensor, Turn::upright, {x, -4, z}); };
  bay.inside(put_sensor(500, inner + 6), vessel, "sensor in wall");
  bay.inside(put_sensor(600, outer - 8), vessel, "sensor in wall, in touch");
  bay.penetrating(put_sensor(700, outer - bay.length(1, 7)), vessel, "sensor half in wall");
  bay.touching(put_sensor(800, outer), vessel, "sensor on wall");
  bay.touching(put_sensor(900, inner - 8), vessel, "sensor under wall");
  const std::uint32_t standing = bay.put("I", "internal", parts.box(300, 40, 300), Turn::upright, {-600, -20, -inner});
  bay.touching(standing, vessel, "internal stands in cavity");
  const std::uint32_t raised =
      bay.put("I", "internal", parts.box(300, 40, 300), Turn::upright, {100, -20, gap - inner});
  bay.near(raised, vessel, {gap, gap}, "internal above cavity's floor");
  bay.put("I", "dip tube", parts.pipe(kPipeSizes[0], 800, 2), Turn::along_x, {-400, 0, 100});

  const std::uint32_t tank = bay.put("TK", "tank", parts.tank(1200, 800, 800, 16), Turn::upright, {-600, 1000, -400});
  const auto box_in_tank = [&](double x, double y, double z) {
    return bay.put("I", "box", parts.box(200, 200, 200), Turn::upright, {x, y, z});
  };
  bay.touching(box_in_tank(-500, 1200, -384), tank, "box stands in tank");
  bay.touching(box_in_tank(384, 1584, 184), tank, "box in tank's corner");
  bay.near(box_in_tank(-584 + gap, 1200, 0), tank, {gap, gap}, "box near tank's wall");
  bay.penetrating(box_in_tank(-200, 1016 - bay.length(1, 15), 0), tank, "box into tank's wall");
  box_in_tank(0, 1300, -100);
}

void store_bay(Bay& bay, int count) {
  assert(count <= kStoreParts);
  Catalogue& parts = bay.catalogue;
  for (int k = 0; k < count; ++k) {
    const PipeSize& size = any_size(bay.random, 4);
    const Bay::Place at{(k % 3 - 1) * 700.0, (k / 3 % 4 - 1.5) * 700, (k / 12 - 1) * 900.0};
    switch (bay.random.integer(0, 4)) {
      case 0:
        bay.put("Q", "valve", parts.valve(size), Turn::upright, at);
        break;
      case 1:
        bay.put("E", "elbow", parts.elbow(size, 12), Turn::along_x, {at[0] - 150, at[1] - 150, at[2]});
        break;
      case 2:
        bay.put("FL", "flange", parts.flange(size), Turn::along_y, at);
        break;
      case 3:
        bay.put("W", "handwheel", parts.wheel(160, 48), Turn::upright, at);
        break;
      default:
        bay.put("B", "bolt", parts.bolt(size.bolt, 100), Turn::upright, at);
    }
  }
}

}  // namespace impinge::scenes
