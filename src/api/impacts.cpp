// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/impacts.hpp"

#include <algorithm>
#include <string>

#include "core/guarded.hpp"
#include "motion/impact_search.hpp"
#include "pipeline/mesh_state.hpp"
#include "pipeline/on_threads.hpp"

namespace impinge {
namespace {

Result<void> validate(const MotionOptions& options) {
  if (options.threads < 0)
    return Error{Code::bad_option,
                 "a number of threads is 0 (all there are) or more, not " + std::to_string(options.threads)};
  if (!(options.end >= 0 && options.end <= 1))
    return Error{Code::bad_option, "the end of the time looked at is from 0 to 1, not " + std::to_string(options.end)};
  return {};
}

/// `name`: of the mesh, for errors.
Result<void> validate(const Moving& mesh, const std::string& name) {
  if (mesh.from.vertex_count() != mesh.to.vertex_count())
    return Error{Code::bad_mesh, name + " has " + std::to_string(mesh.from.vertex_count()) +
                                     " vertices at the start and " + std::to_string(mesh.to.vertex_count()) +
                                     " at the end; give two states of one mesh"};
  const auto start = mesh.from.triangles(), end = mesh.to.triangles();
  if (start.size() != end.size())
    return Error{Code::bad_mesh, name + " has " + std::to_string(start.size()) + " triangles at the start and " +
                                     std::to_string(end.size()) + " at the end; give two states of one mesh"};
  if (const auto [one, two] = std::ranges::mismatch(start, end); one != start.end())
    return Error{Code::bad_mesh, name + "'s triangle " + std::to_string(one - start.begin()) +
                                     " has other vertices at the end than at the start; give two states of one mesh"};
  return {};
}

motion::Vertices vertices_of(const Moving& mesh) { return {mesh.from.vertices(), mesh.to.vertices()}; }

const motion::Features& features_of(const Mesh& mesh) {
  const MeshState& state = mesh.state();
  return state.features->of(state.data.triangles);
}

motion::MovingMesh moving_mesh(const Moving& mesh) {
  return {vertices_of(mesh), features_of(mesh.from), mesh.from.state().features.get()};
}

motion::ImpactQuery query_of(const MotionOptions& options) {
  return {options.earliest, options.end, options.limit, on_threads(options.threads), options.stop};
}

}  // namespace

Result<Impacts> find_impacts(const Moving& a, const Moving& b, const MotionOptions& options) {
  return guarded([&]() -> Result<Impacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    if (auto valid = validate(a, "the first mesh"); !valid) return valid.error();
    if (auto valid = validate(b, "the second mesh"); !valid) return valid.error();
    const motion::MovingMesh second = moving_mesh(b);
    return motion::find_impacts(moving_mesh(a), &second, query_of(options));
  });
}

Result<Impacts> find_impacts(const Moving& mesh, const MotionOptions& options) {
  return guarded([&]() -> Result<Impacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    if (auto valid = validate(mesh, "the mesh"); !valid) return valid.error();
    const motion::MovingMesh moving = moving_mesh(mesh);
    std::optional<motion::Features> joined;
    if (options.adjacency == Adjacency::by_position)
      joined = motion::join_equal_vertices(moving.features, moving.vertices.from, moving.vertices.to, options.stop);
    return motion::find_impacts({moving.vertices, joined ? *joined : moving.features, moving.cache}, nullptr,
                                query_of(options));
  });
}

}  // namespace impinge
