// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "impinge/scene.hpp"

namespace impinge::scene {

/// Unordered pairs of objects, by index, that are named one by one or by filters. An object's pairs are forgotten
/// without a look at the others'.
class IgnoredPairs {
 public:
  /// Strong: if memory runs out, nothing has changed.
  void insert(std::uint32_t a, std::uint32_t b);
  void erase(std::uint32_t a, std::uint32_t b) noexcept;
  /// Strong, likewise.
  void set_filter(std::uint32_t object, const Filter& filter);
  void erase_all_of(std::uint32_t object) noexcept;

  [[nodiscard]] bool contains(std::uint32_t a, std::uint32_t b) const noexcept;
  /// Whether there are none for certain.
  [[nodiscard]] bool empty() const noexcept { return count_ == 0 && filters_.empty(); }

 private:
  [[nodiscard]] bool is_named(std::uint32_t a, std::uint32_t b) const noexcept;
  [[nodiscard]] Filter filter(std::uint32_t object) const noexcept {
    return object < filters_.size() ? filters_[object] : Filter{};
  }

  std::vector<Filter> filters_;                       ///< by object, as far as the last that was given one
  std::vector<std::vector<std::uint32_t>> partners_;  ///< by object, sorted; each pair is in both lists
  std::size_t count_ = 0;
};

}  // namespace impinge::scene
