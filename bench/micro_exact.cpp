// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <functional>
#include <string>

#include "bench/micro.hpp"
#include "bench/support.hpp"
#include "exact/orientation.hpp"
#include "exact/settle.hpp"
#include "exact/triangle_pair.hpp"
#include "scenes/motion.hpp"
#include "scenes/random.hpp"

namespace impinge::bench {
namespace {

constexpr int kInputs = 1024;  // small enough for the cache, too many for the branch predictor to learn

using Four = std::array<Vec3, 4>;
using Pair = std::array<Triangle, 2>;

template <class Input>
std::vector<Input> make(const std::function<Input(scenes::Random&)>& one) {
  scenes::Random random(4);
  std::vector<Input> inputs;
  for (int i = 0; i < kInputs; ++i) inputs.push_back(one(random));
  return inputs;
}

template <class Input, class Body>
void run(benchmark::State& state, const std::vector<Input>& inputs, const Body& body) {
  for (auto _ : state)
    for (const Input& input : inputs) benchmark::DoNotOptimize(body(input));
  state.SetItemsProcessed(state.iterations() * kInputs);
}

Vec3 anywhere(scenes::Random& random) { return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; }

Four general(scenes::Random& random) {
  return {anywhere(random), anywhere(random), anywhere(random), anywhere(random)};
}

/// In one plane that no axis is parallel to, on the integers: differences are doubles.
Four integer_plane(scenes::Random& random) {
  const auto integer = [&] { return static_cast<double>(random.integer(-1000, 1000)); };
  const Vec3 a{integer(), integer(), integer()}, u{integer(), integer(), integer()}, v{integer(), integer(), integer()};
  return {a, a + u, a + v, a + 3 * u - 2 * v};
}

/// In the plane x = z with all digits in use, so that differences are rounded.
Four diagonal_plane(scenes::Random& random) {
  Four points = general(random);
  for (Vec3& p : points) p.z = p.x;
  return points;
}

Four axis_aligned_plane(scenes::Random& random) {
  Four points = general(random);
  for (Vec3& p : points) p.z = 0.3;
  return points;
}

Pair crossing(scenes::Random& random) {
  const Vec3 shift = 0.1 * anywhere(random);
  return {Triangle{Vec3{-1, -1, 0} + shift, Vec3{2, 0, 0.1} + shift, Vec3{-1, 1, -0.1} + shift},
          Triangle{Vec3{0, 0, -1}, Vec3{0.1, 0.2, 1}, Vec3{3, 0, 0.5}}};
}

Pair apart(scenes::Random& random) {
  const Four p = general(random);
  const Vec3 above{0, 0, 2.5};
  return {Triangle{p[0], p[1], p[2]}, Triangle{p[1] + above, p[2] + above, p[3] + above}};
}

Pair sharing_an_edge(scenes::Random& random) {
  const Four p = general(random);
  return {Triangle{p[0], p[1], p[2]}, Triangle{p[1], p[0], p[3]}};
}

Pair sharing_a_vertex(scenes::Random& random) {
  const Four p = general(random), q = general(random);
  return {Triangle{p[0], p[1], p[2]}, Triangle{p[0], q[0], q[1]}};
}

Pair flush(scenes::Random& random) {
  const Four p = axis_aligned_plane(random);
  return {Triangle{p[0], p[1], p[2]}, Triangle{p[1], p[2], p[3]}};
}

Pair flush_and_turned(scenes::Random& random) {
  const Four p = diagonal_plane(random);
  return {Triangle{p[0], p[1], p[2]}, Triangle{p[1], p[2], p[3]}};
}

/// In one plane but for what the rounding of a motion has left.
Pair flush_in_motion(scenes::Random& random) {
  static const Pose motion = scenes::random_motion(random, 10);
  const auto point = [&] { return world_vertex(motion, {random.uniform(-1, 1), random.uniform(-1, 1), 0}); };
  const Point a = point(), b = point(), c = point(), d = point(), e = point();
  return {Triangle{a, b, c}, Triangle{d, e, point()}};
}

void add_orientation(const char* name, Four (*one)(scenes::Random&)) {
  benchmark::RegisterBenchmark(name, [inputs = make<Four>(one)](benchmark::State& state) {
    run(state, inputs, [](const Four& p) { return exact::orient3d(p[0], p[1], p[2], p[3]); });
  });
}

/// One at a time, and all of them settled together, which includes placing them.
void add_pair(const std::string& name, Pair (*one)(scenes::Random&)) {
  const std::vector<Pair> inputs = make<Pair>(one);
  benchmark::RegisterBenchmark((name + "; alone").c_str(), [inputs](benchmark::State& state) {
    run(state, inputs, [](const Pair& pair) { return exact::classify(pair[0], pair[1]); });
  });
  std::array<MeshData, 2> meshes;
  std::vector<MeshData::Corners> triangles;
  std::vector<TrianglePair> pairs;
  for (const Pair& pair : inputs) {
    const auto first = static_cast<std::uint32_t>(meshes[0].vertices.size());
    triangles.push_back({first, first + 1, first + 2});
    for (std::size_t t = 0; t < 2; ++t)
      meshes[t].vertices.insert(meshes[t].vertices.end(), pair[t].begin(), pair[t].end());
    pairs.push_back({static_cast<std::uint32_t>(pairs.size()), static_cast<std::uint32_t>(pairs.size())});
  }
  for (MeshData& mesh : meshes) mesh.set_triangles(triangles);
  benchmark::RegisterBenchmark((name + "; settled").c_str(), [meshes, pairs](benchmark::State& state) {
    std::vector<exact::Contact> contacts;
    for (auto _ : state) {
      contacts.clear();
      exact::settle(meshes[0], {}, meshes[1], {}, pairs, contacts);
      benchmark::DoNotOptimize(contacts.data());
    }
    state.SetItemsProcessed(state.iterations() * kInputs);
  });
}

}  // namespace

void register_exact_benchmarks() {
  add_orientation("orient3d: general", general);
  add_orientation("orient3d: zero; differences exact", integer_plane);
  add_orientation("orient3d: zero; differences rounded", diagonal_plane);
  add_orientation("orient3d: zero; axis-aligned", axis_aligned_plane);
  add_pair("triangle pair: apart", apart);
  add_pair("triangle pair: crossing", crossing);
  add_pair("triangle pair: sharing an edge", sharing_an_edge);
  add_pair("triangle pair: sharing a vertex", sharing_a_vertex);
  add_pair("triangle pair: flush; axis-aligned", flush);
  add_pair("triangle pair: flush; turned", flush_and_turned);
  add_pair("triangle pair: flush; in motion", flush_in_motion);
}

}  // namespace impinge::bench
