// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/device_part.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "exact/settle.hpp"
#include "pipeline/fast_stages.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/stage_clock.hpp"

namespace impinge {

/// Pieces whose meshes lie in the same two pages.
struct DevicePart::Batch {
  /// A pair of objects, and the meshes of its first and second tree.
  struct Relation {
    std::uint32_t object_pair;
    const gpu::Resident *a, *b;
  };
  std::uint32_t levels = 0;
  std::vector<Relation> relations;
  std::vector<gpu::WorkItem> items;
};

/// Hits of one pair of objects that are made contacts together.
struct DevicePart::Share {
  static constexpr std::uint32_t kMost = 8192;
  std::uint32_t object_pair;
  std::span<const gpu::Hit> hits;
  std::vector<TrianglePair> unsure;
  std::vector<exact::Contact> contacts;
  std::vector<results::ContactKey> keys;

  void settle(const Query& query, const broad::ObjectPair& objects) {
    const FastStages::Pair pair(query, objects);
    const auto keep = [&](std::uint32_t a, std::uint32_t b, Kind kind) {
      keys.push_back(pair.swapped ? results::contact_key(b, a, kind) : results::contact_key(a, b, kind));
    };
    keys.clear(), unsure.clear(), contacts.clear();
    for (const gpu::Hit& hit : hits) {
      if ((hit.a & gpu::kUnsureBit) != 0) {
        unsure.push_back({hit.a & ~gpu::kUnsureBit, hit.b});
      } else {
        keep(hit.a, hit.b, Kind::crossing);
      }
    }
    (pair.is_outside_exact_domain() ? exact::settle_one_by_one : exact::settle)(*pair.a.mesh, pair.a.pose, *pair.b.mesh,
                                                                                pair.b.pose, unsure, contacts);
    for (const exact::Contact& contact : contacts) keep(contact.a, contact.b, contact.kind);
  }
};

/// Deals pieces into batches, and keeps their meshes on the device for as long as it lives.
class DevicePart::Sorter {
 public:
  using Pages = std::pair<const gpu::Page*, const gpu::Page*>;

  explicit Sorter(DevicePart& part) : part_(part) {}

  /// False if the device cannot take it.
  bool add(const DevicePiece& piece) {
    const broad::ObjectPair& objects = part_.pairs_[piece.object_pair];
    const MeshState *first = part_.query_.meshes[objects.a], *second = part_.query_.meshes[objects.b];
    if (FastStages::Pair::is_swapped(*first, *second)) std::swap(first, second);
    if (first != first_ || second != second_) {
      first_ = first, second_ = second, batch_ = nullptr;
      a_ = resident(*first), b_ = resident(*second);
      if (a_ != nullptr && b_ != nullptr) batch_ = &batches_[{a_->page, b_->page}];
    }
    if (batch_ == nullptr) return false;
    const auto from_a = reference(*a_, piece.nodes.a), from_b = reference(*b_, piece.nodes.b);
    if (!from_a || !from_b) return false;
    Batch& batch = *batch_;
    if (batch.relations.empty() || batch.relations.back().object_pair != piece.object_pair)
      batch.relations.push_back({piece.object_pair, a_, b_});
    batch.levels = std::max({batch.levels, a_->levels, b_->levels});
    batch.items.push_back({*from_a, *from_b, static_cast<gpu::uint>(batch.relations.size() - 1)});
    return true;
  }

  [[nodiscard]] std::map<Pages, Batch>& batches() { return batches_; }

 private:
  const gpu::Resident* resident(const MeshState& mesh) {
    auto found = meshes_.find(&mesh);
    if (found == meshes_.end()) found = meshes_.emplace(&mesh, bring(mesh)).first;
    return found->second ? &**found->second : nullptr;
  }

  std::optional<gpu::MeshStore::Use> bring(const MeshState& mesh) {
    try {
      const bool is_there = part_.opened_->meshes.holds(&mesh.wide_tree);
      std::optional<gpu::MeshStore::Use> use(
          part_.opened_->meshes.use({&mesh.wide_tree, &mesh.data, mesh.weak_from_this()}, part_.for_each_));
      part_.has_brought_meshes_ |= !is_there;
      return use;
    } catch (const gpu::Failure&) {
      if (part_.opened_->device.is_lost()) throw;
      return std::nullopt;
    }
  }

