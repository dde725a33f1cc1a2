// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "exact/contact.hpp"
#include "impinge/contacts.hpp"
#include "paper/dual_walk.hpp"
#include "paper/partition.hpp"
#include "pipeline/query.hpp"
#include "pipeline/ready_device.hpp"
#include "pipeline/stage_clock.hpp"
#include "results/collector.hpp"

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

  /// `device`: draws the tests, and outlives the query; null: none.
  void configure(const Options& options, gpu::ReadyDevice* device);

  /// The stages, in order, on part of one pair of objects. `fresh`: from the roots. Where a device draws, the last
  /// batches stay under way, and a later call finishes them.
  void run_slice(const Pair& pair, std::uint32_t object_pair, bool fresh, std::vector<Step>& stack, StageClock& clock,
                 Statistics& statistics);
  /// All slices are of one size.
  [[nodiscard]] static bool is_worth_sharing() { return true; }
  static void resume() {}
  /// Finishes what is under way.
  void finish(StageClock& clock, Statistics& statistics);
  /// Forgets what is under way.
  void release();
  /// What the last call finished, by pairs of objects.
  [[nodiscard]] std::span<const results::ContactKey> contacts() const { return keys_; }
  [[nodiscard]] std::span<const results::Run> runs() const { return runs_; }
  /// Why the device was given up since `configure`; empty: it was not.
  [[nodiscard]] const std::string& complaint() const { return complaint_; }

 private:
  /// A batch of tests of one pair of objects.
  struct Work {
    std::uint32_t object_pair = 0;
    paper::Batch batch;
  };
  [[nodiscard]] bool is_under_way() const { return finished_ < submitted_; }
  void take_raster();
  void give_up(const gpu::Failure& failure);
  void submit(const paper::Batch& batch);
  std::span<const paper::Verdict> verdicts_of(const paper::Batch& batch);
  void finish_oldest(StageClock& clock, Statistics& statistics);

  paper::LeafPairs leaf_pairs_;
  paper::Partitioner partitioner_;
  std::array<Work, paper::RasterBackend::kMostBatches> work_;
  std::size_t submitted_ = 0, finished_ = 0;      ///< batches
  std::unique_ptr<paper::RasterBackend> raster_;  ///< draws the tests; null: the CPU does them
  gpu::ReadyDevice* device_ = nullptr;
  bool first_only_ = false;
  std::string complaint_;
  std::vector<paper::Verdict> tests_, verdicts_;
  std::vector<exact::Contact> contacts_;
  std::vector<results::ContactKey> keys_;
  std::vector<results::Run> runs_;
};

}  // namespace impinge
