// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "assembly.hpp"
#include "impinge/clash.hpp"
#include "part.hpp"

namespace impinge::cli {

/// What `clash` found out.
struct Review {
  Assembly assembly;
  std::vector<Part> parts;         ///< for each object
  Clashes clashes;                 ///< its `parts` are moved to those above
  std::vector<std::string> ids;    ///< for each pair a UUID that it keeps as long as its parts keep their names
  std::size_t split_products = 0;  ///< IFC products of several parts, which were not tested against each other
  double read_seconds = 0, judge_seconds = 0;
};

/// For each object the group within which nothing is tested, 0 for none: its IFC product, but with `--within-products`.
std::vector<std::uint32_t> groups_of(const Assembly& assembly, const ClashArguments& arguments);
/// How many groups have more than one object.
std::size_t count_shared(std::vector<std::uint32_t> groups);

/// The numbers of the pairs, worst first: by verdict; of one verdict the deepest first, then the nearest, then in
/// canonical order.
std::vector<std::size_t> ranked(const std::vector<Clash>& pairs);

/// The greater of the two overlap depths, by the upper end of its interval; 0 where none was measured.
double depth_of(const Clash& pair);

/// Whether `--fail-on` names this pair.
bool fails(const Clash& pair, const FailOn& fail_on);
std::uint64_t count_failing(const std::vector<Clash>& pairs, const FailOn& fail_on);

/// The words of `--fail-on` that are set.
std::vector<std::string> words_of(const FailOn& fail_on);

}  // namespace impinge::cli
