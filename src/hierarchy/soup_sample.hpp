// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace impinge::hierarchy {

/// A stratified sample of at most so many of n places, in ascending order: one at random from each of as many stretches
/// of equal length. Equal steps would alias with the rows and rings that meshes come in. The same places every time.
class SoupSample {
 public:
  SoupSample(std::size_t n, std::uint32_t most)
      : size_(static_cast<std::uint32_t>(std::min<std::size_t>(n, most))), stretch_((std::uint64_t{n} << 32) / size_) {}

  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] std::size_t operator[](std::uint32_t i) const {
    constexpr std::uint32_t kGoldenRatio = 2654435769;
    const std::uint64_t jitter = ((stretch_ - (std::uint64_t{1} << 32)) >> 16) * (i * kGoldenRatio >> 16);
    return (i * stretch_ + jitter) >> 32;
  }

 private:
  std::uint32_t size_;
  std::uint64_t stretch_;  ///< in 2^-32
};

}  // namespace impinge::hierarchy
