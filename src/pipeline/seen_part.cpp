// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/seen_part.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

#include "clash/local_frame.hpp"
#include "clash/self/self_crossings.hpp"
#include "clash/self/self_flush.hpp"
#include "clash/self/self_passings.hpp"
#include "core/pose.hpp"
#include "impinge/collide.hpp"
#include "pipeline/mesh_state.hpp"
#include "pipeline/on_threads.hpp"
#include "solid/topology.hpp"

namespace impinge {
namespace {

solid::Body body_of(const Mesh& mesh, const Pose& pose) {
  return solid::make_body({&mesh.state().data, &mesh.state().wide_tree, pose});
}

bool before(const TrianglePair& x, const TrianglePair& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); }

/// The pairs of a placed mesh's own triangles that keep it from being a solid, in order.
Result<std::vector<TrianglePair>> list_defects(const Placed& placed, const ClashOptions& options, int threads) {
  const solid::Body body = body_of(*placed.mesh, placed.pose);
  const solid::Topology topology = solid::examine(body);
  const double most = tolerance_of(options, clash::largest_coordinate(body.box));
  const double tolerance = clash::defect_tolerance(body, topology, most);
  std::optional<std::vector<TrianglePair>> flush;
  if (topology.closed && most > 0) flush = clash::self_flush(body, topology, most, options.stop);
  const std::uint8_t kinds = flush ? kCrossing : kCrossing | kCoplanar;
  const auto contacts = collide(*placed.mesh, placed.pose, *placed.mesh, placed.pose,
                                {.kinds = kinds, .threads = threads, .stop = options.stop});
  if (!contacts) return contacts.error();
  std::vector<TrianglePair> defects;
  for (std::size_t i = 0; i < contacts->triangles.size(); ++i) {
    if (options.stop.stop_requested()) return cancelled();
    const TrianglePair& pair = contacts->triangles[i];
    if (pair.a < pair.b &&
        clash::is_defect(body.triangle(pair.a), body.triangle(pair.b), contacts->kinds[i], tolerance))
      defects.push_back(pair);
  }
  if (flush) {
    const std::vector<TrianglePair> crossing = std::exchange(defects, {});
    std::set_union(crossing.begin(), crossing.end(), flush->begin(), flush->end(), std::back_inserter(defects), before);
  }
  if (defects.empty() && topology.closed) defects = clash::self_passings(body, topology, tolerance, options.stop);
  if (options.stop.stop_requested()) return cancelled();
  return defects;
}

/// What is known already is not looked for again.
Result<clash::Defects> find_defects(const Checks::Check& check, const ClashOptions& options, int threads) {
  clash::KnownDefects& known = check.mesh->state().known_defects;
  if (check.is_as_made)
    if (const auto defects = known.find(options.tolerance)) return *defects;
  const auto list = list_defects(check, options, threads);
  if (!list) return list.error();
  clash::Defects defects{list->size()};
  if (!list->empty()) defects.first = list->front();
  if (check.is_as_made) known.keep(options.tolerance, defects);
  return defects;
}

/// Large meshes one after the other, each by all threads; small ones side by side.
Result<std::vector<clash::Defects>> find_all_defects(const std::vector<Checks::Check>& placed,
                                                     const ClashOptions& options) {
  constexpr std::size_t kLarge = 1 << 16;
  const auto is_large = [&](std::size_t i) { return placed[i].mesh->triangle_count() >= kLarge; };
  std::vector<Result<clash::Defects>> found(placed.size(), clash::Defects());
  const auto look_through = [&](std::size_t i, int threads) {
    if (options.stop.stop_requested()) return;
    found[i] = find_defects(placed[i], options, threads);
    Steps(options.progress).step();
  };
  run_each(on_threads(options.threads), placed.size(), [&](std::size_t i) {
    if (!is_large(i)) look_through(i, 1);
  });
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (is_large(i)) look_through(i, options.threads);
  if (options.stop.stop_requested()) return cancelled();
  std::vector<clash::Defects> defects;
  for (const auto& some : found) {
    if (!some) return some.error();
    defects.push_back(*some);
  }
  return defects;
}

SeenPart see(const Placed& placed, solid::Body&& body, const clash::Defects& defects) {
  SeenPart seen{clash::know(std::move(body), defects), {}, {}};
  const solid::Part& part = seen.known.linked.part;
  const auto is_inner = [](const solid::Part::Sides& sides) { return sides.front == sides.back; };
  if (!part.solid || std::none_of(part.sides.begin(), part.sides.end(), is_inner)) return seen;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < part.body.size(); ++t)
    if (part.is_boundary(t))
      triangles.insert(triangles.end(), placed.mesh->triangles()[t].begin(), placed.mesh->triangles()[t].end());
  std::vector<double> xyz;
  for (const Point& vertex : placed.mesh->vertices()) xyz.insert(xyz.end(), {vertex.x, vertex.y, vertex.z});
  seen.boundary = Mesh::create(xyz, triangles).value();
  clash::KnownPart boundary = clash::know(body_of(*seen.boundary, placed.pose), {});
  boundary.facts = seen.known.facts;
  seen.whole = std::move(seen.known.linked.part);
  seen.known = std::move(boundary);
  return seen;
}

}  // namespace

Checks list_checks(const std::vector<Placed>& objects, const ClashOptions& options) {
  Checks checks;
  std::map<const MeshState*, std::size_t> known;
  for (const Placed& object : objects) {
    checks.of_object.push_back(checks.placed.size());
    if (object.mesh == nullptr) continue;
    const MeshState& mesh = object.mesh->state();
    if (options.tolerance.value_or(1) > 0 && in_exact_domain(Pose{}, mesh.data)) {
      const auto [place, is_new] = known.emplace(&mesh, checks.placed.size());
      checks.of_object.back() = place->second;
      if (is_new) checks.placed.push_back({{object.mesh, Pose{}}, true});
    } else {
      checks.placed.push_back({object, false});
    }
  }
  return checks;
}

std::vector<solid::Body> bodies_of(const std::vector<Placed>& objects, int threads) {
  std::vector<solid::Body> bodies(objects.size());
  run_each(on_threads(threads), objects.size(), [&](std::size_t i) {
    if (objects[i].mesh != nullptr) bodies[i] = body_of(*objects[i].mesh, objects[i].pose);
  });
  return bodies;
}

Result<std::vector<SeenPart>> see_all(const std::vector<Placed>& objects, std::vector<solid::Body> bodies,
                                      const Checks& checks, const ClashOptions& options) {
  const auto defects = find_all_defects(checks.placed, options);
  if (!defects) return defects.error();
  std::vector<SeenPart> parts(objects.size());
  run_each(on_threads(options.threads), objects.size(), [&](std::size_t i) {
    if (options.stop.stop_requested()) return;
    if (objects[i].mesh != nullptr) parts[i] = see(objects[i], std::move(bodies[i]), (*defects)[checks.of_object[i]]);
    Steps(options.progress).step();
  });
  if (options.stop.stop_requested()) return cancelled();
  return parts;
}

}  // namespace impinge
