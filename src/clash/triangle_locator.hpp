// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "clash/contact_pairs.hpp"
#include "clash/slab.hpp"
#include "core/local_frame.hpp"
#include "measure/nearest.hpp"
#include "solid/cells.hpp"
#include "solid/part.hpp"

namespace impinge::clash {

/// What all searches within one tolerance have in common.
struct LocatorSettings {
  LocalFrame frame;
  double tolerance;  ///< in the world
  const std::stop_token& stop;
};

/// Where a point lies to a part: kInside, kOutside, or kNear if it is on the boundary.
std::uint8_t locate(const solid::Part& part, const Vec3& point);

/// Locates triangles in another part, within a tolerance: cuts each triangle into pieces until every piece is known to
/// be near, inside or outside.
class TriangleLocator {
 public:
  /// Pieces with a radius of at most so many tolerances are located by distances alone, without slabs.
  static constexpr double kSmall = 4;

  TriangleLocator(const solid::Part& other, const LocatorSettings& space) : other_(other), space_(space) {}

  /// The bits of a triangle in world coordinates. `near` are all of the other part's triangles near it, `corners` those
  /// of its corners at which some were left out; for a triangle with a small radius neither is needed. Nothing if the
  /// triangle could not be located.
  std::optional<std::uint8_t> look_at(const Triangle& triangle, std::span<const TrianglePair> near,
                                      const std::array<bool, 3>& corners);

 private:
  /// The slab of a triangle, or of a corner at which triangles were left out.
  struct NearSlab {
    Slab slab;
    std::optional<Triangle> triangle;
  };
  /// The number of slabs that reached a piece some halvings ago.
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
  std::vector<NearSlab> slabs_;                              ///< of the triangle being located
  std::uint8_t bits_ = 0;
  std::size_t effort_ = 0;
};

}  // namespace impinge::clash
