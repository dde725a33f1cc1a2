// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/mesh.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <string>
#include <type_traits>

#include "core/guarded.hpp"
#include "core/hash.hpp"
#include "core/number.hpp"
#include "core/pose.hpp"
#include "pipeline/mesh_state.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/options.hpp"
#include "scene/bounding_sphere.hpp"
#include "scene/vertex_numbers.hpp"

namespace impinge {
namespace {

/// Whether some triangle has each vertex.
std::vector<std::uint8_t> used_vertices(const MeshData& mesh) {
  std::vector<std::uint8_t> used(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) used[v] = 1;
  return used;
}

/// 2^(-306 - min_bit), as far as there is such a double: a number's last place, at least that of a normal one, times
/// 2^min_bit is then at least 2^-358.
double least_entry(int min_bit) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(std::clamp(1023 - 306 - min_bit, 1, 2046)) << 52);
}

/// What depends on the triangles' corners alone.
void measure_corners(MeshData& mesh) {
  mesh.corners_hash = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    mesh.corners_hash += mix(mix(mix(i, a), b), c);
  }
  const auto used = used_vertices(mesh);
  mesh.has_loose_vertices = std::find(used.begin(), used.end(), 0) != used.end();
}

Error bad_mesh(std::string message) { return {Code::bad_mesh, std::move(message)}; }

/// Everything else that a mesh's numbers tell.
Result<void> measure_vertices(MeshData& mesh) {
  scene::VertexNumbers numbers = scene::vertex_numbers(mesh.vertices);
  if (!numbers.is_finite) {
    const auto bad = std::ranges::find_if(
        mesh.vertices, [](const Vec3& v) { return !std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z); });
    return bad_mesh("vertex " + std::to_string(bad - mesh.vertices.begin()) +
                    " has a coordinate that is not a finite number");
  }
  mesh.hash =
      mix(mix(mix(mesh.vertices.size(), mesh.triangles.size()), scene::vertex_hash(mesh.vertices)), mesh.corners_hash);
  if (mesh.triangles.empty()) return {};
  std::vector<Vec3> some;
  if (mesh.has_loose_vertices) {
    const auto used = used_vertices(mesh);
    for (std::size_t i = 0; i < used.size(); ++i)
      if (used[i] != 0) some.push_back(mesh.vertices[i]);
    numbers = scene::vertex_numbers(some);
  }
  mesh.box = numbers.box();
  const bool is_zero = numbers.least == kInfinity;
  mesh.min_exponent = is_zero ? std::numeric_limits<int>::max() / 4 : exponent(numbers.least);
  mesh.min_bit = is_zero ? std::numeric_limits<int>::max() / 4 : exponent(numbers.last_place);
  mesh.max_abs = max(abs(mesh.box.lo), abs(mesh.box.hi));
  mesh.least_entry = least_entry(mesh.min_bit);
  mesh.sphere = scene::bounding_sphere(mesh.has_loose_vertices ? some : mesh.vertices, numbers);
  return {};
}

/// Three coordinates a vertex.
template <class T>
std::vector<Vec3> read_vertices(std::span<const T> xyz) {
  std::vector<Vec3> vertices(xyz.size() / 3);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    vertices[i] = {static_cast<double>(xyz[3 * i]), static_cast<double>(xyz[3 * i + 1]),
                   static_cast<double>(xyz[3 * i + 2])};
  return vertices;
}

template <class T>
Result<MeshData> read_numbers(std::span<const T> xyz, std::span<const std::uint32_t> triangles, Precision precision) {
  if (xyz.size() % 3 != 0) return bad_mesh("the coordinates are " + std::to_string(xyz.size()) + ", not 3 a vertex");
  if (triangles.size() % 3 != 0)
    return bad_mesh("the indices are " + std::to_string(triangles.size()) + ", not 3 a triangle");
  const std::size_t vertex_count = xyz.size() / 3, triangle_count = triangles.size() / 3;
  if (triangle_count > std::numeric_limits<std::int32_t>::max())
    return bad_mesh("the mesh has more than 2^31 - 1 triangles; cut it into several objects");

  MeshData mesh;
  mesh.precision = precision;
  mesh.vertices = read_vertices(xyz);
  std::vector<MeshData::Corners> list;
  list.reserve(triangle_count);
  for (std::size_t i = 0; i < triangle_count; ++i) {
    list.push_back({triangles[3 * i], triangles[3 * i + 1], triangles[3 * i + 2]});
    for (const std::uint32_t v : list.back())
      if (v >= vertex_count)
        return bad_mesh("triangle " + std::to_string(i) + " names vertex " + std::to_string(v) +
                        ", but there are only " + std::to_string(vertex_count) + " (counted from 0)");
  }
  mesh.set_triangles(std::move(list));
  return mesh;
}

}  // namespace

