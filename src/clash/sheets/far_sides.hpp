// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "clash/sheets/edge_pseudonormal.hpp"
#include "clash/sheets/sheets.hpp"
#include "clash/slab.hpp"
#include "core/local_frame.hpp"

namespace impinge::clash {

/// The triangles of one part that are near a triangle of the other.
struct NearTriangles {
  struct Entry {
    Triangle local;
    std::uint32_t piece;
  };
  std::vector<Entry> entries;  ///< where there are several pieces
  std::optional<std::uint32_t> first;
  bool has_several = false;

  /// Of a triangle that is near.
  void note(std::uint32_t piece) {
    has_several |= first && *first != piece;
    first = piece;
  }
};

/// Finds on which sides of a triangle of one surface the other surface continues, farther than the tolerance from all
/// of the first.
class FarSides {
 public:
  FarSides(const solid::Body& a, const solid::Body& b, double tolerance);

  /// Grows the box of what `own` has near the other's triangle, and returns the sides of the triangle on which it goes
  /// on. They are not looked for on those that are `known`.
  std::uint8_t see(const Triangle& own, const PartTriangle& other, bool is_bent, std::uint8_t known, Box& near) const;

  /// Where `own` lies on other pieces of a sheet that branches, and so never far from it: the sides of the triangle on
  /// which it does are added to those of the sheets that the triangle's piece makes with the rest. Sheets that are
  /// `lain` upon are left out: where an area in common ends it is for both to go on, which is not asked here.
  void see_along(const Triangle& own, const PartTriangle& other, std::uint32_t index, const Sheets& sheets,
                 const NearTriangles& near, const std::vector<bool>& lain, SidesSeen& seen) const;

  /// Whether of two triangles that are flat to each other one has some of the other within the tolerance.
  [[nodiscard]] bool lie_along(const Triangle& own, const Triangle& other) const;

  [[nodiscard]] const LocalFrame& frame() const { return frame_; }

  /// A point has no length: what two sheets that meet in one have near each other is longer than the tolerance only as
  /// far as the angle between them is flat.
  [[nodiscard]] bool is_long(const Box& near) const;

 private:
  [[nodiscard]] std::array<HalfSpace, 3> sides_of(const Triangle& t) const;
  [[nodiscard]] Polygon over(Polygon piece, const Triangle& other) const;
  [[nodiscard]] std::uint8_t over(Polygon piece, const Slab& slab, const PartTriangle& other, std::uint8_t known) const;
  [[nodiscard]] std::uint8_t around(const Triangle& own, Slab slab, const PartTriangle& other,
                                    std::uint8_t known) const;
  [[nodiscard]] bool goes_on(const Polygon& piece, const PartTriangle& triangle) const;
  [[nodiscard]] bool is_seen(const Vec3& point, const PartTriangle& triangle) const;
  [[nodiscard]] bool is_at_end(const Vec3& point, const PartTriangle& triangle) const;
  [[nodiscard]] double distance(const Vec3& point, const Triangle& t) const;
  [[nodiscard]] std::vector<std::uint32_t> pieces_at(const Vec3& point, const NearTriangles& near) const;
  [[nodiscard]] bool is_between(const Vec3& point, const PartTriangle& triangle, const std::vector<Sheets::Link>& links,
                                const NearTriangles& near, const std::vector<std::uint32_t>& on) const;

  double tolerance_;
  LocalFrame frame_;
};

}  // namespace impinge::clash
