// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/alike.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "pipeline/mesh_state.hpp"

namespace impinge {
namespace {

auto place(const Pose& pose) { return std::tie(pose.R, pose.t); }

/// The same tree too: measures may name another of several nearest points by another tree.
bool are_equal(const Mesh& a, const Mesh& b) {
  const MeshState &p = a.state(), &q = b.state();
  return &p == &q || (p.config.leaf_size == q.config.leaf_size && p.data.vertices == q.data.vertices &&
                      p.data.triangles == q.data.triangles);
}

}  // namespace

std::vector<std::uint32_t> first_alike(const std::vector<Placed>& objects) {
  const auto before = [&](std::uint32_t i, std::uint32_t j) {
    const std::uint64_t p = objects[i].mesh->state().data.hash, q = objects[j].mesh->state().data.hash;
    return p != q ? p < q : place(objects[i].pose) < place(objects[j].pose);
  };
  std::map<std::uint32_t, std::vector<std::uint32_t>, decltype(before)> known(before);  // several where hashes collide
  std::vector<std::uint32_t> first(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    first[i] = i;
    if (objects[i].mesh == nullptr) continue;
    std::vector<std::uint32_t>& others = known[i];
    const auto equal = std::find_if(others.begin(), others.end(),
                                    [&](std::uint32_t j) { return are_equal(*objects[i].mesh, *objects[j].mesh); });
    if (equal == others.end())
      others.push_back(i);
    else
      first[i] = *equal;
  }
  return first;
}

AlikePairs alike_pairs(const std::vector<std::uint64_t>& pairs, const std::vector<std::uint32_t>& first_alike) {
  std::vector<std::uint64_t> things;
  things.reserve(pairs.size());
  for (const std::uint64_t pair : pairs)
    things.push_back(std::uint64_t{first_alike[pair >> 32]} << 32 | first_alike[static_cast<std::uint32_t>(pair)]);
  AlikePairs alike{{}, std::vector<std::size_t>(pairs.size())};
  std::iota(alike.pairs.begin(), alike.pairs.end(), std::size_t{0});
  std::sort(alike.pairs.begin(), alike.pairs.end(),
            [&](std::size_t i, std::size_t j) { return std::pair(things[i], i) < std::pair(things[j], j); });
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (i == 0 || things[alike.pairs[i]] != things[alike.pairs[i - 1]]) alike.rows.push_back(i);
  alike.rows.push_back(pairs.size());
  return alike;
}

}  // namespace impinge
