// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/part.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

#include "clash/self/self_crossings.hpp"
#include "clash/self/self_edge_crossings.hpp"
#include "clash/self/self_flush.hpp"
#include "core/local_frame.hpp"
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
Result<std::vector<TrianglePair>> list_defects(const Placed& placed, const solid::Body& body,
                                               const solid::Topology& topology, const ClashOptions& options,
                                               int threads) {
  const double most = tolerance_of(options, largest_coordinate(body.box));
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
  if (defects.empty() && topology.closed) defects = clash::self_edge_crossings(body, topology, tolerance, options.stop);
  if (options.stop.stop_requested()) return cancelled();
  return defects;
}

/// What is found out about a mesh once, however many objects have it.
struct MeshFacts {
  clash::Defects defects;
  solid::Classification classification;
};

/// Takes from the mesh's caches what was found before.
Result<MeshFacts> find_facts(const DefectChecks::Check& check, const ClashOptions& options, int threads) {
  const MeshState& mesh = check.mesh->state();
  std::optional<clash::Defects> defects;
  std::optional<solid::Classification> classification;
  if (check.pose_independent)
    defects = mesh.defect_cache.find(options.tolerance), classification = mesh.classification_cache.find();
  if (defects && classification) return MeshFacts{*defects, *classification};
  const solid::Body body = body_of(*check.mesh, check.pose);
  const solid::Topology topology = solid::examine(body);
  if (!classification) {
    classification = solid::classify(body, topology, options.stop);
    if (options.stop.stop_requested()) return cancelled();
    if (check.pose_independent) mesh.classification_cache.keep(*classification);
  }
  if (!defects) {
    const auto list = list_defects(check, body, topology, options, threads);
    if (!list) return list.error();
    defects = clash::Defects{list->size()};
    if (!list->empty()) defects->first = list->front();
    if (check.pose_independent) mesh.defect_cache.keep(options.tolerance, *defects);
  }
  return MeshFacts{*defects, *classification};
}

/// Examines large meshes one after the other, each by all threads, and small ones side by side.
Result<std::vector<MeshFacts>> find_all_facts(const std::vector<DefectChecks::Check>& placed,
                                              const ClashOptions& options) {
  constexpr std::size_t kLarge = 1 << 16;
  const auto is_large = [&](std::size_t i) { return placed[i].mesh->triangle_count() >= kLarge; };
  std::vector<Result<MeshFacts>> found(placed.size(), MeshFacts());
  const auto search = [&](std::size_t i, int threads) {
    if (options.stop.stop_requested()) return;
    found[i] = find_facts(placed[i], options, threads);
    Steps(options.progress).step();
  };
  run_each(on_threads(options.threads), placed.size(), [&](std::size_t i) {
    if (!is_large(i)) search(i, 1);
  });
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (is_large(i)) search(i, options.threads);
  if (options.stop.stop_requested()) return cancelled();
  std::vector<MeshFacts> facts;
  for (const auto& some : found) {
    if (!some) return some.error();
    facts.push_back(*some);
  }
  return facts;
}

void take_classes(const solid::Classification& found, const solid::Body& body, PartFacts& facts) {
  facts.part_class = found.best, facts.pieces = found.pieces, facts.turned = found.turned;
  facts.unclear_edges = found.unclear_edges;
  if (found.unclear_edge)
    facts.unclear_edge = Segment{body.world[(*found.unclear_edge)[0]], body.world[(*found.unclear_edge)[1]]};
}

Part make_part(const Placed& placed, solid::Body&& body, const MeshFacts& facts) {
  Part result{clash::measured_part(std::move(body), facts.defects), {}, {}};
  take_classes(facts.classification, result.judged.part.body, result.judged.facts);
  const solid::Part& part = result.judged.part;
  const auto is_wall = [](const solid::Part::Sides& sides) { return sides.front == sides.back; };
  if (!part.solid || std::none_of(part.sides.begin(), part.sides.end(), is_wall)) return result;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < part.body.size(); ++t)
    if (part.is_boundary(t))
      triangles.insert(triangles.end(), placed.mesh->triangles()[t].begin(), placed.mesh->triangles()[t].end());
  std::vector<double> xyz;
  for (const Point& vertex : placed.mesh->vertices()) xyz.insert(xyz.end(), {vertex.x, vertex.y, vertex.z});
  result.mesh_without_walls = Mesh::create(xyz, triangles).value();
  clash::MeasuredPart boundary = clash::measured_part(body_of(*result.mesh_without_walls, placed.pose), {});
  boundary.facts = result.judged.facts;
  result.with_walls = std::move(result.judged.part);
  result.judged = std::move(boundary);
  return result;
}

}  // namespace

DefectChecks list_defect_checks(const std::vector<Placed>& objects, const ClashOptions& options) {
  DefectChecks checks;
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

Result<std::vector<Part>> make_parts(const std::vector<Placed>& objects, std::vector<solid::Body> bodies,
                                     const DefectChecks& checks, const ClashOptions& options) {
  const auto facts = find_all_facts(checks.placed, options);
  if (!facts) return facts.error();
  std::vector<Part> parts(objects.size());
  run_each(on_threads(options.threads), objects.size(), [&](std::size_t i) {
    if (options.stop.stop_requested()) return;
    if (objects[i].mesh != nullptr)
      parts[i] = make_part(objects[i], std::move(bodies[i]), (*facts)[checks.of_object[i]]);
    Steps(options.progress).step();
  });
  if (options.stop.stop_requested()) return cancelled();
  return parts;
}

}  // namespace impinge
