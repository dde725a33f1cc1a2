// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/surface_crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "clash/sheets/around_lines.hpp"
#include "clash/sheets/near_rays.hpp"
#include "clash/sheets/sections.hpp"
#include "core/local_frame.hpp"

/// The exact test (surface_crossing_exact.cpp) with a tolerance: common lines are edges that run near the other part,
/// and the lines in which two triangles cross. Half-planes around them count where they continue beyond the tolerance,
/// along pieces of more than 16 tolerances.
namespace impinge::clash {
namespace {

class NearCrossing {
 public:
  NearCrossing(const std::array<MetSide, 2>& sides, double tolerance, const std::stop_token& stop)
      : a_(sides[0]),
        b_(sides[1]),
        near_(a_.part.body, b_.part.body, tolerance),
        margin_(kReach * tolerance),
        stop_(stop),
        around_(a_.sheets, b_.sheets),
        along_a_(a_, b_),
        along_b_(b_, a_),
        is_open_(a_.sheets.ids.size()) {}

  bool find() {
    if (some_cross() || look_along_edges(a_, true) || look_along_edges(b_, false)) return true;
    around_.join_areas(b_, [&](std::uint32_t i, std::uint32_t j) {
      return !stop_.stop_requested() && near_.share_area(local(a_, i), local(b_, j));
    });
    return around_.pass_at_areas();
  }

  /// Triangles of a of which it is open what they share with b.
  [[nodiscard]] std::vector<std::uint32_t> open_triangles() const {
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < a_.met.size() && !stop_.stop_requested(); ++i)
      if (is_open_[i] || is_open_with_some(i)) open.push_back(a_.sheets.ids[i]);
    return open;
  }

 private:
  /// In tolerances: beyond a line's box, what may still be near a point of it.
  static constexpr double kReach = 4;

  [[nodiscard]] Triangle local(const MetSide& side, std::uint32_t index) const {
    return near_.frame().to_local(side.triangle(index));
  }

  [[nodiscard]] bool is_open_with_some(std::uint32_t i) const {
    return std::any_of(a_.met[i].begin(), a_.met[i].end(),
                       [&](std::uint32_t j) { return near_.is_open(local(a_, i), local(b_, j)); });
  }

  bool some_cross() {
    for (std::uint32_t i = 0; i < a_.met.size(); ++i)
      for (const std::uint32_t j : a_.met[i]) {
        if (stop_.stop_requested()) return false;
        if (near_.cross(local(a_, i), local(b_, j))) return true;
      }
    return false;
  }

  bool look_along_edges(const MetSide& side, bool is_a) {
    const std::vector<Uses> edges = edges_of(side);
    return std::any_of(edges.begin(), edges.end(), [&](const Uses& uses) {
      const Triangle first = side.triangle(uses[0] / 3);
      return !stop_.stop_requested() && look_along(first[uses[0] % 3], first[(uses[0] % 3 + 1) % 3], uses, is_a);
    });
  }

  bool look_along(const Vec3& from, const Vec3& to, const Uses& uses, bool is_a) {
    const auto line = near_.line(near_.frame().to_local(from), near_.frame().to_local(to));
    if (!line) return false;
    const Vec3 margin{margin_, margin_, margin_};
    const Box box{min(from, to) - margin, max(from, to) + margin};
    AlongEdge &along_own = is_a ? along_a_ : along_b_, &along_other = is_a ? along_b_ : along_a_;
    const std::vector<std::uint32_t> other = along_other.find(box, triangles_of(uses));
    std::vector<NearStretch> stretches = stretches_of(*line, other, !is_a);
    if (stretches.empty()) return false;
    std::vector<std::uint32_t> there;
    there.reserve(stretches.size());
    for (const NearStretch& stretch : stretches) there.push_back(stretch.number / 2);
    const std::vector<NearStretch> of_own = stretches_of(*line, along_own.find(box, there), is_a);
    stretches.insert(stretches.end(), of_own.begin(), of_own.end());
    return look_at_sections(*line, stretches);
  }

  struct Piece {
    double lo, hi;
    const NearStretch* stretch;
    bool is_open;  ///< whether the triangle is there
  };

  bool look_at_sections(const NearLine& line, const std::vector<NearStretch>& stretches) {
    std::vector<Piece> pieces;
    for (const NearStretch& s : stretches)
      for (const Piece& piece : {Piece{s.lo, s.surely_lo, &s, true}, Piece{s.surely_lo, s.surely_hi, &s, false},
                                 Piece{s.surely_hi, s.hi, &s, true}})
        if (piece.lo < piece.hi) pieces.push_back(piece);
    bool crosses = false;
    each_section(std::move(pieces), [&](const std::vector<const Piece*>& open, double lo, double hi) {
      if (!near_.is_long(hi - lo) || open.size() < 2) return true;
      std::vector<const NearStretch*> there;
      there.reserve(open.size());
      for (const Piece* const piece : open) there.push_back(piece->stretch);
      if (std::any_of(open.begin(), open.end(), [](const Piece* piece) { return piece->is_open; })) {
        if (std::any_of(open.begin(), open.end(),
                        [](const Piece* piece) { return piece->is_open && piece->stretch->is_beside; }))
          leave_open(there);
        return true;
      }
      const auto rays = near_.rays(line, (lo + hi) / 2, there);
      if (!rays) leave_open(there);
      crosses = rays && around_.look_around(*rays);
      return !crosses;
    });
    return crosses;
  }

  /// The half-planes around a line cannot be told: it runs beside what is near it, in about the tolerance.
  void leave_open(const std::vector<const NearStretch*>& near) {
    for (const NearStretch* const stretch : near)
      if (stretch->number % 2 == 0) is_open_[stretch->number / 2] = true;
  }

  std::vector<NearStretch> stretches_of(const NearLine& line, const std::vector<std::uint32_t>& triangles,
                                        bool of_a) const {
    std::vector<NearStretch> stretches;
    for (const std::uint32_t t : triangles)
      if (const auto stretch = near_.stretch(line, local(of_a ? a_ : b_, t), 2 * t + (of_a ? 0 : 1)))
        stretches.push_back(*stretch);
    return stretches;
  }

  const MetSide &a_, &b_;
  NearGeometry near_;
  double margin_;  ///< in the world
  const std::stop_token& stop_;
  AroundLines around_;
  AlongEdge along_a_, along_b_;
  std::vector<bool> is_open_;  ///< triangles of a
};

}  // namespace

bool surfaces_cross(const solid::Part& a, const solid::Part& b, double tolerance, const ContactPairs& contact_pairs,
                    const std::stop_token& stop) {
  const std::array<MetSide, 2> sides =
      sides_of(a, b, contact_pairs.near, tolerance, contact_pairs.near_a, contact_pairs.near_b);
  NearCrossing crossing(sides, tolerance, stop);
  return crossing.find() || surfaces_cross_widely(a, b, tolerance, contact_pairs, crossing.open_triangles(), stop);
}

}  // namespace impinge::clash
