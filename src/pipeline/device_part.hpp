// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "broad/object_pairs.hpp"
#include "core/for_each.hpp"
#include "exact/contact.hpp"
#include "hierarchy/wide_walk.hpp"
#include "impinge/contacts.hpp"
#include "pipeline/query.hpp"
#include "pipeline/ready_device.hpp"
#include "results/contact_key.hpp"

namespace impinge {

/// A piece of a query: two nodes of a pair of objects, in the order of its walk (FastStages::Pair). Not made: the
/// roots.
struct DevicePiece {
  std::uint32_t object_pair;
  hierarchy::TreeRefPair nodes{};
};

/// The part of a query that a device does: from pairs of nodes to exact contacts. One thread uses it at a time. A
/// gpu::Failure passes, and then what was found is worth nothing.
class DevicePart {
 public:
  /// Takes contacts of one pair of objects, perhaps not all of them at once.
  using Sink = std::function<void(std::uint32_t object_pair, std::span<const results::ContactKey>)>;

  DevicePart(const Query& query, const broad::ObjectPairs& pairs, std::shared_ptr<gpu::ReadyDevice> opened);
  ~DevicePart();
  DevicePart(const DevicePart&) = delete;
  DevicePart& operator=(const DevicePart&) = delete;

  /// Pieces of one pair of objects follow one another. Returns those that the device cannot take: there is no room for
  /// their meshes, or their numbers are beyond its range.
  std::vector<DevicePiece> run(std::span<const DevicePiece> pieces, const Sink& sink, Statistics& statistics);

  /// Of the pieces' meshes that are not on the device yet.
  [[nodiscard]] std::size_t triangles_to_bring(std::span<const DevicePiece> pieces) const;
  /// Whether `run` has brought any.
  [[nodiscard]] bool has_brought_meshes() const { return has_brought_meshes_; }
  [[nodiscard]] const std::shared_ptr<gpu::ReadyDevice>& device() const { return opened_; }

 private:
  class Sorter;
  struct Batch;
  /// Writes what the device is to know of the batch's pairs of objects, and takes those out whose numbers are beyond
  /// its range. Returns these, sorted.
  std::vector<std::uint32_t> write(Batch& batch, const gpu::WalkRelations& to) const;
  void run(const Batch& batch, gpu::DeviceWalk& walk, const Sink& sink, Statistics& statistics);
  void take_in(const Batch& batch, std::span<const gpu::Hit> hits, const Sink& sink, Statistics& statistics);
  void sort(const Batch& batch, std::span<const gpu::Hit> hits);

  const Query& query_;
  const broad::ObjectPairs& pairs_;
  std::shared_ptr<gpu::ReadyDevice> opened_;
  bool first_only_, has_brought_meshes_ = false;
  ForEach for_each_;
  // Scratch of take_in.
  struct Share;
  std::vector<std::uint32_t> ends_;
  std::vector<gpu::Hit> sorted_;
  std::vector<Share> shares_;
};

}  // namespace impinge
