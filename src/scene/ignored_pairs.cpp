// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene/ignored_pairs.hpp"

#include <algorithm>
#include <utility>

namespace impinge::scene {
namespace {

void drop(std::vector<std::uint32_t>& list, std::uint32_t object) {
  list.erase(std::lower_bound(list.begin(), list.end(), object));
}

/// By doubling: reserve alone would grow by one each time.
void make_room(std::vector<std::uint32_t>& list) {
  if (list.size() == list.capacity()) list.reserve(std::max<std::size_t>(2, 2 * list.size()));
}

}  // namespace

void IgnoredPairs::insert(std::uint32_t a, std::uint32_t b) {
  if (is_named(a, b)) return;
  const std::size_t objects = std::size_t{std::max(a, b)} + 1;
  if (objects > partners_.size()) partners_.resize(objects);
  std::vector<std::uint32_t>&of_a = partners_[a], &of_b = partners_[b];
  make_room(of_a), make_room(of_b);
  of_a.insert(std::lower_bound(of_a.begin(), of_a.end(), b), b);
  of_b.insert(std::lower_bound(of_b.begin(), of_b.end(), a), a);
  ++count_;
}

void IgnoredPairs::erase(std::uint32_t a, std::uint32_t b) noexcept {
  if (!is_named(a, b)) return;
  drop(partners_[a], b), drop(partners_[b], a);
  --count_;
}

void IgnoredPairs::set_filter(std::uint32_t object, const Filter& filter) {
  if (object >= filters_.size()) filters_.resize(object + 1);
  filters_[object] = filter;
}

void IgnoredPairs::erase_all_of(std::uint32_t object) noexcept {
  if (object < filters_.size()) filters_[object] = {};
  if (object >= partners_.size()) return;
  const std::vector<std::uint32_t> gone = std::exchange(partners_[object], {});
  for (const std::uint32_t partner : gone) drop(partners_[partner], object);
  count_ -= gone.size();
}

bool IgnoredPairs::contains(std::uint32_t a, std::uint32_t b) const noexcept {
  if (!filters_.empty()) {
    const Filter of_a = filter(a), of_b = filter(b);
    if ((of_a.mask & of_b.category) == 0 || (of_b.mask & of_a.category) == 0) return true;
  }
  return is_named(a, b);
}

bool IgnoredPairs::is_named(std::uint32_t a, std::uint32_t b) const noexcept {
  if (std::max(a, b) >= partners_.size()) return false;
  const bool a_has_fewer = partners_[a].size() < partners_[b].size();
  const std::vector<std::uint32_t>& list = partners_[a_has_fewer ? a : b];
  const std::uint32_t partner = a_has_fewer ? b : a;
  if (list.size() <= 4) return std::find(list.begin(), list.end(), partner) != list.end();  // nearly always
  return std::binary_search(list.begin(), list.end(), partner);
}

}  // namespace impinge::scene
