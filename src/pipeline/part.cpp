// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/part.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

#include "clash/local_frame.hpp"
#include "clash/self/self_crossings.hpp"
#include "clash/self/self_edge_crossings.hpp"
#include "clash/self/self_flush.hpp"
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
  if (defects.empty() && topology.closed) defects = clash::self_edge_crossings(body, topology, tolerance, options.stop);
  if (options.stop.stop_requested()) return cancelled();
  return defects;
}

/// Takes defects from the mesh's cache where the same search was made before.
Result<clash::Defects> find_defects(const DefectChecks::Check& check, const ClashOptions& options, int threads) {
  clash::DefectCache& cache = check.mesh->state().defect_cache;
  if (check.pose_independent)
    if (const auto defects = cache.find(options.tolerance)) return *defects;
  const auto list = list_defects(check, options, threads);
  if (!list) return list.error();
  clash::Defects defects{list->size()};
  if (!list->empty()) defects.first = list->front();
  if (check.pose_independent) cache.keep(options.tolerance, defects);
  return defects;
}

/// Searches large meshes one after the other, each by all threads, and small ones side by side.
Result<std::vector<clash::Defects>> find_all_defects(const std::vector<DefectChecks::Check>& placed,
                                                     const ClashOptions& options) {
  constexpr std::size_t kLarge = 1 << 16;
  const auto is_large = [&](std::size_t i) { return placed[i].mesh->triangle_count() >= kLarge; };
  std::vector<Result<clash::Defects>> found(placed.size(), clash::Defects());
  const auto search = [&](std::size_t i, int threads) {
    if (options.stop.stop_requested()) return;
    found[i] = find_defects(placed[i], options, threads);
    Steps(options.progress).step();
  };
  run_each(on_threads(options.threads), placed.size(), [&](std::size_t i) {
    if (!is_large(i)) search(i, 1);
  });
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (is_large(i)) search(i, options.threads);
  if (options.stop.stop_requested()) return cancelled();
  std::vector<clash::Defects> defects;
  for (const auto& some : found) {
    if (!some) return some.error();
    defects.push_back(*some);
  }
  return defects;
}

Part make_part(const Placed& placed, solid::Body&& body, const clash::Defects& defects) {
  Part result{clash::measured_part(std::move(body), defects), {}, {}};
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
  const auto defects = find_all_defects(checks.placed, options);
  if (!defects) return defects.error();
  std::vector<Part> parts(objects.size());
  run_each(on_threads(options.threads), objects.size(), [&](std::size_t i) {
    if (options.stop.stop_requested()) return;
    if (objects[i].mesh != nullptr)
      parts[i] = make_part(objects[i], std::move(bodies[i]), (*defects)[checks.of_object[i]]);
    Steps(options.progress).step();
  });
  if (options.stop.stop_requested()) return cancelled();
  return parts;
}

}  // namespace impinge
