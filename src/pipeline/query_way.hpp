// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "pipeline/calibration.hpp"
#include "pipeline/query.hpp"
#include "pipeline/stage_clock.hpp"
#include "pipeline/workspace_state.hpp"
#include "schedule/ways.hpp"

namespace impinge {

/// Who answers one query that may go to a device, and what that tells of the next ones.
class QueryWay {
 public:
  /// The device with backend "gpu", both where the caller says how they share; else who has answered queries of the
  /// same kind most quickly. Of a device that is not open yet `memory.device` is null.
  void choose(const Query& query, const broad::ObjectPairs& pairs, Workspace::State& memory);
  /// The query is over.
  void learn(const Statistics& counts, bool has_brought_meshes);

  [[nodiscard]] schedule::Way way() const { return way_; }
  /// Of all work, what the device is given before the CPU begins; it takes more if there is more left.
  [[nodiscard]] double first_share() const { return first_share_; }

 private:
  [[nodiscard]] schedule::Way quickest(const KnownConstants& known, int threads);

  schedule::Way way_ = schedule::Way::device;
  schedule::Ways* ways_ = nullptr;  ///< of its kind; null: nothing is to be chosen
  StageClock since_choice_{false};
  double first_share_ = 0;
  bool makes_trees_ = false;      ///< its first pair has none yet
  bool is_device_ready_ = false;  ///< open and calibrated when the way was chosen
};

}  // namespace impinge
