// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/equal_pairs.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "pipeline/mesh_state.hpp"

namespace impinge {
namespace {

auto place(const Pose& pose) { return std::tie(pose.R, pose.t); }

/// The trees must be equal too: of several nearest points another tree may find another one.
bool are_equal(const Mesh& a, const Mesh& b) {
  const MeshState &p = a.state(), &q = b.state();
  return &p == &q || (p.config.leaf_size == q.config.leaf_size && p.data.vertices == q.data.vertices &&
                      std::ranges::equal(p.data.triangles, q.data.triangles));
}

}  // namespace

std::vector<std::uint32_t> first_equal(const std::vector<Placed>& objects) {
  const auto before = [&](std::uint32_t i, std::uint32_t j) {
    const std::uint64_t p = objects[i].mesh->state().data.hash, q = objects[j].mesh->state().data.hash;
    return p != q ? p < q : place(objects[i].pose) < place(objects[j].pose);
  };
  std::map<std::uint32_t, std::vector<std::uint32_t>, decltype(before)> seen(
      before);  // several in one entry where hashes collide
  std::vector<std::uint32_t> first(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    first[i] = i;
    if (objects[i].mesh == nullptr) continue;
    std::vector<std::uint32_t>& others = seen[i];
    const auto equal = std::find_if(others.begin(), others.end(),
                                    [&](std::uint32_t j) { return are_equal(*objects[i].mesh, *objects[j].mesh); });
    if (equal == others.end())
      others.push_back(i);
    else
      first[i] = *equal;
  }
  return first;
}

EqualPairs group_equal_pairs(const std::vector<std::uint64_t>& pairs, const std::vector<std::uint32_t>& first_equal) {
  std::vector<std::uint64_t> keys;
  keys.reserve(pairs.size());
  for (const std::uint64_t pair : pairs)
    keys.push_back(std::uint64_t{first_equal[pair >> 32]} << 32 | first_equal[static_cast<std::uint32_t>(pair)]);
  EqualPairs equal{{}, std::vector<std::size_t>(pairs.size())};
  std::iota(equal.pairs.begin(), equal.pairs.end(), std::size_t{0});
  std::sort(equal.pairs.begin(), equal.pairs.end(),
            [&](std::size_t i, std::size_t j) { return std::pair(keys[i], i) < std::pair(keys[j], j); });
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (i == 0 || keys[equal.pairs[i]] != keys[equal.pairs[i - 1]]) equal.rows.push_back(i);
  equal.rows.push_back(pairs.size());
  return equal;
}

}  // namespace impinge
