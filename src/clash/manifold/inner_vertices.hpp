// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "clash/manifold/touch.hpp"

namespace impinge::clash {

/// Marks some of n things, and forgets all marks at once.
class Marks {
 public:
  void restart(std::size_t n) {
    if (++round_ == 0) std::fill(marked_.begin(), marked_.end(), 0), round_ = 1;
    if (marked_.size() < n) marked_.resize(n, 0);
  }
  [[nodiscard]] bool has(std::size_t i) const { return marked_[i] == round_; }
  /// False if it was marked before.
  bool add(std::size_t i) { return std::exchange(marked_[i], round_) != round_; }

 private:
  std::vector<std::uint32_t> marked_;
  std::uint32_t round_ = 0;
};

/// The vertices of each surface that lie inside the other, region by region. The patches that contours bound are walked
/// from vertices of the triangles that cross, over triangles without contact: what lies in the other surface is in
/// contact, so that none of them leads out of it.
class InnerVertices {
 public:
  /// `touches` are sorted by a and then b, and have their regions.
  void restart(const std::array<PlacedSurface, 2>& surfaces, std::span<const Touch> touches);
  /// In the local frame; valid until the next call for this side.
  std::span<const Vec3> patch(std::uint32_t region, int side);

 private:
  struct Seed {
    std::uint32_t region;
    int side;
    std::uint32_t vertex;
    friend auto operator<=>(const Seed&, const Seed&) = default;
  };
  void find_seeds(int side, std::span<const std::uint32_t> of_one_triangle);

  std::array<PlacedSurface, 2> surfaces_{};
  std::span<const Touch> touches_;
  std::vector<std::uint32_t> order_;
  std::vector<Seed> seeds_;
  std::array<Marks, 2> in_contact_;  ///< triangles
  Marks seen_;                       ///< positions
  std::vector<std::uint32_t> ahead_;
  std::array<std::vector<Vec3>, 2> found_;
};

}  // namespace impinge::clash
