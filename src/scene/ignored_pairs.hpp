// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace impinge::scene {

/// Unordered pairs of objects, by index. An object's pairs are forgotten without a look at the others'.
class IgnoredPairs {
 public:
  /// Strong: if memory runs out, nothing has changed.
  void insert(std::uint32_t a, std::uint32_t b);
  void erase(std::uint32_t a, std::uint32_t b) noexcept;
  void erase_all_of(std::uint32_t object) noexcept;

  [[nodiscard]] bool contains(std::uint32_t a, std::uint32_t b) const noexcept;
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }

 private:
  std::vector<std::vector<std::uint32_t>> partners_;  ///< by object, sorted; each pair is in both lists
  std::size_t count_ = 0;
};

}  // namespace impinge::scene
