// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/collide.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <string_view>

#include "broad/may_touch.hpp"
#include "core/guarded.hpp"
#include "core/stopped.hpp"
#include "pipeline/domain_error.hpp"
#include "pipeline/mesh_state.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/options.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/workspace_state.hpp"
#include "scene/placed_block.hpp"
#include "scene/scene_view.hpp"
#include "scene/validate_pose.hpp"

namespace impinge {
namespace {

/// Appends a mesh at each of these poses. Errors: `bad_pose` of the first one that is, with its place where the poses
/// have a name.
Result<void> place_all(const Mesh& mesh, std::span<const Pose> poses, const std::string& name, int threads,
                       Workspace::State& memory) {
  constexpr std::size_t kAtOnce = 512;  // some 50 microseconds' work
  const std::size_t first = memory.placed.size(), chunks = (poses.size() + kAtOnce - 1) / kAtOnce;
  memory.placed.resize(first + poses.size());
  memory.meshes.resize(first + poses.size(), &mesh.state());
  std::atomic<bool> are_valid = true;
  run_each(chunks > 1 ? on_threads(threads) : ForEach(), chunks, [&](std::size_t chunk) {
    const std::size_t end = std::min((chunk + 1) * kAtOnce, poses.size());
    scene::PlacedBlock block;
    for (std::size_t i = chunk * kAtOnce; i < end; i += block.size()) {
      block.clear();
      while (block.size() < std::min(scene::PlacedBlock::kMost, end - i))
        block.add(mesh.state().data, poses[i + block.size()]);
      block.compute();
      for (std::size_t k = 0; k < block.size(); ++k) {
        if (!block.is_valid(k) && !scene::validate(poses[i + k])) {
          are_valid = false;
          return;
        }
        block.write(k, memory.placed[first + i + k]);
        memory.placed[first + i + k].group = 0;
      }
    }
  });
  for (std::size_t i = 0; i < poses.size() && !are_valid; ++i)
    if (auto valid = scene::validate(poses[i]); !valid) {
      if (name.empty()) return valid.error();
      return Error{valid.error().code, name + "[" + std::to_string(i) + "]: " + valid.error().message};
    }
  return {};
}

/// Whether both poses of a block are valid. Errors: `bad_pose`.
Result<void> check(const scene::PlacedBlock& block, const Pose& pose_a, const Pose& pose_b) {
  if (!block.is_valid(0) || !block.is_valid(1))
    for (const Pose* pose : {&pose_a, &pose_b})
      if (auto valid = scene::validate(*pose); !valid) return valid;
  return {};
}

}  // namespace

Result<Contacts> collide(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                         const Options& options, Workspace* workspace) {
  return guarded([&]() -> Result<Contacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    const QueryMemory memory(workspace);
    scene::PlacedBlock block;
    block.add(mesh_a.state().data, pose_a), block.add(mesh_b.state().data, pose_b);
    const bool are_apart = block.compute_apart();
    if (auto valid = check(block, pose_a, pose_b); !valid) return valid.error();
    memory->placed.resize(are_apart ? 0 : 2), memory->pairs.clear();
    for (std::size_t i = 0; i < memory->placed.size(); ++i)
      block.write(i, memory->placed[i]), memory->placed[i].group = 0;
    memory->meshes.assign({&mesh_a.state(), &mesh_b.state()});
    if (!are_apart && broad::bounds_meet(memory->placed[0], memory->placed[1])) memory->pairs.push_back({0, 1});
    return run_pipeline({{memory->placed, nullptr}, memory->meshes, nullptr, &memory->pairs, false, options}, *memory);
  });
}

Result<bool> touches(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                     const std::stop_token& stop, Workspace* workspace) {
  return guarded([&]() -> Result<bool> {
    scene::PlacedBlock block;
    block.add(mesh_a.state().data, pose_a), block.add(mesh_b.state().data, pose_b);
    const bool are_apart = block.compute_apart();
    if (auto valid = check(block, pose_a, pose_b); !valid) return valid.error();
    if (stop.stop_requested()) return cancelled();
    if (are_apart) return false;
    scene::PlacedObject a, b;
    block.write(0, a), block.write(1, b);
    if (!a.in_domain) return not_in_range("object 0");
    if (!b.in_domain) return not_in_range("object 1");
    if (!broad::bounds_meet(a, b)) return false;
    const QueryMemory memory(workspace);
    memory->touch.restart(stop);
    const bool found = memory->touch.find({a, mesh_a.state()}, {b, mesh_b.state()}).has_value();
    if (!found && stop.stop_requested()) return cancelled();
    return found;
  });
}

Result<Contacts> self_collide(const Mesh& mesh, const Pose& pose, const Options& options, Workspace* workspace) {
  return guarded([&]() -> Result<Contacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    const QueryMemory memory(workspace);
    memory->placed.clear(), memory->meshes.clear(), memory->pairs.clear();
    if (auto placed = place_all(mesh, {&pose, 1}, "", 1, *memory); !placed) return placed.error();
    if (mesh.triangle_count() > 0) memory->pairs.push_back({0, 0});
    return run_pipeline({{memory->placed, nullptr}, memory->meshes, nullptr, &memory->pairs, false, options}, *memory);
  });
}

Result<Contacts> collide_poses(const Mesh& mesh_a, std::span<const Pose> poses_a, const Mesh& mesh_b,
                               std::span<const Pose> poses_b, const Options& options, Workspace* workspace) {
  return guarded([&]() -> Result<Contacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    if (poses_a.size() != poses_b.size() && poses_a.size() != 1 && poses_b.size() != 1)
      return Error{Code::bad_option, "there are " + std::to_string(poses_a.size()) + " poses of the first mesh and " +
                                         std::to_string(poses_b.size()) +
                                         " of the second; give as many of both, or one that goes with all"};
    if (poses_a.size() + poses_b.size() > std::numeric_limits<std::int32_t>::max())
      return Error{Code::bad_option, "there are more than 2^31 - 1 poses; ask in parts"};
    const QueryMemory memory(workspace);
    memory->placed.clear(), memory->meshes.clear(), memory->pairs.clear();
    if (auto placed = place_all(mesh_a, poses_a, "poses_a", options.threads, *memory); !placed) return placed.error();
    if (auto placed = place_all(mesh_b, poses_b, "poses_b", options.threads, *memory); !placed) return placed.error();
    const auto count_a = static_cast<std::uint32_t>(poses_a.size()),
               count_b = static_cast<std::uint32_t>(poses_b.size());
    const std::uint32_t rows = std::min(count_a, count_b) == 0 ? 0 : std::max(count_a, count_b);
    const auto pose_of = [](std::uint32_t row, std::uint32_t count) { return count == 1 ? 0 : row; };
    for (std::uint32_t row = 0; row < rows; ++row)
      memory->pairs.push_back({pose_of(row, count_a), count_a + pose_of(row, count_b)});
    auto contacts =
        run_pipeline({{memory->placed, nullptr}, memory->meshes, nullptr, &memory->pairs, true, options}, *memory);
    if (contacts)
      for (auto& [a, b] : contacts->objects) b -= count_a;
    return contacts;
  });
}

}  // namespace impinge
