// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "impinge/contacts.hpp"
#include "pipeline/fast_stages.hpp"

namespace impinge {

/// Whether two objects share a point, asked again and again by one thread; and how that thread begins a query about
/// one pair.
class TouchSearch {
 public:
  explicit TouchSearch(std::stop_token stop = {}) : stop_(std::move(stop)) {}
  /// When to stop from now on.
  void restart(std::stop_token stop) { stop_ = std::move(stop); }
  [[nodiscard]] bool is_stopped() const { return stop_.stop_requested(); }

  /// A pair of triangles of the first and of the second that touch; nothing where there is none, or when asked to stop.
  std::optional<TrianglePair> find(const PlacedMesh& first, const PlacedMesh& second);

  /// Slices of work until one gives wanted contacts, nothing is left, the rest is worth sharing between the options'
  /// threads, or their stop is heard. Adds to the counts.
  void begin(const FastStages::Pair& pair, const Options& options, StageClock clock, Statistics& counts);
  /// What that found, in its last slice; nothing where it was stopped before the first.
  [[nodiscard]] std::span<const results::ContactKey> contacts() const { return stages_.contacts(); }
  /// What is left then, for whoever goes on.
  [[nodiscard]] std::vector<FastStages::Step>& left() { return stack_; }

  /// Whether these two triangles touch.
  bool is_contact(const PlacedMesh& first, const PlacedMesh& second, const TrianglePair& triangles);

 private:
  void run_slices(const FastStages::Pair& pair, bool may_share, const std::stop_token& stop, StageClock& clock,
                  Statistics& counts);

  std::stop_token stop_;
  FastStages stages_;
  std::vector<FastStages::Step> stack_;
  std::vector<exact::Contact> contacts_;
  StageClock clock_{false};
  Statistics statistics_;
};

}  // namespace impinge
