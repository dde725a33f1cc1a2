// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "review.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace impinge::cli {

std::vector<std::uint32_t> groups_of(const Assembly& assembly, const ClashArguments& arguments) {
  if (arguments.within_products) return std::vector<std::uint32_t>(assembly.objects.size());
  return products_of(assembly);
}

std::size_t count_shared(std::vector<std::uint32_t> groups) {
  std::sort(groups.begin(), groups.end());
  std::size_t count = 0;
  for (std::size_t i = 1; i < groups.size(); ++i) {
    const bool is_second = groups[i] == groups[i - 1] && (i == 1 || groups[i - 2] != groups[i]);
    count += is_second && groups[i] != 0 ? 1 : 0;
  }
  return count;
}

std::vector<std::size_t> ranked(const std::vector<Clash>& pairs) {
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) {
    const double distance = pairs[i].nearest ? pairs[i].nearest->distance : 0;
    return std::tuple(pairs[i].verdict, -depth_of(pairs[i]), distance, pairs[i].objects);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

double depth_of(const Clash& pair) {
  return pair.overlap_depth ? std::max(pair.overlap_depth->a_in_b.hi, pair.overlap_depth->b_in_a.hi) : 0;
}

bool fails(const Clash& pair, const FailOn& fail_on) {
  switch (pair.verdict) {
    case Verdict::duplicate:
    case Verdict::penetrating:
    case Verdict::crossing:
      return fail_on.contact || fail_on.penetration;
    case Verdict::inside:
      return fail_on.contact || fail_on.inside;
    case Verdict::touching:
      return fail_on.contact;
    case Verdict::apart:
      return fail_on.clearance;
  }
  return true;
}

std::uint64_t count_failing(const std::vector<Clash>& pairs, const FailOn& fail_on) {
  return static_cast<std::uint64_t>(
      std::count_if(pairs.begin(), pairs.end(), [&](const Clash& pair) { return fails(pair, fail_on); }));
}

std::vector<std::string> words_of(const FailOn& fail_on) {
  std::vector<std::string> words;
  if (fail_on.contact) words.emplace_back("contact");
  if (fail_on.penetration) words.emplace_back("penetration");
  if (fail_on.inside) words.emplace_back("inside");
  if (fail_on.clearance) words.emplace_back("clearance");
  return words;
}

}  // namespace impinge::cli
