// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "scenes/plant.hpp"
#include "scenes/plant_parts.hpp"
#include "scenes/random.hpp"

/// The bays of a plant (plant.hpp says what is in them), each in a frame of its own.
namespace impinge::scenes {

/// Where a mesh's z axis goes. Exact turns, of which `along_x` takes (x, y, z) to (z, x, y), `against_x` to (-z, x,
/// -y), `along_y` to (-x, z, y), `down` to (x, -y, -z).
enum class Turn { upright, along_x, against_x, along_y, down };

struct BayPart {
  std::uint32_t mesh;
  Turn turn;
  std::array<double, 3> at;
  std::string_view code, kind;  ///< for its name: "FL" and "flange"
};

/// A bay that is being built. The verdicts planted between its parts are said where the parts are put.
class Bay {
 public:
  using Place = std::array<double, 3>;
  Bay(Catalogue& of, Random& by) : catalogue(of), random(by) {}

  std::uint32_t put(std::string_view code, std::string_view kind, std::uint32_t mesh, Turn turn, const Place& at);
  void touching(std::uint32_t i, std::uint32_t j, std::string_view family);
  void penetrating(std::uint32_t i, std::uint32_t j, std::string_view family);
  void duplicate(std::uint32_t i, std::uint32_t j, std::string_view family);
  void inside(std::uint32_t inner, std::uint32_t outer, std::string_view family);
  void near(std::uint32_t i, std::uint32_t j, const Interval& distance, std::string_view family);
  /// By an exact gap between faces: below 0 they penetrate, at 0 touch, below the clearance are near. No other gap is
  /// nearer than 1 mm to 0 or than 2 mm to the clearance.
  void by_gap(std::uint32_t i, std::uint32_t j, double gap, std::string_view family);

  /// A gap that is negative, none, near or wide, in equal shares; a multiple of 1/8.
  double any_gap();
  /// In [low, high], a multiple of 1/8.
  double length(double low, double high);

  Catalogue& catalogue;
  Random& random;
  std::vector<BayPart> parts;
  std::vector<PlantPair> pairs;  ///< of indices into `parts`

 private:
  void expect(std::uint32_t i, std::uint32_t j, PlantPair pair);
};

/// The distance of two round walls about one axis, of circumradius `inner` and `outer`: the shank in its hole.
Interval radial_gap(double inner, double outer, int outer_sides);

void line_bay(Bay& bay);
void rack_bay(Bay& bay);
void frame_bay(Bay& bay);
void vessel_bay(Bay& bay);
void cells_bay(Bay& bay);
/// `count` parts, at most kStoreParts.
inline constexpr int kStoreParts = 36;
void store_bay(Bay& bay, int count);

}  // namespace impinge::scenes
