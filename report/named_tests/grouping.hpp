// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "impinge/clash.hpp"
#include "impinge/report.hpp"
#include "report/assembly.hpp"

namespace impinge::report {

/// Parts that are one mesh, placed several times.
struct PartType {
  std::string name;  ///< what their names begin with, without the number that tells them apart
  std::uint64_t parts = 0;
};
struct PartTypes {
  std::vector<PartType> types;  ///< in the order of their first parts
  std::vector<std::uint32_t> of_object;
};
PartTypes types_of(const Assembly& assembly);

/// What the texts have in common at their beginning and end, without digits and separators in between: "bolt M8_1" and
/// "bolt M8_12" are "bolt M8", "P-001 pipe" and "P-002 pipe" are "P*pipe". The first text if that is nothing.
std::string common_name(const std::vector<std::string>& texts);

/// Pairs that belong together.
struct PairGroup {
  std::uint32_t a = 0;             ///< an object, a type or a test
  std::optional<std::uint32_t> b;  ///< of two types, the second
  std::vector<std::size_t> pairs;  ///< worst first
};

/// The pairs in groups, the group with the worst pair first. `ranked` are the pairs' numbers, worst first. By part each
/// pair is in the groups of both.
std::vector<PairGroup> groups_of(GroupBy by, const std::vector<Clash>& pairs, const std::vector<std::size_t>& ranked,
                                 const PartTypes& types);

}  // namespace impinge::report
