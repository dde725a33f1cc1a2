// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/plant_parts.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "scenes/plant_solids.hpp"
#include "scenes/shapes.hpp"

namespace impinge::scenes {

// Sides are a multiple of four and an odd multiple of the holes: holes then lie in the middle of as many sides, and the
// flange is its own mirror image.
const std::array<PipeSize, 6> kPipeSizes{{{30, 4, 28, 82, 62, 4, 26, 8},
                                          {44, 5, 40, 100, 80, 8, 26, 8},
                                          {57, 6, 40, 115, 92, 8, 28, 8},
                                          {84, 7, 40, 143, 120, 8, 28, 10},
                                          {110, 8, 56, 170, 148, 8, 30, 10},
                                          {162, 10, 60, 230, 205, 12, 34, 10}}};

namespace {

enum Zone : unsigned { kWall = 0, kRim = 1 };

MeshData turned(const Loop& outer, const Loop& inner, int sides) {
  return joined(revolved(outer, sides), inverted(revolved(inner, sides)));
}

Section ring(double outer, double inner, int sides) {
  Section section;
  section.fill_between(circle(outer, sides), circle(inner, sides), kWall);
  return section;
}

/// A pipe's ring, and around it the rim with its holes, each in a sector of its own.
Section flange_section(const PipeSize& size) {
  Section section = ring(size.radius, size.radius - size.wall, size.sides);
  const Loop outer = circle(size.flange_radius, size.sides), inner = circle(size.radius, size.sides);
  const int span = size.sides / size.holes;
  for (int hole = 0; hole < size.holes; ++hole) {
    const int first = hole * span + size.sides - (span + 1) / 2;
    Loop sector;
    for (int k = 0; k <= span; ++k) sector.push_back(outer[static_cast<std::size_t>((first + k) % size.sides)]);
    for (int k = span; k >= 0; --k) sector.push_back(inner[static_cast<std::size_t>((first + k) % size.sides)]);
    section.fill_between(sector, circle(size.bolt + kHoleRoom, kHoleSides, Catalogue::hole(size, hole)), kRim);
  }
  return section;
}

/// A hexagon around a bolt's shank: the shank is the wall's zone, what is around it the rim's.
Section hexagon_section(double radius, double bore, int sides) {
  Section section;
  section.fill(circle(bore, sides), kWall);
  section.fill_between(circle(1.75 * radius, 6), circle(bore, sides), kRim);
  return section;
}

/// Half an ellipse's quarter turned up or down: `steps` + 1 points from the axis to radius (r, 0), or back.
void add_head(Loop& profile, double radius, double height, double at, int steps, bool top) {
  for (int i = 0; i <= steps; ++i) {
    const double angle = std::numbers::pi / 2 * (top ? i : steps - i) / steps;
    const double r = i == (top ? steps : 0) ? 0 : radius * std::cos(angle);
    profile.push_back({r, snapped(at + (top ? height : -height) * std::sin(angle))});
  }
}

Loop capsule(double radius, double straight, int steps, int along) {
  Loop profile;
  add_head(profile, radius, radius / 2, -straight / 2, steps, false);
  for (int i = 1; i < along; ++i) profile.push_back({radius, snapped(-straight / 2 + straight * i / along)});
  add_head(profile, radius, radius / 2, straight / 2, steps, true);
  return profile;
}

Loop half_circle(double radius, int steps) {
  Loop profile;
  for (int i = 0; i <= steps; ++i) {
    const double angle = std::numbers::pi * i / steps;
    profile.push_back({i == 0 || i == steps ? 0 : radius * std::sin(angle), snapped(-radius * std::cos(angle))});
  }
  return profile;
}

}  // namespace

std::uint32_t Catalogue::made(const std::string& kind, const std::vector<double>& numbers,
                              const std::function<MeshData()>& make) {
  const auto [place, is_new] = known_.try_emplace({kind, numbers}, static_cast<std::uint32_t>(meshes_.size()));
  if (is_new) meshes_.push_back(make());
  return place->second;
}

std::uint32_t Catalogue::pipe(const PipeSize& size, double length, int along) {
  return made("pipe", {size.radius, length, static_cast<double>(along)},
              [&] { return extruded(ring(size.radius, size.radius - size.wall, size.sides), 0, length, along); });
}

std::uint32_t Catalogue::elbow(const PipeSize& size, int along) {
  return made("elbow", {size.radius, static_cast<double>(along)}, [&] {
    MeshData mesh = extruded(ring(size.radius, size.radius - size.wall, size.sides), 0, along, along);
    const double reach = bend(size);
    for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) {
      const double angle = std::numbers::pi / 2 * mesh.xyz[i + 2] / along, arm = reach - mesh.xyz[i];
      mesh.xyz[i] = snapped(reach - arm * std::cos(angle));
      mesh.xyz[i + 2] = snapped(arm * std::sin(angle));
    }
    return mesh;
  });
}

