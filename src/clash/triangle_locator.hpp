// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "clash/contact_pairs.hpp"
#include "clash/local_frame.hpp"
#include "clash/slab.hpp"
#include "measure/nearest.hpp"
#include "solid/cells.hpp"
#include "solid/part.hpp"

namespace impinge::clash {

/// What a search within a tolerance is about.
struct LocatorSettings {
  LocalFrame frame;
  double tolerance;  ///< in the world
  const std::stop_token& stop;
};

/// Where a point is that is not near a part: kInside or kOutside, or kNear if it is on it.
std::uint8_t locate(const solid::Part& part, const Vec3& point);

/// Where triangles lie to another part, to within a tolerance: one after the other is cut into pieces until each is
/// told.
class TriangleLocator {
 public:
  /// In tolerances: pieces of at most this radius are told by distances alone, without slabs.
  static constexpr double kSmall = 4;

  TriangleLocator(const solid::Part& other, const LocatorSettings& space) : other_(other), space_(space) {}

  /// The bits of a triangle (in the world) with all of the other's that are near it; `corners` are those in which some
  /// were left out. Of one whose radius is small none need be given. Nothing if it could not be told.
  std::optional<std::uint8_t> look_at(const Triangle& triangle, std::span<const TrianglePair> near,
                                      const std::array<bool, 3>& corners);

 private:
  /// Of a triangle; or of a corner, about which lie those that were left out.
  struct NearSlab {
    Slab slab;
    std::optional<Triangle> triangle;
  };
  /// How many slabs reached a piece some halvings ago.
  struct Before {
    std::size_t slabs;
    int halvings;
  };
  using SlabIds = std::vector<std::uint32_t>;

  bool make_slabs(const Triangle& own, std::span<const TrianglePair> near, const std::array<bool, 3>& corners);
  [[nodiscard]] bool is_exhausted() const;
  void divide(const Polygon& piece, const SlabIds& slabs, Before before);
  void subtract(Polygon piece, const SlabIds& slabs, std::size_t next);
  void evaluate(const Polygon& piece, const SlabIds& slabs);
  void settle(const Polygon& piece);
  bool is_told(const Polygon& piece, const Vec3& middle, double size);
  bool is_told_by_corners(const Polygon& piece);
  [[nodiscard]] bool is_near(const Polygon& piece, const Triangle& triangle) const;
  [[nodiscard]] bool is_near(const Polygon& piece, std::uint32_t triangle) const;
  [[nodiscard]] std::optional<measure::NearestPoint> nearest(const Vec3& point, double enough) const;
  void locate_at(const Vec3& point) { bits_ |= locate(other_, space_.frame.to_world(point)); }

  const solid::Part& other_;
  const LocatorSettings& space_;
  double tolerance_ = space_.frame.unit * space_.tolerance;  ///< in local units, as what follows
  double most_ = tolerance_ * (1 - 0x1p-16);                 ///< certainly within the tolerance
  std::vector<NearSlab> slabs_;                              ///< of the triangle at work
  std::uint8_t bits_ = 0;
  std::size_t effort_ = 0;
};

}  // namespace impinge::clash
