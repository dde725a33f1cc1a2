// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/mesh_store.hpp"

#include <algorithm>
#include <cstring>

namespace impinge::gpu {
namespace {

/// What is copied at a time.
constexpr std::uint64_t kStaging = std::uint64_t{16} << 20;

std::uint32_t that_fit(std::uint64_t bytes, std::size_t size) { return static_cast<std::uint32_t>(bytes / size); }

}  // namespace

Page::Page(Device& device, std::uint32_t node_count, std::uint32_t leaf_count)
    : nodes(device, std::uint64_t{node_count} * sizeof(DeviceNode), Buffer::Use::device),
      leaves(device, std::uint64_t{leaf_count} * sizeof(DeviceLeaf), Buffer::Use::device),
      free_nodes(node_count),
      free_leaves(leaf_count) {}

MeshStore::Use::~Use() {
  if (store_ == nullptr) return;
  const std::lock_guard lock(store_->mutex_);
  --mesh_->users;
}

MeshStore::Use MeshStore::use(const MeshSource& source, const ForEach& for_each) {
  const std::lock_guard lock(mutex_);
  drop_dead();
  auto found = find(source.tree);
  if (found == meshes_.end()) {
    FlatTree flat = flatten(*source.tree, for_each);
    Resident mesh = place(source, flat);
    meshes_.push_back(std::move(mesh));
    found = std::prev(meshes_.end());
    found->users = 1;  // not to make way for itself
    try {
      upload(flat, *found);
      found->users = 0;
    } catch (...) {
      drop(found);
      throw;
    }
  }
  found->last_use = ++uses_;
  ++found->users;
  return {*this, *found};
}

std::list<Resident>::iterator MeshStore::find(const hierarchy::WideTree* tree) {
  return std::find_if(meshes_.begin(), meshes_.end(), [&](const Resident& mesh) { return mesh.source.tree == tree; });
}

bool MeshStore::holds(const hierarchy::WideTree* tree) {
  const std::lock_guard lock(mutex_);
  drop_dead();
  return find(tree) != meshes_.end();
}

std::size_t MeshStore::size() {
  const std::lock_guard lock(mutex_);
  drop_dead();
  return meshes_.size();
}

bool MeshStore::drop_one() {
  const std::lock_guard lock(mutex_);
  return drop_oldest();
}

void MeshStore::drop(std::list<Resident>::iterator mesh) {
  Page& page = *mesh->page;
  page.free_nodes.give_back(mesh->first_node, mesh->node_count);
  page.free_leaves.give_back(mesh->first_leaf, mesh->leaf_count);
  meshes_.erase(mesh);
  if (page.free_nodes.all_free() && page.free_leaves.all_free())
    pages_.remove_if([&](const Page& other) { return &other == &page; });
}

void MeshStore::drop_dead() {
  for (auto mesh = meshes_.begin(); mesh != meshes_.end();) {
    const auto next = std::next(mesh);
    if (mesh->users == 0 && mesh->source.owner.expired()) drop(mesh);
    mesh = next;
  }
}

bool MeshStore::drop_oldest() {
  auto oldest = meshes_.end();
  for (auto mesh = meshes_.begin(); mesh != meshes_.end(); ++mesh)
    if (mesh->users == 0 && (oldest == meshes_.end() || mesh->last_use < oldest->last_use)) oldest = mesh;
  if (oldest == meshes_.end()) return false;
  drop(oldest);
  return true;
}

template <class Make>
void MeshStore::make_room_for(const Make& make) {
  for (bool done = false; !done;) {
    try {
      make();
      done = true;
    } catch (const Failure& failure) {
      if (failure.result() != VK_ERROR_OUT_OF_DEVICE_MEMORY || !drop_oldest()) throw;
    }
  }
}

bool MeshStore::take_room(Resident& mesh) {
  for (Page& page : pages_) {
    const auto first_node = page.free_nodes.take(mesh.node_count);
    if (!first_node) continue;
    const auto first_leaf = page.free_leaves.take(mesh.leaf_count);
    if (!first_leaf) {
      page.free_nodes.give_back(*first_node, mesh.node_count);
      continue;
    }
    mesh.page = &page, mesh.first_node = *first_node, mesh.first_leaf = *first_leaf;
    return true;
  }
  return false;
}

Resident MeshStore::place(const MeshSource& source, const FlatTree& flat) {
  Resident mesh{.source = source,
                .node_count = std::max<std::uint32_t>(static_cast<std::uint32_t>(flat.nodes.size()), 1),
                .leaf_count = static_cast<std::uint32_t>(flat.leaves.size()),
                .extent = {flat.base, flat.reach},
                .levels = flat.levels};
  const std::uint64_t page = std::min(device_.limits().page, device_.limits().largest_buffer);
  while (!take_room(mesh)) {
    // In a page of leaves, nodes for half as many: a node has two children at least, and mostly eight.
    const std::uint32_t leaves = std::max(that_fit(page, sizeof(DeviceLeaf)), mesh.leaf_count);
    const std::uint32_t nodes = std::max(that_fit(page / 4, sizeof(DeviceNode)), mesh.node_count);
    make_room_for([&] { pages_.emplace_back(device_, nodes, leaves); });
  }
  mesh.root = moved(flat.root, mesh.first_node, mesh.first_leaf);
  mesh.places = flat.places;
  for (auto& [address, reference] : mesh.places) reference = moved(reference, mesh.first_node, mesh.first_leaf);
  return mesh;
}

void MeshStore::upload(FlatTree& flat, const Resident& mesh) {
  for (DeviceNode& node : flat.nodes)
    for (uint lane = 0; lane < node.size; ++lane)
      node.child[lane] = moved(node.child[lane], mesh.first_node, mesh.first_leaf);
  const std::uint64_t bytes = std::max(flat.nodes.size() * sizeof(DeviceNode), flat.leaves.size() * sizeof(DeviceLeaf));
  Buffer staging;
  make_room_for([&] { staging = Buffer(device_, std::min(bytes, kStaging), Buffer::Use::upload); });
  Commands commands(device_);
  const auto send = [&](const void* from, std::uint64_t size, const Buffer& to, std::uint64_t at) {
    for (std::uint64_t sent = 0; sent < size;) {
      const std::uint64_t now = std::min(size - sent, staging.bytes());
      std::memcpy(staging.mapped<char>(), static_cast<const char*>(from) + sent, now);
      commands.start([&](VkCommandBuffer buffer) {
        copy(buffer, staging, 0, to, at + sent, now);
        barrier(buffer);
      });
      commands.wait();
      sent += now;
    }
  };
  send(flat.nodes.data(), flat.nodes.size() * sizeof(DeviceNode), mesh.page->nodes,
       std::uint64_t{mesh.first_node} * sizeof(DeviceNode));
  send(flat.leaves.data(), flat.leaves.size() * sizeof(DeviceLeaf), mesh.page->leaves,
       std::uint64_t{mesh.first_leaf} * sizeof(DeviceLeaf));
}

}  // namespace impinge::gpu
