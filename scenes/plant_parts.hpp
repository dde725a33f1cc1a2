// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "scenes/scene.hpp"

/// What a plant is built of, in millimetres. Long parts lie along z and start at z = 0 unless told otherwise.
namespace impinge::scenes {

/// A size of pipes and of the flanges that go with them.
struct PipeSize {
  double radius, wall;
  int sides;
  double flange_radius, bolt_circle;
  int holes;
  double thickness;  ///< of a flange
  double bolt;       ///< radius of a bolt's shank
};
extern const std::array<PipeSize, 6> kPipeSizes;

inline constexpr double kGasket = 3, kNeck = 70, kHead = 10, kNut = 14, kBoltEnd = 8;
inline constexpr double kHoleRoom = 1, kNutRoom = 0.75;  ///< of holes and wide nuts about a shank, in radius
inline constexpr int kBoltSides = 16, kHoleSides = 24;

/// Meshes by what they are: each is made once.
class Catalogue {
 public:
  std::uint32_t pipe(const PipeSize& size, double length, int along);
  /// From the origin upwards, round to the direction of x. The ends' centers are at 0 and (bend, 0, bend).
  std::uint32_t elbow(const PipeSize& size, int along);
  static double bend(const PipeSize& size) { return 3 * size.radius; }
  /// The face at z = 0, the neck ends at z = thickness + kNeck, with the pipe's own section.
  std::uint32_t flange(const PipeSize& size);
  std::uint32_t gasket(const PipeSize& size);
  /// Where hole k of a flange is; on the grid of `snapped`.
  static std::array<double, 2> hole(const PipeSize& size, int k);

  /// The head below z = 0, the shank above.
  std::uint32_t bolt(double radius, double length);
  std::uint32_t nut(double radius, double room);

  std::uint32_t box(double x, double y, double z);  ///< from the origin
  std::uint32_t h_beam(double side, double length);
  std::uint32_t box_beam(double side, double wall, double length);
  std::uint32_t tray(double width, double length);  ///< a floor with slots in z, y >= 0, walls along it
  /// Centred on the z axis, four holes at (+-at, +-at).
  std::uint32_t base_plate(double side, double thickness, double at, double hole);
  std::uint32_t cylinder(double radius, double length, int sides);
  std::uint32_t bushing(double outer, double inner, double length, int sides);
  std::uint32_t vessel(double radius, double straight, double wall, int sides);  ///< hollow, centred on the origin
  std::uint32_t tank(double x, double y, double z, double wall);  ///< a box with a cavity, from the origin
  std::uint32_t sphere(double radius, double cavity, int sides);  ///< cavity 0: none
  std::uint32_t valve(const PipeSize& size);  ///< body turned about z, a face at either end: 0 and valve_length
  static double valve_length(const PipeSize& size) { return 6 * size.radius; }
  std::uint32_t wheel(double radius, int sides);  ///< a torus about z at z = 0
  std::uint32_t subdivided_of(std::uint32_t mesh);
  std::uint32_t renumbered_of(std::uint32_t mesh);
  std::uint32_t inverted_of(std::uint32_t mesh);

  [[nodiscard]] std::vector<MeshData> take() { return std::move(meshes_); }

 private:
  std::uint32_t made(const std::string& kind, const std::vector<double>& numbers,
                     const std::function<MeshData()>& make);

  std::map<std::pair<std::string, std::vector<double>>, std::uint32_t> known_;
  std::vector<MeshData> meshes_;
};

}  // namespace impinge::scenes