Result<Mesh> Mesh::create(std::span<const double> xyz, std::span<const std::uint32_t> triangles, const TreeConfig& tree,
                          Precision precision) {
  return guarded([&] { return make(read_numbers(xyz, triangles, precision), tree); });
}

Result<Mesh> Mesh::create(std::span<const float> xyz, std::span<const std::uint32_t> triangles,
                          const TreeConfig& tree) {
  return guarded([&] { return make(read_numbers(xyz, triangles, Precision::single), tree); });
}

Result<Mesh> Mesh::transformed(const Affine& map) const {
  return guarded([&]() -> Result<Mesh> {
    for (const double x : map.m)
      if (!std::isfinite(x))
        return Error{Code::bad_pose, "the affine map's matrix has an entry that is not a finite number"};
    for (const double x : map.t)
      if (!std::isfinite(x))
        return Error{Code::bad_pose, "the affine map's translation has an entry that is not a finite number"};

    MeshData mesh;
    mesh.precision = state_->data.precision;
    mesh.vertices = state_->data.vertices;
    mesh.triangles = state_->data.triangles, mesh.shared_triangles = state_->data.shared_triangles;
    pose_all_vertices({map.m, map.t}, mesh.vertices);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const Vec3& v = mesh.vertices[i];
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
        return Error{Code::out_of_range, "vertex " + std::to_string(i) + " is mapped beyond the range of double"};
    }
    return make(std::move(mesh), state_->config);
  });
}

Result<Mesh> Mesh::deformed(std::span<const double> xyz) const {
  return guarded([&]() -> Result<Mesh> {
    const std::size_t n = vertex_count();
    if (xyz.size() < 3 * n)
      return bad_mesh("the coordinates end within vertex " + std::to_string(xyz.size() / 3) + ", but the mesh has " +
                      std::to_string(n) + " vertices (counted from 0), 3 coordinates each");
    if (xyz.size() > 3 * n)
      return bad_mesh("there are coordinates of a vertex " + std::to_string(n) + ", but the mesh has only " +
                      std::to_string(n) + " (counted from 0), 3 coordinates each");
    MeshData mesh;
    mesh.precision = state_->data.precision;
    mesh.vertices = read_vertices(xyz);
    mesh.triangles = state_->data.triangles, mesh.shared_triangles = state_->data.shared_triangles;
    mesh.corners_hash = state_->data.corners_hash, mesh.has_loose_vertices = state_->data.has_loose_vertices;
    if (auto measured = measure_vertices(mesh); !measured) return measured.error();
    return Mesh(std::make_shared<const MeshState>(std::move(mesh), *state_, on_threads(0)));
  });
}

Result<Mesh> Mesh::make(Result<MeshData> numbers, const TreeConfig& config) {
  if (config.leaf_size > 256)
    return Error{Code::bad_option, "leaf_size is " + std::to_string(config.leaf_size) +
                                       "; choose 1 to 256, or 0 for what each backend does best with"};
  if (!numbers) return numbers.error();
  measure_corners(*numbers);
  if (auto measured = measure_vertices(*numbers); !measured) return measured.error();
  return Mesh(std::make_shared<const MeshState>(*std::move(numbers), config));
}

Result<void> Mesh::build_tree(int threads) const {
  return guarded([&]() -> Result<void> {
    if (threads < 0) return validate(Options{.threads = threads});
    if (!state_->data.triangles.empty()) state_->wide_tree.build(on_threads(threads));
    return {};
  });
}

std::size_t Mesh::memory_bytes() const {
  return sizeof(MeshState) + state_->tree.bytes() + state_->wide_tree.bytes() + state_->stars.bytes() +
         state_->closed->bytes();
}

Precision Mesh::precision() const noexcept { return state_->data.precision; }
std::size_t Mesh::vertex_count() const noexcept { return state_->data.vertices.size(); }
std::size_t Mesh::triangle_count() const noexcept { return state_->data.triangles.size(); }
std::span<const Point> Mesh::vertices() const noexcept { return state_->data.vertices; }
std::span<const std::array<std::uint32_t, 3>> Mesh::triangles() const noexcept { return state_->data.triangles; }
std::span<const std::array<std::uint32_t, 2>> Mesh::edges() const {
  return state_->features->of(state_->data.triangles).edges;
}
Point Mesh::sphere_center() const noexcept { return state_->data.sphere.center; }
double Mesh::sphere_radius() const noexcept { return state_->data.sphere.radius; }

}  // namespace impinge
