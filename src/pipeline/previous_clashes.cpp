// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/previous_clashes.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace impinge {
namespace {

/// Compares bit by bit: answers are written from the pose, where -0 differs from 0.
bool is_same(const Pose& a, const Pose& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  return std::ranges::equal(a.R, b.R, {}, bits, bits) && std::ranges::equal(a.t, b.t, {}, bits, bits);
}

}  // namespace

ClashMemory::ClashMemory() : state_(std::make_unique<State>()) {}
ClashMemory::~ClashMemory() = default;
ClashMemory::ClashMemory(ClashMemory&&) noexcept = default;
ClashMemory& ClashMemory::operator=(ClashMemory&&) noexcept = default;
std::size_t ClashMemory::known_pairs() const noexcept { return state_->clashes.known_pairs(); }

PreviousClashes::PreviousClashes(const std::vector<Placed>& objects, std::vector<Part> parts,
                                 std::vector<JudgedPair> pairs, const ClashOptions& options)
    : depth_precision_(options.depth_precision),
      regions_(options.regions),
      volumes_(options.volumes),
      parts_(std::move(parts)),
      pairs_(std::move(pairs)) {
  objects_.reserve(objects.size());
  for (const Placed& object : objects)
    objects_.push_back({object.mesh != nullptr ? std::optional(*object.mesh) : std::nullopt, object.pose});
  for (JudgedPair& pair : pairs_) known_pairs_ += std::exchange(pair.is_reused, false);
}

std::vector<Placed> PreviousClashes::forget_changed(const std::vector<Placed>& objects, const ClashOptions& options) {
  if (depth_precision_ != options.depth_precision || regions_ != options.regions || volumes_ != options.volumes)
    pairs_.clear();
  std::vector<Placed> others = objects;
  is_unchanged_.assign(objects.size(), 0);
  for (std::size_t i = 0; i < std::min(objects.size(), objects_.size()); ++i) {
    const PlacedMesh& last = objects_[i];
    const bool is_here = objects[i].mesh != nullptr && last.mesh;
    if (!is_here || &last.mesh->state() != &objects[i].mesh->state() || !is_same(last.pose, objects[i].pose)) continue;
    is_unchanged_[i] = 1;
    others[i].mesh = nullptr;
  }
  return others;
}

void PreviousClashes::move_parts_to(std::vector<Part>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (is_unchanged(i)) parts[i] = std::move(parts_[i]);
}

const JudgedPair* PreviousClashes::find(std::uint64_t objects, const std::vector<ClashTerms>& terms) const {
  if (!is_unchanged(objects >> 32) || !is_unchanged(objects & 0xffffffff)) return nullptr;
  const auto place = std::lower_bound(pairs_.begin(), pairs_.end(), objects,
                                      [](const JudgedPair& pair, std::uint64_t key) { return pair.objects < key; });
  return place != pairs_.end() && place->objects == objects && place->terms == terms ? &*place : nullptr;
}

}  // namespace impinge
