// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/for_each.hpp"
#include "gpu/device.hpp"
#include "gpu/flat_tree.hpp"
#include "gpu/ranges.hpp"
#include "gpu/relation.hpp"

namespace impinge::gpu {

/// A mesh that may be asked for: its tree, and whether it still lives.
struct MeshSource {
  hierarchy::WideTree* tree;        ///< also its name
  const MeshData* data;             ///< lives as long
  std::weak_ptr<const void> owner;  ///< what holds the tree
};

/// What is kept of a mesh: its tree's, and, for devices that have doubles, its own numbers.
enum Part : std::uint8_t { kNodes, kLeaves, kVertices, kTriangles };
constexpr std::size_t kParts = 4;
using PartCounts = std::array<std::uint32_t, kParts>;

/// Memory of the device that meshes share. A walk reads one page for each side.
struct Page {
  Page(Device& device, const PartCounts& counts);
  std::array<Buffer, kParts> buffers;  ///< none for a part of which there is nothing
  std::array<Ranges, kParts> free;
};

/// A mesh on the device.
struct Resident {
  MeshSource source;
  Page* page;
  PartCounts first, count;
  uint root;
  TreeExtent extent;
  std::uint32_t levels;
  std::vector<std::pair<const void*, uint>> places;  ///< FlatTree's
  std::uint64_t last_use;
  std::uint32_t users;
};

/// The meshes on the device: uploaded when first asked for, kept until memory runs short or they die. Safe from many
/// threads.
class MeshStore {
 public:
  MeshStore(Device& device, bool with_doubles) : device_(device), with_doubles_(with_doubles) {}

  /// A mesh that stays where it is while this lives.
  class Use {
   public:
    Use(MeshStore& store, Resident& mesh) : store_(&store), mesh_(&mesh) {}
    ~Use();
    Use(Use&& other) noexcept : store_(std::exchange(other.store_, nullptr)), mesh_(other.mesh_) {}
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    Use& operator=(Use&&) = delete;
    const Resident* operator->() const { return mesh_; }
    const Resident& operator*() const { return *mesh_; }

   private:
    MeshStore* store_;
    Resident* mesh_;
  };

  /// Throws a Failure if there is no room even after all that is not in use has gone.
  Use use(const MeshSource& source, const ForEach& for_each);

  [[nodiscard]] bool holds(const hierarchy::WideTree* tree);
  [[nodiscard]] std::size_t size();
  /// Frees the memory of the mesh that was used longest ago; false if all are in use.
  bool drop_one();

 private:
  std::list<Resident>::iterator find(const hierarchy::WideTree* tree);
  void drop(std::list<Resident>::iterator mesh);
  void drop_dead();
  bool drop_oldest();
  /// Tries again with one mesh less, for as long as the device is out of memory.
  template <class Make>
  void make_room_for(const Make& make);
  Resident place(const MeshSource& source, const FlatTree& flat);
  bool take_room(Resident& mesh);
  static bool take_room(Resident& mesh, Page& page);
  void upload(FlatTree& flat, const Resident& mesh);

  Device& device_;
  const bool with_doubles_;
  std::mutex mutex_;
  std::list<Page> pages_;
  std::list<Resident> meshes_;
  std::uint64_t uses_ = 0;
};

}  // namespace impinge::gpu
