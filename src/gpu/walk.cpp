// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/walk.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "shaders/plan.comp.h"
#include "shaders/sweep.comp.h"
#include "shaders/sweep_doubles.comp.h"
#include "shaders/walk.comp.h"

namespace impinge::gpu {
namespace {

constexpr std::uint32_t kChildren = kDeviceWidth * kDeviceWidth;
/// The most that a sweep finds before it asks for room.
constexpr std::uint32_t kMostHitsAtOnce = kSweptTogether * kTileSize * kTileSize;
/// Levels of the deepest trees (hierarchy/wide_tree.cpp: 20 and log8 of 2^31 triangles, and two for large leaves), each
/// with a reserve in the stack (shaders/plan.comp).
constexpr std::uint32_t kMostLevels = 36;
constexpr std::uint32_t kReserve = kChildren * kMostLevels;
constexpr std::uint32_t kMostSteps = 96;  ///< of a walk in one part
/// Times that a workgroup goes round for more leaf pairs. Each takes about a thousand turns of loops, and llvmpipe ends
/// a shader silently after 65,535. A device that offers as many groups as Vulkan demands goes round once.
constexpr std::uint64_t kMostRounds = 16;

/// What the commands of a walk are.
constexpr VkPipelineStageFlags kKernels =
    VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;

WalkConfig config_of(const Limits& limits) {
  const auto fit = [&](std::uint64_t wanted, std::uint64_t least, std::size_t size) {
    return static_cast<std::uint32_t>(std::max(std::min<std::uint64_t>(wanted, limits.largest_buffer / size), least));
  };
  return {
      .stack_capacity = fit(limits.stack, kReserve + std::uint64_t{2} * kChildren, sizeof(WorkItem)),
      .stack_reserve = kReserve,
      .leaf_capacity = fit(std::min<std::uint64_t>(limits.leaf_pairs, kMostRounds * kGroupSize * limits.most_groups),
                           std::uint64_t{2} * kChildren, sizeof(WorkItem)),
      .hit_capacity = fit(limits.hits, kMostHitsAtOnce, sizeof(Hit)),
      .most_groups = limits.most_groups,
      .first_only = 0,
      .step = 0};
}

Buffer list(Device& device, std::uint32_t items, std::size_t size, Buffer::Use use) {
  return {device, std::uint64_t{items} * size, use};
}

/// A buffer of at least so many bytes; half as much again as before where it must grow.
void grow(Buffer& buffer, Device& device, std::uint64_t bytes, Buffer::Use use) {
  if (buffer.bytes() >= bytes) return;
  const std::uint64_t more = std::min(bytes + bytes / 2, std::max(bytes, device.limits().largest_buffer));
  buffer = Buffer();
  buffer = Buffer(device, more, use);
}

std::span<const std::uint32_t> sweep_shader(bool with_doubles) {
  if (with_doubles) return shader_sweep_doubles_comp;
  return shader_sweep_comp;
}

std::vector<std::uint32_t> sweep_bindings(bool with_doubles) {
  std::vector<std::uint32_t> bindings{kLeavesA, kLeavesB, kRelations, kSettled, kControl, kLeafPairs, kAgain, kHits};
  if (with_doubles) bindings.insert(bindings.end(), {kVerticesA, kVerticesB, kTrianglesA, kTrianglesB, kPoses});
  return bindings;
}

std::uint64_t long_count(std::uint32_t low, std::uint32_t high) { return std::uint64_t{high} << 32 | low; }

}  // namespace

WalkKernels::WalkKernels(Device& device, bool doubles)
    : with_doubles(doubles),
      plan(device, shader_plan_comp, {kControl, kStack}, sizeof(WalkConfig)),
      walk(device, shader_walk_comp,
           {kNodesA, kNodesB, kLeavesA, kLeavesB, kRelations, kSettled, kControl, kStack, kLeafPairs},
           sizeof(WalkConfig)),
      sweep(device, sweep_shader(doubles), sweep_bindings(doubles), sizeof(WalkConfig)) {}

DeviceWalk::DeviceWalk(Device& device, const WalkKernels& kernels)
    : device_(device),
      kernels_(kernels),
      config_(config_of(device.limits())),
      control_(device, sizeof(Control), Buffer::Use::device),
      read_control_(device, sizeof(Control), Buffer::Use::readback),
      stack_(list(device, config_.stack_capacity, sizeof(WorkItem), Buffer::Use::device)),
      leaf_pairs_(list(device, config_.leaf_capacity, sizeof(WorkItem), Buffer::Use::device)),
      again_(list(device, config_.leaf_capacity, sizeof(WorkItem), Buffer::Use::device)),
      hit_buffers_{list(device, config_.hit_capacity, sizeof(Hit), Buffer::Use::readback),
                   list(device, config_.hit_capacity, sizeof(Hit), Buffer::Use::readback)},
      bindings_(device, {&kernels.plan, &kernels.walk, &kernels.sweep}),
      commands_(device) {
  bindings_.set(kControl, control_);
  bindings_.set(kStack, stack_);
  bindings_.set(kLeafPairs, leaf_pairs_);
  bindings_.set(kAgain, again_);
}

WalkRelations DeviceWalk::room_for(std::size_t relations) {
  commands_.wait();  // a walk that was left before its end
  relation_count_ = relations;
  grow(upload_, device_, relations * (sizeof(DeviceRelation) + pose_bytes()), Buffer::Use::upload);
  grow(relations_, device_, relations * sizeof(DeviceRelation), Buffer::Use::device);
  grow(poses_, device_, relations * pose_bytes(), Buffer::Use::device);
  grow(settled_, device_, relations * sizeof(uint), Buffer::Use::device);
  // The poses come first: they have doubles, and a relation is an odd number of words.
  auto* const poses = upload_.mapped<DevicePoses>();
  auto* const after_poses = reinterpret_cast<DeviceRelation*>(upload_.mapped<char>() + relations * pose_bytes());
  return {{after_poses, relations}, {poses, kernels_.with_doubles ? relations : 0}};
}

void DeviceWalk::prepare(const WalkInput& input) {
  if (input.items.size() > most_items()) throw Failure("more is to be walked at once than the device's lists hold");
  grow(upload_items_, device_, input.items.size_bytes(), Buffer::Use::upload);
  std::memcpy(upload_items_.mapped<char>(), input.items.data(), input.items.size_bytes());
  const auto &a = input.a->buffers, &b = input.b->buffers;
  bindings_.set(kNodesA, a[kNodes]), bindings_.set(kNodesB, b[kNodes]);
  bindings_.set(kLeavesA, a[kLeaves]), bindings_.set(kLeavesB, b[kLeaves]);
  bindings_.set(kRelations, relations_), bindings_.set(kSettled, settled_);
  if (!kernels_.with_doubles) return;
  bindings_.set(kVerticesA, a[kVertices]), bindings_.set(kVerticesB, b[kVertices]);
  bindings_.set(kTrianglesA, a[kTriangles]), bindings_.set(kTrianglesB, b[kTriangles]);
  bindings_.set(kPoses, poses_);
}

void DeviceWalk::start(const WalkInput& input) {
  prepare(input);
  item_count_ = input.items.size();
  config_.first_only = input.first_only ? 1 : 0;
  // Breadth first a step takes a level; where the lists are short, or the beginning is broad, a level takes several.
  const std::uint32_t pieces = static_cast<std::uint32_t>(item_count_ / (config_.stack_capacity / (2 * kChildren) + 1));
  steps_ = std::min(input.levels + 1 + pieces, kMostSteps);
  next_ = {};
  next_.steps[0].stack_size = static_cast<uint>(item_count_);
  part_ = 0, hits_ = {}, work_ = {};
  bindings_.set(kHits, hit_buffers_[0]);
  commands_.start([&](VkCommandBuffer commands) { record(commands, true); });
}

bool DeviceWalk::advance() {
  commands_.wait();
  const Control done = *read_control_.mapped<const Control>();
  if (done.swept != done.leaf_pairs) throw Failure("it ended a kernel before its work was done");
  work_.box_tests += long_count(done.box_tests, done.box_tests_high);
  work_.triangle_pairs += long_count(done.triangle_pairs, done.triangle_pairs_high);
  work_.leaf_pairs += done.leaf_pairs - done.again;
  hits_ = {hit_buffers_[part_ % 2].mapped<const Hit>(), std::min(done.hits, config_.hit_capacity)};
  const uint left = done.steps[config_.step].stack_size;
  if (left == 0 && done.again == 0) return false;
  next_ = {};
  next_.steps[0].stack_size = left;
  next_.leaf_pairs = done.again;
  steps_ = kMostSteps;
  ++part_;
  bindings_.set(kHits, hit_buffers_[part_ % 2]);
  commands_.start([&](VkCommandBuffer commands) { record(commands, false); });
  return true;
}

void DeviceWalk::record(VkCommandBuffer commands, bool is_first) {
  config_.step = 0;
  const auto run = [&](const Kernel& kernel, std::size_t groups) {
    kernel.bind(commands, bindings_.of(kernel), &config_);
    vkCmdDispatchIndirect(commands, control_.handle(), config_.step * sizeof(WalkStep) + groups);
    barrier(commands, kKernels);
  };
  const auto plan = [&] {
    run(kernels_.plan, offsetof(WalkStep, plan_groups));
    config_.step = 1 - config_.step;
  };
  if (is_first) {
    const std::uint64_t all_poses = relation_count_ * pose_bytes();
    copy(commands, upload_, 0, poses_, 0, all_poses);
    copy(commands, upload_, all_poses, relations_, 0, relation_count_ * sizeof(DeviceRelation));
    copy(commands, upload_items_, 0, stack_, 0, item_count_ * sizeof(WorkItem));
    vkCmdFillBuffer(commands, settled_.handle(), 0, relation_count_ * sizeof(uint), 0);
  } else {
    copy(commands, again_, 0, leaf_pairs_, 0, next_.leaf_pairs * sizeof(WorkItem));
  }
  std::fill_n(next_.steps[0].plan_groups, 3, 1);
  vkCmdUpdateBuffer(commands, control_.handle(), 0, sizeof next_, &next_);
  barrier(commands, kKernels);
  plan();
  for (std::uint32_t step = 0; step < steps_; ++step) {
    run(kernels_.walk, offsetof(WalkStep, walk_groups));
    plan();
  }
  run(kernels_.sweep, offsetof(WalkStep, sweep_groups));
  copy(commands, control_, 0, read_control_, 0, sizeof(Control));
  hand_to_host(commands);
}

}  // namespace impinge::gpu
