// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/mesh_store.hpp"

#include <algorithm>
#include <cstring>

namespace impinge::gpu {
namespace {

/// Bytes that are copied at a time.
constexpr std::uint64_t kStaging = std::uint64_t{16} << 20;

/// Bytes of one element of each part.
constexpr std::array<std::uint64_t, kParts> kSizes{sizeof(DeviceNode), sizeof(DeviceLeaf), sizeof(Vec3),
                                                   sizeof(MeshData::triangles[0])};
static_assert(kSizes[kVertices] == 3 * sizeof(double) && kSizes[kTriangles] == 3 * sizeof(uint));
/// In a page of leaves, nodes for half as many: a node has two children at least, and mostly eight. Triangles for
/// leaves that are all but full, and half as many vertices.
constexpr std::array<std::uint64_t, kParts> kShares{4, 1, 4, 4};  // one over these, of a page's bytes

}  // namespace

Page::Page(Device& device, const PartCounts& counts)
    : free{Ranges(counts[0]), Ranges(counts[1]), Ranges(counts[2]), Ranges(counts[3])} {
  for (std::size_t part = 0; part < kParts; ++part)
    if (counts[part] > 0) buffers[part] = Buffer(device, counts[part] * kSizes[part], Buffer::Use::device);
}

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
  for (std::size_t part = 0; part < kParts; ++part) page.free[part].give_back(mesh->first[part], mesh->count[part]);
  meshes_.erase(mesh);
  if (std::all_of(page.free.begin(), page.free.end(), [](const Ranges& free) { return free.all_free(); }))
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

bool MeshStore::take_room(Resident& mesh, Page& page) {
  for (std::size_t part = 0; part < kParts; ++part) {
    const auto first = page.free[part].take(mesh.count[part]);
    if (!first) {
      while (part-- > 0) page.free[part].give_back(mesh.first[part], mesh.count[part]);
      return false;
    }
    mesh.first[part] = *first;
  }
  mesh.page = &page;
  return true;
}

bool MeshStore::take_room(Resident& mesh) {
  return std::any_of(pages_.begin(), pages_.end(), [&](Page& page) { return take_room(mesh, page); });
}

Resident MeshStore::place(const MeshSource& source, const FlatTree& flat) {
  const auto count = [](const auto& elements) { return static_cast<std::uint32_t>(elements.size()); };
  Resident mesh{.source = source, .count = {}, .extent = {flat.base, flat.reach}, .levels = flat.levels};
  mesh.count = {std::max(count(flat.nodes), 1u), count(flat.leaves), 0, 0};
  if (with_doubles_)
    mesh.count[kVertices] = count(source.data->vertices), mesh.count[kTriangles] = count(source.data->triangles);
  const std::uint64_t page = std::min(device_.limits().page, device_.limits().largest_buffer);
  while (!take_room(mesh)) {
    PartCounts counts{};
    for (std::size_t part = 0; part < kParts; ++part)
      if (mesh.count[part] > 0)
        counts[part] = std::max(static_cast<std::uint32_t>(page / kShares[part] / kSizes[part]), mesh.count[part]);
    make_room_for([&] { pages_.emplace_back(device_, counts); });
  }
  mesh.root = moved(flat.root, mesh.first[kNodes], mesh.first[kLeaves]);
  mesh.places = flat.places;
  for (auto& [address, reference] : mesh.places) reference = moved(reference, mesh.first[kNodes], mesh.first[kLeaves]);
  return mesh;
}

void MeshStore::upload(FlatTree& flat, const Resident& mesh) {
  for (DeviceNode& node : flat.nodes)
    for (uint lane = 0; lane < node.size; ++lane)
      node.child[lane] = moved(node.child[lane], mesh.first[kNodes], mesh.first[kLeaves]);
  const MeshData& data = *mesh.source.data;
  const std::array<const void*, kParts> from{flat.nodes.data(), flat.leaves.data(), data.vertices.data(),
                                             data.triangles.data()};
  PartCounts count = mesh.count;
  count[kNodes] = static_cast<std::uint32_t>(flat.nodes.size());
  std::uint64_t bytes = 0;
  for (std::size_t part = 0; part < kParts; ++part) bytes = std::max(bytes, count[part] * kSizes[part]);
  Buffer staging;
  make_room_for([&] { staging = Buffer(device_, std::min(bytes, kStaging), Buffer::Use::upload); });
  Commands commands(device_);
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::uint64_t size = count[part] * kSizes[part], at = mesh.first[part] * kSizes[part];
    for (std::uint64_t sent = 0; sent < size;) {
      const std::uint64_t now = std::min(size - sent, staging.bytes());
      std::memcpy(staging.mapped<char>(), static_cast<const char*>(from[part]) + sent, now);
      commands.start([&](VkCommandBuffer buffer) {
        copy(buffer, staging, 0, mesh.page->buffers[part], at + sent, now);
        barrier(buffer);
      });
      commands.wait();
      sent += now;
    }
  }
}

}  // namespace impinge::gpu