std::uint32_t Catalogue::flange(const PipeSize& size) {
  return made("flange", {size.radius}, [&] {
    const std::array<double, 3> zs{0, size.thickness, size.thickness + kNeck};
    const std::array<unsigned, 2> layers{1u << kWall | 1u << kRim, 1u << kWall};
    return layered(flange_section(size), zs, layers);
  });
}

std::uint32_t Catalogue::gasket(const PipeSize& size) {
  return made("gasket", {size.radius}, [&] { return extruded(flange_section(size), 0, kGasket); });
}

std::array<double, 2> Catalogue::hole(const PipeSize& size, int k) {
  const double angle = 2 * std::numbers::pi * k / size.holes;
  return {snapped(size.bolt_circle * std::cos(angle)), snapped(size.bolt_circle * std::sin(angle))};
}

std::uint32_t Catalogue::bolt(double radius, double length) {
  return made("bolt", {radius, length}, [&] {
    const std::array<double, 4> zs{-kHead, 0, snapped(length / 2), length};
    const std::array<unsigned, 3> layers{1u << kWall | 1u << kRim, 1u << kWall, 1u << kWall};
    return layered(hexagon_section(radius, radius, kBoltSides), zs, layers);
  });
}

std::uint32_t Catalogue::nut(double radius, double room) {
  return made("nut", {radius, room}, [&] {
    const std::array<double, 2> zs{0, kNut};
    const std::array<unsigned, 1> layers{1u << kRim};
    return layered(hexagon_section(radius, radius + room, kBoltSides), zs, layers);
  });
}

std::uint32_t Catalogue::box(double x, double y, double z) {
  return made("box", {x, y, z}, [&] { return scenes::box({0, 0, 0}, {x, y, z}); });
}

std::uint32_t Catalogue::h_beam(double side, double length) {
  return made("h_beam", {side, length}, [&] {
    const double half = side / 2, flange = half - side / 16, web = side / 32;
    const std::array<double, 4> xs{-half, -web, web, half}, ys{-half, -flange, flange, half};
    const std::array<int, 9> zones{0, 0, 0, -1, 0, -1, 0, 0, 0};
    return extruded(grid_section(xs, ys, zones), 0, length, 4);
  });
}

std::uint32_t Catalogue::box_beam(double side, double wall, double length) {
  return made("box_beam", {side, wall, length}, [&] {
    const double half = side / 2;
    const std::array<double, 4> lines{-half, wall - half, half - wall, half};
    const std::array<int, 9> zones{0, 0, 0, 0, -1, 0, 0, 0, 0};
    return extruded(grid_section(lines, lines, zones), 0, length, 4);
  });
}

std::uint32_t Catalogue::tray(double width, double length) {
  return made("tray", {width, length}, [&] {
    // The floor is made flat with its slots and walls, and stood up: (x, y, z) to (y, z, x), so that it lies along z.
    constexpr int kSlots = 8;
    constexpr double kSheet = 3, kHeight = 60;
    std::vector<double> xs{0};
    for (int i = 0; i < kSlots; ++i) {
      xs.push_back(snapped(length * (4 * i + 1) / (4 * kSlots)));
      xs.push_back(snapped(length * (4 * i + 3) / (4 * kSlots)));
    }
    xs.push_back(length);
    const std::array<double, 6> ys{0, kSheet, width / 4, width * 3 / 4, width - kSheet, width};
    std::vector<int> zones;
    for (int row = 0; row < 5; ++row)
      for (int column = 0; column < 2 * kSlots + 1; ++column)
        zones.push_back(row == 0 || row == 4 ? int{kRim} : row == 2 && column % 2 == 1 ? -1 : int{kWall});
    const std::array<double, 3> zs{0, kSheet, kHeight};
    const std::array<unsigned, 2> layers{1u << kWall | 1u << kRim, 1u << kRim};
    MeshData mesh = layered(grid_section(xs, ys, zones), zs, layers);
    for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) {
      const double x = mesh.xyz[i], y = mesh.xyz[i + 1], z = mesh.xyz[i + 2];
      mesh.xyz[i] = y, mesh.xyz[i + 1] = z, mesh.xyz[i + 2] = x;
    }
    return mesh;
  });
}

