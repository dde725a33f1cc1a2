// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/plain_stages.hpp"

#include "paper/decide.hpp"

namespace impinge {
namespace {

// A slice of work: long enough that clocks and hand-overs do not show, short enough that threads share one large pair.
constexpr std::size_t kLeafPairsPerSlice = 64;
constexpr std::uint64_t kBoxTestsPerSlice = 8192;
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

PlainStages::PlainStages() : partitioner_(Partition::automatic), scalar_(paper::make_scalar_backend()) {}

void PlainStages::configure(const Options& options, gpu::ReadyDevice* device) {
  partitioner_ = paper::Partitioner(options.partition);
  first_only_ = options.find == Options::Find::first;
  device_ = device;
  complaint_.clear();
}

/// On the device while there is one; the batch at which it fails is done anew.
void PlainStages::test_batch() {
  if (device_ != nullptr && !batch_.tests.empty()) {
    try {
      std::unique_ptr<paper::RasterBackend> raster = device_->take_raster();
      raster->ask_first(first_only_);
      raster->submit(batch_);
      paper::fold(batch_, raster->wait(), verdicts_);
      device_->give_back(std::move(raster));
      return;
    } catch (const gpu::Failure& failure) {
      complaint_ = failure.what();
      device_ = nullptr;
    }
  }
  scalar_->submit(batch_);
  paper::fold(batch_, scalar_->wait(), verdicts_);
}

void PlainStages::run_slice(const Pair& pair, bool fresh, std::vector<Step>& stack, StageClock& clock,
                            Statistics& statistics) {
  hierarchy::WalkCounts counts;
  leaf_pairs_.clear(), keys_.clear();
  if (fresh) pair.walk.start(stack, counts);
  pair.walk.advance(stack, leaf_pairs_, kLeafPairsPerSlice, kBoxTestsPerSlice, counts);
  clock.charge(statistics.hierarchy_seconds);
  statistics.box_tests += counts.box_tests;
  statistics.nodes_built += counts.made.nodes;
  statistics.triangles_sorted += counts.made.triangles;
  statistics.leaf_pairs += leaf_pairs_.size();

  for (auto leaves = leaf_pairs_.begin(); leaves != leaf_pairs_.end();) {
    batch_.clear();
    partitioner_.restart();
    for (; leaves != leaf_pairs_.end() && batch_.tests.size() < kTestsPerBatch; ++leaves)
      partitioner_.append(*leaves, pair.placed, batch_);
    clock.charge(statistics.partition_seconds);
    statistics.element_tests += batch_.tests.size();
    statistics.triangle_pairs += batch_.pairs.size();

    test_batch();
    clock.charge(statistics.narrow_seconds);

    contacts_.clear();
    statistics.exact_calls += paper::decide(batch_, verdicts_, contacts_);
    for (const exact::Contact& contact : contacts_)
      keys_.push_back(results::contact_key(contact.a, contact.b, contact.kind));
    clock.charge(statistics.exact_seconds);
  }
}

}  // namespace impinge