  static std::optional<gpu::uint> reference(const gpu::Resident& mesh, const hierarchy::TreeRef& node) {
    if (!node.is_made()) return mesh.root;
    const auto found =
        std::lower_bound(mesh.places.begin(), mesh.places.end(), std::pair(node.address(), gpu::uint{0}));
    if (found == mesh.places.end() || found->first != node.address()) return std::nullopt;
    return found->second;
  }

  DevicePart& part_;
  std::unordered_map<const MeshState*, std::optional<gpu::MeshStore::Use>> meshes_;
  std::map<Pages, Batch> batches_;
  // Of the last piece: the next one mostly has the same meshes.
  const MeshState *first_ = nullptr, *second_ = nullptr;
  const gpu::Resident *a_ = nullptr, *b_ = nullptr;
  Batch* batch_ = nullptr;
};

DevicePart::DevicePart(const Query& query, const broad::ObjectPairs& pairs, std::shared_ptr<gpu::ReadyDevice> opened)
    : query_(query),
      pairs_(pairs),
      opened_(std::move(opened)),
      first_only_(query.options.find == Options::Find::first),
      for_each_(on_threads(query.options.threads)) {}
DevicePart::~DevicePart() = default;

std::vector<DevicePiece> DevicePart::run(std::span<const DevicePiece> pieces, const Sink& sink,
                                         Statistics& statistics) {
  std::vector<DevicePiece> left;  // each piece once
  // A walk that is left before its end ends here, before the meshes that it reads are let go.
  struct Running {
    std::unique_ptr<gpu::DeviceWalk>& walk;
    bool is_over = false;
    ~Running() {
      if (!is_over) walk.reset();
    }
  };
  auto walk = opened_->take_walk();
  // As many at once as the walk's list takes.
  for (std::size_t begin = 0; begin < pieces.size(); begin += walk->most_items()) {
    const auto some = pieces.subspan(begin, std::min<std::size_t>(pieces.size() - begin, walk->most_items()));
    Sorter sorter(*this);
    Running running{walk};
    StageClock clock;
    const auto left_before = static_cast<std::ptrdiff_t>(left.size());
    for (const DevicePiece& piece : some)
      if (!sorter.add(piece)) left.push_back(piece);
    for (auto& [pages, batch] : sorter.batches()) {
      const std::vector<std::uint32_t> too_far = write(batch, walk->room_for(batch.relations.size()));
      const auto is_too_far = [&](const DevicePiece& piece) {
        return std::binary_search(too_far.begin(), too_far.end(), piece.object_pair);
      };
      left.erase(std::remove_if(left.begin() + left_before, left.end(), is_too_far), left.end());
      std::copy_if(some.begin(), some.end(), std::back_inserter(left), is_too_far);
      if (batch.items.empty()) continue;
      walk->start({batch.items, pages.first, pages.second, batch.levels,
                   first_only_ && (query_.options.kinds & kCrossing) != 0});
      run(batch, *walk, sink, statistics);
      if (query_.options.stop.stop_requested()) return left;
    }
    running.is_over = true;
    clock.charge(statistics.device_seconds);
  }
  opened_->give_back(std::move(walk));
  return left;
}

std::vector<std::uint32_t> DevicePart::write(Batch& batch, const gpu::WalkRelations& to) const {
  constexpr std::size_t kAtOnce = 128;  // some tens of microseconds
  const std::size_t count = batch.relations.size(), chunks = (count + kAtOnce - 1) / kAtOnce;
  std::vector<char> is_too_far(count);
  run_each(for_each_, chunks, [&](std::size_t chunk) {
    for (std::size_t r = chunk * kAtOnce; r < std::min((chunk + 1) * kAtOnce, count); ++r) {
      const auto& [object_pair, a, b] = batch.relations[r];
      const FastStages::Pair pair(query_, pairs_[object_pair]);
      const auto relation = gpu::device_relation(pair.walk.relation, a->extent, b->extent);
      is_too_far[r] = relation ? 0 : 1;
      if (!relation) continue;
      to.relations[r] = *relation;
      if (to.poses.empty()) continue;
      gpu::DevicePoses poses = gpu::device_poses(pair.a.pose, *pair.a.mesh, pair.b.pose, *pair.b.mesh);
      poses.a.first_vertex = a->first[gpu::kVertices], poses.a.first_triangle = a->first[gpu::kTriangles];
      poses.b.first_vertex = b->first[gpu::kVertices], poses.b.first_triangle = b->first[gpu::kTriangles];
      to.poses[r] = poses;
    }
  });
  std::vector<std::uint32_t> too_far;
  for (std::size_t r = 0; r < count; ++r)
    if (is_too_far[r] != 0) too_far.push_back(batch.relations[r].object_pair);
  if (too_far.empty()) return too_far;
  std::erase_if(batch.items, [&](const gpu::WorkItem& item) { return is_too_far[item.pair] != 0; });
  std::sort(too_far.begin(), too_far.end());
  return too_far;
}

std::size_t DevicePart::triangles_to_bring(std::span<const DevicePiece> pieces) const {
  std::size_t triangles = 0;
  std::unordered_set<const MeshState*> seen;
  std::array<const MeshState*, 2> last{};
  for (const DevicePiece& piece : pieces) {
    const auto& [a, b] = pairs_[piece.object_pair];
    const std::array meshes{query_.meshes[a], query_.meshes[b]};
    if (meshes == last) continue;
    last = meshes;
    for (const MeshState* const mesh : meshes) {
      if (seen.insert(mesh).second && !opened_->meshes.holds(&mesh->wide_tree))
        triangles += mesh->data.triangles.size();
    }
  }
  return triangles;
}

void DevicePart::run(const Batch& batch, gpu::DeviceWalk& walk, const Sink& sink, Statistics& statistics) {
  StageClock clock;
  for (bool more = true; more && !query_.options.stop.stop_requested();) {
    clock = StageClock();
    more = walk.advance();  // and the device goes on while its last hits are taken in
    clock.charge(statistics.device_wait_seconds);
    take_in(batch, walk.hits(), sink, statistics);
  }
  statistics.box_tests += walk.work().box_tests;
  statistics.leaf_pairs += walk.work().leaf_pairs;
  statistics.triangle_pairs += walk.work().triangle_pairs;
  statistics.element_tests += walk.work().triangle_pairs;
}

/// By relation, each with its end in `ends_`.
void DevicePart::sort(const Batch& batch, std::span<const gpu::Hit> hits) {
  ends_.assign(batch.relations.size() + 1, 0);
  for (const gpu::Hit& hit : hits)
    if (hit.pair != gpu::kNoHit) ++ends_[hit.pair + 1];
  for (std::size_t i = 1; i < ends_.size(); ++i) ends_[i] += ends_[i - 1];
  sorted_.resize(ends_.back());
  for (const gpu::Hit& hit : hits)
    if (hit.pair != gpu::kNoHit) sorted_[ends_[hit.pair]++] = hit;  // a relation's begin moves to its end
}

void DevicePart::take_in(const Batch& batch, std::span<const gpu::Hit> hits, const Sink& sink, Statistics& statistics) {
  StageClock clock;
  sort(batch, hits);
  std::size_t count = 0;
  for (std::uint32_t r = 0, begin = 0; r < batch.relations.size(); ++r) {
    for (; begin < ends_[r]; ++count) {
      const std::uint32_t size = std::min(ends_[r] - begin, Share::kMost);
      if (count == shares_.size()) shares_.emplace_back();
      shares_[count].object_pair = batch.relations[r].object_pair;
      shares_[count].hits = std::span(sorted_).subspan(begin, size);
      begin += size;
    }
  }
  run_each(for_each_, count, [&](std::size_t i) { shares_[i].settle(query_, pairs_[shares_[i].object_pair]); });
  for (const Share& share : std::span(shares_).first(count)) {
    statistics.exact_calls += share.unsure.size();
    sink(share.object_pair, share.keys);
  }
  clock.charge(statistics.exact_seconds);
}

}  // namespace impinge
