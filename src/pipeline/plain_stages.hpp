// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "exact/contact.hpp"
#include "impinge/contacts.hpp"
#include "paper/backend.hpp"
#include "paper/dual_walk.hpp"
#include "paper/partition.hpp"
#include "pipeline/query.hpp"
#include "pipeline/ready_device.hpp"
#include "pipeline/stage_clock.hpp"
#include "results/contact_key.hpp"

namespace impinge {

/// The stages from hierarchy to exact as the paper has them: binary OBB trees, a uniform grid, streams of edges against
/// triangles. The reference that `FastStages` is held against. One thread uses it at a time.
class PlainStages {
 public:
  /// What remains to be walked is a stack of these.
  using Step = paper::NodePair;

  /// What the stages need of one pair of objects.
  struct Pair {
    Pair(const Query& query, const broad::ObjectPair& objects);
    paper::DualWalk walk;
    paper::PlacedMeshes placed;
  };

  PlainStages();
  /// `device`: draws the tests, and outlives the query; null: none.
  void configure(const Options& options, gpu::ReadyDevice* device);

  /// The stages, in order, on part of one pair of objects. `fresh`: from the roots.
  void run_slice(const Pair& pair, bool fresh, std::vector<Step>& stack, StageClock& clock, Statistics& statistics);
  /// Of the last slice.
  [[nodiscard]] std::span<const results::ContactKey> contacts() const { return keys_; }
  /// Why the device was given up since `configure`; empty: it was not.
  [[nodiscard]] const std::string& complaint() const { return complaint_; }

 private:
  void test_batch();

  paper::LeafPairs leaf_pairs_;
  paper::Partitioner partitioner_;
  paper::Batch batch_;
  std::unique_ptr<paper::Backend> scalar_;
  gpu::ReadyDevice* device_ = nullptr;
  bool first_only_ = false;
  std::string complaint_;
  std::vector<paper::Verdict> verdicts_;
  std::vector<exact::Contact> contacts_;
  std::vector<results::ContactKey> keys_;
};

}  // namespace impinge
