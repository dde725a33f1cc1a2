// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "impinge/clash.hpp"
#include "report/assembly.hpp"
#include "report/named_tests/configuration.hpp"
#include "report/named_tests/part_sets.hpp"

namespace impinge::report {

/// A named test as it is carried out.
struct PlannedTest {
  std::string name;
  Mode mode = Mode::penetration;
  std::optional<double> tolerance;  ///< nothing: auto
  double clearance = 0;             ///< 0 unless the mode keeps one
  std::string a, b;                 ///< what the groups are, in short; `b` empty: a against itself
  std::uint64_t parts_a = 0, parts_b = 0;
};

/// The tests of a configuration held against an assembly: which pairs of its objects are judged, on what terms, and
/// which of them fail. Without tests, everything is as the options say.
class Plan {
 public:
  Plan() = default;
  /// Errors: `bad_file` (a group without parts, or a test without pairs).
  static Result<Plan> make(const Configuration& configuration, const Assembly& assembly);

  [[nodiscard]] const std::vector<PlannedTest>& tests() const noexcept { return tests_; }

  /// As `ClashOptions::terms`; safe from several threads.
  void terms(std::uint32_t a, std::uint32_t b, std::vector<ClashTerms>& to) const;
  /// The greatest clearance or tolerance of any test.
  [[nodiscard]] double largest_distance() const;

  /// How many pairs of parts near each other each ready rule has left out of a test so far, by the rules' names.
  [[nodiscard]] std::vector<std::pair<std::string_view, std::uint64_t>> left_out(std::uint32_t test) const;

  /// Whether the mode of this test names such a verdict on objects a and b, and it is not allowed by design.
  [[nodiscard]] bool names(std::uint32_t a, std::uint32_t b, std::uint32_t test, Verdict verdict) const;

 private:
  /// Two sets of parts by their columns.
  struct SetPair {
    std::uint32_t a = 0, b = 0;
  };
  /// A ready rule: its sets of parts, and where what it leaves out is counted.
  struct ByDesign {
    std::string_view name;
    SetPair sets;
    std::size_t counter = 0;
  };
  struct Rules {
    bool same_file = false, same_parent = false;
    std::vector<SetPair> ignored;
    std::vector<ByDesign> by_design;
    bool may_touch_all = false;
    std::vector<SetPair> may_touch;
  };
  class Maker;

  [[nodiscard]] bool has(std::uint32_t object, std::uint32_t column) const {
    return (rows_[object * row_words_ + column / 64] >> (column % 64) & 1U) != 0;
  }
  [[nodiscard]] bool is_between(const SetPair& sets, std::uint32_t a, std::uint32_t b) const {
    return (has(a, sets.a) && has(b, sets.b)) || (has(a, sets.b) && has(b, sets.a));
  }
  [[nodiscard]] bool is_in_any(const std::vector<SetPair>& pairs, std::uint32_t a, std::uint32_t b) const;

  std::vector<PlannedTest> tests_;
  std::vector<SetPair> groups_;         ///< of each test
  std::vector<Rules> rules_;            ///< of each test
  std::vector<SetPair> ignored_;        ///< by all
  std::vector<std::uint32_t> files_;    ///< of each object
  std::vector<std::uint32_t> parents_;  ///< of each object; 0: it has none
  std::vector<std::uint64_t> rows_;     ///< for each object a bit for each set
  std::size_t row_words_ = 0;
  std::unique_ptr<std::atomic<std::uint64_t>[]> counters_;
};

}  // namespace impinge::report
