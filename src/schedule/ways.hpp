// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "impinge/contacts.hpp"

namespace impinge::schedule {

/// Who answers a query of backend "hybrid".
enum class Way : std::uint8_t { both, cpu, device };
constexpr std::size_t kWays = 3;
/// What each way takes.
using WaySeconds = std::array<double, kWays>;

/// How long queries of one kind took, by the way they went; from this follows the way of the next.
class Ways {
 public:
  /// What the next query should take: as long as earlier ones, or, where a way has not been tried, as `expected`. Not
  /// in proportion to tests of boxes and triangles: the ways differ in how many they need.
  [[nodiscard]] double seconds(Way way, const WaySeconds& expected) const;
  /// The quickest. One that has not been tried counts half of what is expected of it, so that a cost function that is
  /// wrong by a factor of 2 hides none.
  [[nodiscard]] Way quickest(const WaySeconds& expected) const;

  /// A query is over. `is_typical`: it neither made nodes of trees, nor brought meshes to the device, nor opened or
  /// calibrated one, which the next need not do.
  void add(Way way, const Statistics& counts, double seconds, bool is_typical);

  [[nodiscard]] bool is_empty() const { return last_seconds_ == 0; }
  /// The last query's counts of both sides, and its time.
  [[nodiscard]] const Statistics& last() const { return last_; }
  [[nodiscard]] double last_seconds() const { return last_seconds_; }

 private:
  struct Tried {
    double seconds = 0;     ///< a running mean; 0: not tried
    double remembered = 1;  ///< less with each query that went another way
  };
  std::array<Tried, kWays> tried_;
  Statistics last_;
  double last_seconds_ = 0;
};

}  // namespace impinge::schedule
