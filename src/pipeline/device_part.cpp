// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/device_part.hpp"

#include <algorithm>
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
  std::uint32_t levels = 0;
  std::vector<gpu::DeviceRelation> relations;
  std::vector<gpu::DevicePoses> poses;      ///< a relation's; none on a device without doubles
  std::vector<std::uint32_t> object_pairs;  ///< a relation's
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
    (pair.is_fine() ? exact::settle_fine : exact::settle)(*pair.a.mesh, pair.a.pose, *pair.b.mesh, pair.b.pose, unsure,
                                                          contacts);
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
    const FastStages::Pair pair(part_.query_, objects);
    const gpu::MeshStore::Use* const a = mesh_of(pair.swapped ? objects.b : objects.a);
    const gpu::MeshStore::Use* const b = mesh_of(pair.swapped ? objects.a : objects.b);
    if (a == nullptr || b == nullptr) return false;
    const auto from_a = reference(**a, piece.nodes.a), from_b = reference(**b, piece.nodes.b);
    if (!from_a || !from_b) return false;
    Batch& batch = batches_[{(*a)->page, (*b)->page}];
    if (batch.object_pairs.empty() || batch.object_pairs.back() != piece.object_pair) {
      const auto relation = gpu::device_relation(pair.walk.relation, (*a)->extent, (*b)->extent);
      if (!relation) return false;
      batch.relations.push_back(*relation);
      if (part_.opened_->with_doubles) batch.poses.push_back(poses(pair, **a, **b));
      batch.object_pairs.push_back(piece.object_pair);
    }
    batch.levels = std::max({batch.levels, (*a)->levels, (*b)->levels});
    batch.items.push_back({*from_a, *from_b, static_cast<gpu::uint>(batch.relations.size() - 1)});
    return true;
  }

  [[nodiscard]] const std::map<Pages, Batch>& batches() const { return batches_; }

 private:
  const gpu::MeshStore::Use* mesh_of(std::uint32_t object) {
    const MeshState* const mesh = part_.query_.meshes[object];
    auto found = meshes_.find(mesh);
    if (found == meshes_.end()) found = meshes_.emplace(mesh, bring(*mesh)).first;
    return found->second ? &*found->second : nullptr;
  }

  std::optional<gpu::MeshStore::Use> bring(const MeshState& mesh) {
    try {
      return part_.opened_->meshes.use({&mesh.wide_tree, &mesh.data, mesh.weak_from_this()}, part_.for_each_);
    } catch (const gpu::Failure&) {
      if (part_.opened_->device.is_lost()) throw;
      return std::nullopt;
    }
  }

  static gpu::DevicePoses poses(const FastStages::Pair& pair, const gpu::Resident& a, const gpu::Resident& b) {
    gpu::DevicePoses poses = gpu::device_poses(pair.a.pose, *pair.a.mesh, pair.b.pose, *pair.b.mesh);
    const auto set_first = [](const gpu::Resident& mesh, gpu::DevicePose& pose) {
      pose.first_vertex = mesh.first[gpu::kVertices], pose.first_triangle = mesh.first[gpu::kTriangles];
    };
    set_first(a, poses.a), set_first(b, poses.b);
    return poses;
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
  std::vector<DevicePiece> left;
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
    for (const DevicePiece& piece : some)
      if (!sorter.add(piece)) left.push_back(piece);
    for (const auto& [pages, batch] : sorter.batches()) {
      if (batch.items.empty()) continue;
      walk->start({batch.relations, batch.items, pages.first, pages.second, batch.levels,
                   first_only_ && (query_.options.kinds & kCrossing) != 0, batch.poses});
      run(batch, *walk, sink, statistics);
      if (query_.options.stop.stop_requested()) return left;
    }
    running.is_over = true;
    clock.charge(statistics.device_seconds);
  }
  opened_->give_back(std::move(walk));
  return left;
}

std::size_t DevicePart::triangles_to_bring(std::span<const DevicePiece> pieces) const {
  std::size_t triangles = 0;
  std::unordered_set<const MeshState*> seen;
  for (const DevicePiece& piece : pieces) {
    for (const std::uint32_t object : {pairs_[piece.object_pair].a, pairs_[piece.object_pair].b}) {
      const MeshState* const mesh = query_.meshes[object];
      if (seen.insert(mesh).second && !opened_->meshes.holds(&mesh->wide_tree))
        triangles += mesh->data.triangles.size();
    }
  }
  return triangles;
}

void DevicePart::run(const Batch& batch, gpu::DeviceWalk& walk, const Sink& sink, Statistics& statistics) {
  for (bool more = true; more && !query_.options.stop.stop_requested();) {
    more = walk.advance();  // and the device goes on while its last hits are taken in
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
      shares_[count].object_pair = batch.object_pairs[r];
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
