// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "solid/body.hpp"

namespace impinge::solid {

/// Tells for many points whether a body winds around them: a uniform grid over its box that knows it of all points in a
/// cell without triangles. Safe to use from several threads.
class LocationGrid {
 public:
  /// The grid does not keep the body's vertices. The mesh and its tree must outlive it.
  explicit LocationGrid(const Body& body);

  /// Whether the body winds around the point, as by `winding_number`; nothing if the point lies on a triangle.
  [[nodiscard]] std::optional<bool> winds_around(const Vec3& point) const;

 private:
  enum Cell : std::uint8_t { unknown, outside, inside, occupied };
  using Place = std::array<std::size_t, 3>;
  [[nodiscard]] Place place(const Vec3& p) const;
  [[nodiscard]] std::size_t index(const Place& at) const { return (at[0] * size_[1] + at[1]) * size_[2] + at[2]; }
  void occupy(const Body& body);
  void fill(const Place& at, std::vector<Place>& ahead);

  hierarchy::PlacedTree placed_;
  Box box_;
  Place size_{1, 1, 1};
  Vec3 per_length_{};
  std::vector<Cell> cells_;
};

}  // namespace impinge::solid
