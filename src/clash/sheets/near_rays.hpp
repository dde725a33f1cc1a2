// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "clash/sheets/around_lines.hpp"
#include "core/local_frame.hpp"
#include "core/shapes.hpp"

/// The order of triangles around a line within a tolerance, in floating point. All lengths are in local units.
namespace impinge::clash {

struct NearLine {
  Vec3 from, along;  ///< `along` of unit length
  double length;
};

/// The piece of a line that is near a triangle. What is near around a point, or where line and triangle part at an
/// angle, is as long as the tolerance allows: of twice that tolerance twice as long. So far the ends are open.
struct NearStretch {
  double lo, hi;                ///< elsewhere it is not near
  double surely_lo, surely_hi;  ///< there it is; empty around a point
  bool is_beside;               ///< nowhere surely, and as long whatever the distance that counts: beside each other
  std::uint32_t number;         ///< as half-planes are numbered
  Triangle triangle;
};

class NearGeometry {
 public:
  NearGeometry(const solid::Body& a, const solid::Body& b, double tolerance)
      : a_(a), b_(b), frame_(local_frame(a.box, b.box)), tolerance_(frame_.unit * tolerance) {}

  [[nodiscard]] const LocalFrame& frame() const { return frame_; }

  /// A point has no length: what is near two sheets that meet in one is longer than the tolerance only as far as the
  /// angle between them is flat.
  [[nodiscard]] bool is_long(double length) const { return length > kLong * tolerance_; }

  /// Nothing if it is not long.
  [[nodiscard]] std::optional<NearLine> line(const Vec3& from, const Vec3& to) const;

  [[nodiscard]] std::optional<NearStretch> stretch(const NearLine& line, const Triangle& triangle,
                                                   std::uint32_t number) const;

  /// Around a point of a line, of the triangles that are near it there: counterclockwise as seen against the line's
  /// direction. What lies within the tolerance of another, as far as the shorter one goes on, is in one ray with it.
  /// Nothing where a triangle is too narrow to be told from a line, or ends so near the line that what it lies beside
  /// or ends on need not be where its surface goes.
  [[nodiscard]] std::optional<std::vector<Ray>> rays(const NearLine& line, double at,
                                                     const std::vector<const NearStretch*>& near) const;

  /// Whether two triangles cross along a line that is long, and go on beyond the tolerance on all four sides.
  [[nodiscard]] bool cross(const Triangle& a, const Triangle& b) const;

  /// Whether it is open what two near triangles share: one is too narrow for rays to be told in it, or they are flush
  /// but for a few tolerances.
  [[nodiscard]] bool is_open(const Triangle& a, const Triangle& b) const;

  /// Whether what one has near the other is long, however it is measured.
  [[nodiscard]] bool share_area(const Triangle& a, const Triangle& b) const;

 private:
  static constexpr double kLong = 16;

  [[nodiscard]] bool ends_on(const Vec3& from, const Vec3& to, const solid::Body& other) const;
  [[nodiscard]] bool is_narrow(const Triangle& triangle) const;
  [[nodiscard]] bool parts_a_little(const Triangle& a, const Triangle& b) const;
  [[nodiscard]] double width_within(const Triangle& a, const Triangle& b, double tolerance) const;

  const solid::Body &a_, &b_;
  LocalFrame frame_;
  double tolerance_;
};

}  // namespace impinge::clash
