// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/known_clashes.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace impinge {
namespace {

/// Bit by bit, since -0 is not 0 in what an answer writes out.
bool is_same(const Pose& a, const Pose& b) {
  return std::memcmp(a.R.data(), b.R.data(), sizeof a.R) == 0 && std::memcmp(a.t.data(), b.t.data(), sizeof a.t) == 0;
}

}  // namespace

ClashMemory::ClashMemory() : state_(std::make_unique<State>()) {}
ClashMemory::~ClashMemory() = default;
ClashMemory::ClashMemory(ClashMemory&&) noexcept = default;
ClashMemory& ClashMemory::operator=(ClashMemory&&) noexcept = default;
std::size_t ClashMemory::known_pairs() const noexcept { return state_->clashes.known_pairs(); }

KnownClashes::KnownClashes(const std::vector<Placed>& objects, std::vector<SeenPart> parts,
                           std::vector<JudgedPair> pairs, const ClashOptions& options)
    : tolerance_(options.tolerance),
      depth_(options.depth),
      regions_(options.regions),
      parts_(std::move(parts)),
      pairs_(std::move(pairs)) {
  stands_.reserve(objects.size());
  for (const Placed& object : objects)
    stands_.push_back({object.mesh != nullptr ? std::optional(*object.mesh) : std::nullopt, object.pose});
  for (JudgedPair& pair : pairs_) known_pairs_ += std::exchange(pair.is_known, false);
}

std::vector<Placed> KnownClashes::forget_changed(const std::vector<Placed>& objects, const ClashOptions& options) {
  if (tolerance_ != options.tolerance) *this = {};
  if (depth_ != options.depth || regions_ != options.regions) pairs_.clear();
  std::vector<Placed> others = objects;
  is_known_.assign(objects.size(), 0);
  for (std::size_t i = 0; i < std::min(objects.size(), stands_.size()); ++i) {
    const Stand& stand = stands_[i];
    const bool is_here = objects[i].mesh != nullptr && stand.mesh;
    if (!is_here || &stand.mesh->state() != &objects[i].mesh->state() || !is_same(stand.pose, objects[i].pose))
      continue;
    is_known_[i] = 1;
    others[i].mesh = nullptr;
  }
  return others;
}

std::vector<Box> KnownClashes::boxes(const std::vector<solid::Body>& others) const {
  std::vector<Box> boxes;
  boxes.reserve(others.size());
  for (std::size_t i = 0; i < others.size(); ++i)
    boxes.push_back(is_known(i) ? parts_[i].part().body.box : others[i].box);
  return boxes;
}

void KnownClashes::move_parts_to(std::vector<SeenPart>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (is_known(i)) parts[i] = std::move(parts_[i]);
}

const JudgedPair* KnownClashes::find(std::uint64_t objects, const std::vector<ClashTerms>& terms) const {
  if (!is_known(objects >> 32) || !is_known(objects & 0xffffffff)) return nullptr;
  const auto place = std::lower_bound(pairs_.begin(), pairs_.end(), objects,
                                      [](const JudgedPair& pair, std::uint64_t key) { return pair.objects < key; });
  return place != pairs_.end() && place->objects == objects && place->terms == terms ? &*place : nullptr;
}

}  // namespace impinge
