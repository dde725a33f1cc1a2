// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/named_tests/grouping.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

namespace impinge::report {

std::string common_name(const std::vector<std::string>& texts) {
  if (texts.empty()) return {};
  // A number may be cut in two, and before it stands what sets it apart; the 8 of "M8_1" is none of these.
  constexpr std::string_view kDigits = "0123456789", kSeparators = " _-.:#/(";
  const std::string_view first = texts.front();
  std::size_t begins = first.size(), ends = first.size();
  for (const std::string_view text : texts) {
    const auto at_begin = std::mismatch(first.begin(), first.end(), text.begin(), text.end()).first;
    const auto at_end = std::mismatch(first.rbegin(), first.rend(), text.rbegin(), text.rend()).first;
    begins = std::min(begins, static_cast<std::size_t>(at_begin - first.begin()));
    ends = std::min(ends, static_cast<std::size_t>(at_end - first.rbegin()));
  }
  if (begins == first.size()) return std::string(first);
  begins = first.substr(0, begins).find_last_not_of(kDigits) + 1;
  begins = first.substr(0, begins).find_last_not_of(kSeparators) + 1;
  std::string_view end = first.substr(std::max(begins, first.size() - ends));
  end.remove_prefix(std::min(end.find_first_not_of(kDigits), end.size()));
  end.remove_prefix(std::min(end.find_first_not_of(kSeparators), end.size()));
  if (begins == 0 && end.empty()) return std::string(first);
  return std::string(first.substr(0, begins)) + (end.empty() ? "" : "*" + std::string(end));
}

PartTypes types_of(const Assembly& assembly) {
  PartTypes types;
  std::unordered_map<const void*, std::uint32_t> known;
  std::vector<std::vector<std::string>> names;
  for (const io::Object& object : assembly.objects) {
    const auto next = static_cast<std::uint32_t>(names.size());
    const void* const mesh = object.mesh.vertices().data();
    // Meshes without vertices have nothing to be told by.
    const std::uint32_t type = mesh == nullptr ? next : known.try_emplace(mesh, next).first->second;
    if (type == next) names.emplace_back();
    names[type].push_back(object.name);
    types.of_object.push_back(type);
  }
  for (const std::vector<std::string>& of_type : names) types.types.push_back({common_name(of_type), of_type.size()});
  return types;
}

std::vector<PairGroup> groups_of(GroupBy by, const std::vector<Clash>& pairs, const std::vector<std::size_t>& ranked,
                                 const PartTypes& types) {
  using Key = std::pair<std::uint32_t, std::optional<std::uint32_t>>;
  std::vector<PairGroup> groups;
  std::map<Key, std::size_t> known;
  const auto add = [&](const Key& key, std::size_t pair) {
    const auto [place, is_new] = known.try_emplace(key, groups.size());
    if (is_new) groups.push_back({key.first, key.second, {}});
    groups[place->second].pairs.push_back(pair);
  };
  // Worst first: the group with the worst pair is met first.
  for (const std::size_t i : ranked) {
    const auto& [a, b] = pairs[i].objects;
    if (by == GroupBy::part) {
      add({a, std::nullopt}, i), add({b, std::nullopt}, i);
    } else if (by == GroupBy::type) {
      const auto [first, second] = std::minmax(types.of_object[a], types.of_object[b]);
      add({first, second}, i);
    } else if (by == GroupBy::test) {
      add({pairs[i].test, std::nullopt}, i);
    }
  }
  return groups;
}

}  // namespace impinge::report
