// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include "bench/micro.hpp"
#include "bench/support.hpp"
#include "impinge/measures.hpp"
#include "scenes/random.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

/// Uniform in the box of `torus_knot`.
Point in_box(scenes::Random& random) {
  return {random.uniform(-3.4, 3.4), random.uniform(-3.4, 3.4), random.uniform(-1.4, 1.4)};
}

/// Within 0.001 of a vertex along each axis.
Point at_surface(const scenes::MeshData& data, scenes::Random& random) {
  const auto near = [&, vertex = random.integer(0, static_cast<int>(data.vertex_count()) - 1)](int k) {
    return data.xyz[static_cast<std::size_t>(3 * vertex + k)] + random.uniform(-1e-3, 1e-3);
  };
  return {near(0), near(1), near(2)};
}

}  // namespace

void register_point_benchmarks(int count) {
  scenes::Random random(19870727);
  const scenes::MeshData data = scenes::torus_knot_of(200'000);
  const PointLocator locator = must(PointLocator::create(make_mesh(data), {}, 1));
  std::vector<Point> anywhere, near;
  for (int i = 0; i < count; ++i) {
    anywhere.push_back(in_box(random));
    if (i % 10 == 0) near.push_back(at_surface(data, random));
  }
  const auto add = [&](const std::string& where, const std::vector<Point>& points) {
    const std::string mesh = "a closed mesh of " + bench::count(data.triangle_count()) + " triangles";
    benchmark::RegisterBenchmark(("point in " + mesh + ": " + where).c_str(), [=](benchmark::State& state) {
      for (auto _ : state) benchmark::DoNotOptimize(must(locator.locate(points, {.threads = 1})).data());
      state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
    });
  };
  add("anywhere in its box", anywhere);
  add("at its surface", near);
}

}  // namespace impinge::bench
