// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "report/comparison/previous.hpp"
#include "report/comparison/standing.hpp"

namespace impinge::report {

/// What people wrote about a pair and its regions. Two are equal only where the same was written at the same places.
struct WrittenRemarks {
  using Place = std::array<double, 3>;

  std::string status, comment;
  std::vector<std::pair<Place, std::pair<std::string, std::string>>> regions;

  [[nodiscard]] bool is_empty() const { return status.empty() && comment.empty() && regions.empty(); }
  bool operator==(const WrittenRemarks&) const = default;
};

WrittenRemarks written_about(const Previous::Pair& pair);
WrittenRemarks written_about(const Resolved& resolved);

/// Of twins, and of what is left of them: the first that something was written about; null: none.
template <typename Past>
const Past* first_written(const std::vector<const Past*>& twins) {
  for (const Past* const twin : twins)
    if (!written_about(*twin).is_empty()) return twin;
  return nullptr;
}

/// Whether all that was written about twins is the same as about this one of them.
template <typename Past>
bool agree(const std::vector<const Past*>& twins, const Past& one) {
  const WrittenRemarks written = written_about(one);
  for (const Past* const twin : twins)
    if (const WrittenRemarks other = written_about(*twin); !other.is_empty() && other != written) return false;
  return true;
}

}  // namespace impinge::report
