// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "impinge/contacts.hpp"
#include "pipeline/fast_stages.hpp"

namespace impinge {

/// Whether two objects share a point, asked again and again by one thread.
class TouchSearch {
 public:
  explicit TouchSearch(std::stop_token stop = {});
  /// When to stop from now on.
  void restart(std::stop_token stop) { stop_ = std::move(stop); }

  /// A pair of triangles of the first and of the second that touch; nothing where there is none, or when asked to stop.
  std::optional<TrianglePair> find(const PlacedMesh& first, const PlacedMesh& second);
  /// Whether these two triangles touch.
  bool is_contact(const PlacedMesh& first, const PlacedMesh& second, const TrianglePair& triangles);

 private:
  std::stop_token stop_;
  FastStages stages_;
  std::vector<FastStages::Step> stack_;
  std::vector<exact::Contact> contacts_;
  StageClock clock_{false};
  Statistics statistics_;
};

}  // namespace impinge
