// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "gpu/kernel.hpp"
#include "gpu/layout.h"
#include "gpu/mesh_store.hpp"

namespace impinge::gpu {

/// The shaders of the whole way: two trees walked together, leaves swept, pairs of triangles filtered.
struct WalkKernels {
  WalkKernels(Device& device, bool doubles);
  const bool with_doubles;  ///< sweeps in them too
  Kernel plan, walk, sweep;
};

/// What is to be walked: pairs of nodes of trees of two pages, of the relations written before.
struct WalkInput {
  std::span<const WorkItem> items;  ///< no more than `most_items`
  const Page *a, *b;
  std::uint32_t levels;  ///< of the deeper tree
  bool first_only;       ///< one crossing a relation is enough
};

/// Memory from which the device takes the relations of a walk. It may be slow to read.
struct WalkRelations {
  std::span<DeviceRelation> relations;
  std::span<DevicePoses> poses;  ///< a relation's; none on a device without doubles
};

struct WalkWork {
  std::uint64_t box_tests = 0, leaf_pairs = 0, triangle_pairs = 0;
};

/// A walk on the device, with the lists that it works on. What does not fit in them is done in a second go, or a tenth:
/// nothing is dropped. One thread uses it at a time; every call may throw a Failure.
class DeviceWalk {
 public:
  DeviceWalk(Device& device, const WalkKernels& kernels);

  [[nodiscard]] std::uint32_t most_items() const { return config_.stack_capacity - config_.stack_reserve; }

  /// Where the caller writes so many relations before `start`.
  [[nodiscard]] WalkRelations room_for(std::size_t relations);
  /// Sends relations and input and starts to work on them.
  void start(const WalkInput& input);
  /// Waits for the work under way, and starts on what it left, if anything: then true.
  bool advance();
  /// What the last part of the work that ended has found; `pair` is kNoHit where there is nothing. Until the next
  /// `advance`.
  [[nodiscard]] std::span<const Hit> hits() const { return hits_; }
  /// Of all parts that ended.
  [[nodiscard]] const WalkWork& work() const { return work_; }

 private:
  [[nodiscard]] std::uint64_t pose_bytes() const { return kernels_.with_doubles ? sizeof(DevicePoses) : 0; }
  void prepare(const WalkInput& input);
  void record(VkCommandBuffer commands, bool is_first);

  Device& device_;
  const WalkKernels& kernels_;
  WalkConfig config_;
  Buffer upload_, upload_items_, relations_, poses_, settled_;
  Buffer control_, read_control_, stack_, leaf_pairs_, again_, hit_buffers_[2];
  Bindings bindings_;
  std::uint64_t item_count_ = 0, relation_count_ = 0;
  std::uint32_t steps_ = 0;
  Control next_{};  ///< what the control block is to be before the next part
  unsigned part_ = 0;
  std::span<const Hit> hits_;
  WalkWork work_;
  Commands commands_;  ///< last: what runs ends before its buffers go
};

}  // namespace impinge::gpu
