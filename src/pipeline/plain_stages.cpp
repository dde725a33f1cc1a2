// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/plain_stages.hpp"

#include "paper/decide.hpp"
#include "paper/scalar.hpp"

namespace impinge {
namespace {

// A slice of work: long enough that clocks and hand-overs do not show, short enough that threads share one large pair.
// One that a device draws is longer, so that it has several batches.
constexpr std::size_t kLeafPairsPerSlice = 64, kLeafPairsPerDrawnSlice = 4096;
constexpr std::uint64_t kBoxTestsPerSlice = 8192, kBoxTestsPerDrawnSlice = 1 << 18;
// A batch is closed when it has so many tests: it stays in cache, and memory stays bounded with large leaves.
constexpr std::size_t kTestsPerBatch = 16384;

paper::PlacedObbTree placed_tree(const Query& query, std::uint32_t object) {
  const scene::PlacedObject& placed = query.view.objects[object];
  return {query.meshes[object]->tree, *placed.mesh, placed.pose};
}

}  // namespace

PlainStages::Pair::Pair(const Query& query, const broad::ObjectPair& objects)
    : walk(placed_tree(query, objects.a), placed_tree(query, objects.b),
           intersection(query.view.objects[objects.a].box, query.view.objects[objects.b].box)),
      placed{*query.view.objects[objects.a].mesh, query.view.objects[objects.a].pose,
             *query.view.objects[objects.b].mesh, query.view.objects[objects.b].pose} {}

void PlainStages::configure(const Options& options, gpu::ReadyDevice* device) {
  first_only_ = options.find == Options::Find::first;
  device_ = device;
  complaint_.clear();
  release();
}

void PlainStages::release() {
  raster_ = nullptr;
  submitted_ = finished_ = 0;
}

/// From here on the CPU tests every batch, those that the device had included.
void PlainStages::give_up(const gpu::Failure& failure) {
  complaint_ = failure.what();
  device_ = nullptr;
  raster_ = nullptr;
}

void PlainStages::take_raster() {
  if (device_ == nullptr || raster_ != nullptr) return;
  try {
    raster_ = device_->take_raster();
  } catch (const gpu::Failure& failure) {
    give_up(failure);
  }
}

void PlainStages::submit(const paper::Batch& batch) {
  ++submitted_;
  if (raster_ == nullptr) return;
  try {
    raster_->submit(batch);
  } catch (const gpu::Failure& failure) {
    give_up(failure);
  }
}

/// The verdicts of a batch's tests, the oldest's of those submitted.
std::span<const paper::Verdict> PlainStages::verdicts_of(const paper::Batch& batch) {
  if (raster_ != nullptr) {
    try {
      return raster_->wait();
    } catch (const gpu::Failure& failure) {
      give_up(failure);
    }
  }
  paper::test_edges(batch, tests_);
  return tests_;
}

void PlainStages::finish_oldest(StageClock& clock, Statistics& statistics) {
  const auto& [object_pair, batch] = work_[finished_ % work_.size()];
  paper::fold(batch, verdicts_of(batch), verdicts_);
  ++finished_;
  clock.charge(statistics.narrow_seconds);

  contacts_.clear();
  statistics.exact_calls += paper::decide(batch, verdicts_, contacts_);
  for (const exact::Contact& contact : contacts_)
    keys_.push_back(results::contact_key(contact.a, contact.b, contact.kind));
  runs_.push_back({object_pair, contacts_.size()});
  clock.charge(statistics.exact_seconds);
}

void PlainStages::run_slice(const Pair& pair, std::uint32_t object_pair, bool fresh, std::vector<Step>& stack,
                            StageClock& clock, Statistics& statistics) {
  take_raster();
  hierarchy::WalkCounts counts;
  leaf_pairs_.clear(), keys_.clear(), runs_.clear();
  if (fresh) pair.walk.start(stack, counts);
  const bool is_drawn = raster_ != nullptr && !first_only_;
  pair.walk.advance(stack, leaf_pairs_, is_drawn ? kLeafPairsPerDrawnSlice : kLeafPairsPerSlice,
                    is_drawn ? kBoxTestsPerDrawnSlice : kBoxTestsPerSlice, counts);
  clock.charge(statistics.hierarchy_seconds);
  statistics.box_tests += counts.box_tests;
  statistics.nodes_built += counts.made.nodes;
  statistics.triangles_sorted += counts.made.triangles;
  statistics.leaf_pairs += leaf_pairs_.size();

  for (auto leaves = leaf_pairs_.begin(); leaves != leaf_pairs_.end();) {
    if (submitted_ - finished_ == work_.size()) finish_oldest(clock, statistics);
    Work& work = work_[submitted_ % work_.size()];
    work.object_pair = object_pair;
    work.batch.clear();
    partitioner_.restart();
    for (; leaves != leaf_pairs_.end() && work.batch.tests.size() < kTestsPerBatch; ++leaves)
      partitioner_.append(*leaves, pair.placed, work.batch);
    clock.charge(statistics.partition_seconds);
    statistics.element_tests += work.batch.tests.size();
    statistics.triangle_pairs += work.batch.pairs.size();
    submit(work.batch);
    clock.charge(statistics.narrow_seconds);
    // The device draws while the CPU goes on. Without one, the batch is still in the CPU's cache.
    while (raster_ == nullptr && is_under_way()) finish_oldest(clock, statistics);
  }
  while (first_only_ && is_under_way()) finish_oldest(clock, statistics);
}

void PlainStages::finish(StageClock& clock, Statistics& statistics) {
  keys_.clear(), runs_.clear();
  while (is_under_way()) finish_oldest(clock, statistics);
  if (raster_ == nullptr) return;
  const paper::RasterCounts drawn = raster_->take_counts();
  statistics.images_drawn += drawn.images_drawn, statistics.images_read += drawn.images_read;
  statistics.images_overlapped += drawn.images_overlapped;
  statistics.device_seconds += drawn.device_seconds, statistics.device_wait_seconds += drawn.wait_seconds;
  device_->give_back(std::move(raster_));
}

}  // namespace impinge
