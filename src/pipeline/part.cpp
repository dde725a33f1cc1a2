// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/part.hpp"

#include <algorithm>
#include <map>

#include "pipeline/mesh_state.hpp"
#include "pipeline/on_threads.hpp"
#include "solid/topology.hpp"

namespace impinge {
namespace {

/// The meshes of some objects, each once.
std::vector<const Mesh*> meshes_of(const std::vector<Placed>& objects) {
  std::map<const MeshState*, const Mesh*> known;
  std::vector<const Mesh*> meshes;
  for (const Placed& object : objects)
    if (object.mesh != nullptr && known.emplace(&object.mesh->state(), object.mesh).second)
      meshes.push_back(object.mesh);
  return meshes;
}

/// Finds the pieces of large meshes one after the other, each by all threads, and of small ones side by side.
Result<void> find_pieces(const std::vector<const Mesh*>& meshes, const ClashOptions& options) {
  constexpr std::size_t kLargeMesh = 1 << 16;
  const auto is_large = [&](std::size_t i) { return meshes[i]->triangle_count() >= kLargeMesh; };
  std::vector<Result<void>> found(meshes.size());
  const auto search = [&](std::size_t i, int threads) {
    if (options.stop.stop_requested()) return;
    if (const auto pieces = pieces_of(*meshes[i], threads, options.stop); !pieces) found[i] = pieces.error();
    Steps(options.progress).step();
  };
  run_each(on_threads(options.threads), meshes.size(), [&](std::size_t i) {
    if (!is_large(i)) search(i, 1);
  });
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (is_large(i)) search(i, options.threads);
  if (options.stop.stop_requested()) return cancelled();
  for (const Result<void>& one : found)
    if (!one) return one.error();
  return {};
}

Result<Part> make_part(const Placed& object, const solid::Body& body, const std::stop_token& stop) {
  const auto pieces = pieces_of(*object.mesh, 1, stop);
  if (!pieces) return pieces.error();
  Part part;
  part.mesh = *object.mesh, part.pose = object.pose, part.found = *pieces;
  part.placed = placed_in_pieces(*part.found, body), part.rounding = rounding_of(body);
  part.facts = part.found->facts;
  const auto segment = [&](const std::array<std::uint32_t, 2>& edge) {
    return Segment{body.world[edge[0]], body.world[edge[1]]};
  };
  if (part.found->open_edge) part.facts.open_edge = segment(*part.found->open_edge);
  if (part.found->unclear_edge) part.facts.unclear_edge = segment(*part.found->unclear_edge);
  return part;
}

}  // namespace

const ExactPart& Part::exact(const std::stop_token& stop) const {
  return exact_.get([&] {
    const Mesh& boundary = found->boundary ? *found->boundary : *mesh;
    solid::Body body = found->boundary ? solid::make_body(boundary.state().placed(pose)) : placed.whole;
    solid::Topology topology = solid::examine(body);
    bool is_plain = topology.closed;
    if (is_plain) {
      const auto meets = meets_itself(boundary, body, stop);
      is_plain = meets.has_value() && !meets.value();
    }
    return ExactPart{solid::make_part(std::move(body), std::move(topology), is_plain), is_plain};
  });
}

const solid::Part& Part::whole() const {
  return whole_.get([&] { return solid::make_part(placed.whole); });
}

std::vector<solid::Body> bodies_of(const std::vector<Placed>& objects, int threads) {
  std::vector<solid::Body> bodies(objects.size());
  run_each(on_threads(threads), objects.size(), [&](std::size_t i) {
    if (objects[i].mesh != nullptr) bodies[i] = solid::make_body(objects[i].mesh->state().placed(objects[i].pose));
  });
  return bodies;
}

double rounding_of(const solid::Body& body) {
  if (body.size() == 0) return 0;
  const double diagonal = norm(body.box.hi - body.box.lo);
  if (body.placed.mesh->precision != Precision::single) return 0x1p-20 * diagonal;
  const auto& t = body.placed.pose.t;
  const double largest =
      std::max({max_component(body.placed.mesh->max_abs), std::abs(t[0]), std::abs(t[1]), std::abs(t[2])});
  return 0x1p-20 * diagonal + 0x1p-22 * largest;
}

std::uint64_t steps_of_parts(const std::vector<Placed>& objects) { return meshes_of(objects).size() + objects.size(); }

Result<std::vector<Part>> make_parts(const std::vector<Placed>& objects, std::vector<solid::Body> bodies,
                                     const ClashOptions& options) {
  if (auto found = find_pieces(meshes_of(objects), options); !found) return found.error();
  std::vector<Part> parts(objects.size());
  run_each(on_threads(options.threads), objects.size(), [&](std::size_t i) {
    if (options.stop.stop_requested()) return;
    if (objects[i].mesh != nullptr)
      if (auto part = make_part(objects[i], bodies[i], options.stop)) parts[i] = *std::move(part);
    Steps(options.progress).step();
  });
  if (options.stop.stop_requested()) return cancelled();
  return parts;
}

}  // namespace impinge