std::uint32_t Catalogue::base_plate(double side, double thickness, double at, double hole) {
  return made("base_plate", {side, thickness, at, hole}, [&] {
    Section section;
    for (const double x : {0.0, 1.0}) {
      for (const double y : {0.0, 1.0}) {
        const double left = (x - 1) * side / 2, low = (y - 1) * side / 2, right = left + side / 2,
                     high = low + side / 2;
        section.fill_between({{left, low}, {right, low}, {right, high}, {left, high}},
                             circle(hole, kHoleSides, {(2 * x - 1) * at, (2 * y - 1) * at}), kWall);
      }
    }
    return extruded(section, 0, thickness);
  });
}

std::uint32_t Catalogue::cylinder(double radius, double length, int sides) {
  return made("cylinder", {radius, length, static_cast<double>(sides)}, [&] {
    Section section;
    section.fill(circle(radius, sides), kWall);
    return extruded(section, 0, length, 2);
  });
}

std::uint32_t Catalogue::bushing(double outer, double inner, double length, int sides) {
  return made("bushing", {outer, inner, length, static_cast<double>(sides)},
              [&] { return extruded(ring(outer, inner, sides), 0, length, 2); });
}

std::uint32_t Catalogue::vessel(double radius, double straight, double wall, int sides) {
  return made("vessel", {radius, straight, wall}, [&] {
    return turned(capsule(radius, straight, 10, 12), capsule(radius - wall, straight, 10, 12), sides);
  });
}

std::uint32_t Catalogue::tank(double x, double y, double z, double wall) {
  return made("tank", {x, y, z, wall}, [&] {
    const std::array<double, 4> xs{0, wall, x - wall, x}, ys{0, wall, y - wall, y}, zs{0, wall, z - wall, z};
    const std::array<int, 9> zones{0, 0, 0, 0, 1, 0, 0, 0, 0};
    const std::array<unsigned, 3> layers{1u << kWall | 1u << kRim, 1u << kWall, 1u << kWall | 1u << kRim};
    return layered(grid_section(xs, ys, zones), zs, layers);
  });
}

std::uint32_t Catalogue::sphere(double radius, double cavity, int sides) {
  return made("sphere", {radius, cavity, static_cast<double>(sides)}, [&] {
    if (cavity == 0) return revolved(half_circle(radius, sides / 2), sides);
    return turned(half_circle(radius, sides / 2), half_circle(cavity, sides / 2), sides);
  });
}

std::uint32_t Catalogue::valve(const PipeSize& size) {
  return made("valve", {size.radius}, [&] {
    const double r = size.radius, length = valve_length(size), rim = size.flange_radius;
    Loop profile{{r - size.wall, 0}, {rim, 0}, {rim, size.thickness}, {r, size.thickness}};
    constexpr int kSteps = 12;
    for (int i = 1; i < kSteps; ++i) {  // the body's bulge
      const double angle = std::numbers::pi * i / kSteps;
      const double inner = size.thickness, outer = length - size.thickness;
      profile.push_back({r + r * std::sin(angle), inner + (outer - inner) * i / kSteps});
    }
    profile.insert(profile.end(), {{r, length - size.thickness},
                                   {rim, length - size.thickness},
                                   {rim, length},
                                   {r - size.wall, length},
                                   {r - size.wall, length / 2}});
    return revolved_ring(profile, size.sides);
  });
}

std::uint32_t Catalogue::wheel(double radius, int sides) {
  return made("wheel", {radius, static_cast<double>(sides)}, [&] {
    Loop profile;
    for (const Flat& p : circle(radius / 8, 12)) profile.push_back({radius + p[0], p[1]});
    return revolved_ring(profile, sides);
  });
}

std::uint32_t Catalogue::subdivided_of(std::uint32_t mesh) {
  return made("subdivided", {static_cast<double>(mesh)}, [&] { return subdivided(meshes_[mesh]); });
}

std::uint32_t Catalogue::renumbered_of(std::uint32_t mesh) {
  return made("renumbered", {static_cast<double>(mesh)}, [&] { return renumbered(meshes_[mesh]); });
}

std::uint32_t Catalogue::inverted_of(std::uint32_t mesh) {
  return made("inverted", {static_cast<double>(mesh)}, [&] { return inverted(meshes_[mesh]); });
}

}  // namespace impinge::scenes
