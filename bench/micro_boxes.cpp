// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <array>
#include <memory>
#include <numeric>

#include "bench/micro.hpp"
#include "bench/support.hpp"
#include "paper/obb.hpp"
#include "paper/obb_overlap.hpp"
#include "pipeline/mesh_state.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

constexpr std::size_t kPairs = 1024;

using BoxPair = std::array<paper::Obb, 2>;

/// Boxes around eight triangles in a row of a torus knot, and of the same one turned: pairs that overlap, and pairs
/// that do not though their neighbourhoods meet, which is what a walk down two trees asks about.
struct Boxes {
  Mesh mesh = make_mesh(scenes::torus_knot_of(7590));
  paper::RelativePose relative;
  std::vector<BoxPair> overlapping, apart;

  explicit Boxes(scenes::Random& random)
      : relative({}, mesh.state().data, {.R = scenes::random_rotation(random)}, mesh.state().data) {
    std::vector<std::uint32_t> triangles(mesh.triangle_count());
    std::iota(triangles.begin(), triangles.end(), 0U);
    const auto any_box = [&] {
      const int first = random.integer(0, static_cast<int>(triangles.size()) - 8);
      return paper::fit_obb(mesh.state().data, std::span(triangles).subspan(static_cast<std::size_t>(first), 8));
    };
    while (overlapping.size() < kPairs || apart.size() < kPairs) {
      const BoxPair pair{any_box(), any_box()};
      const bool overlap = paper::may_overlap(pair[0], relative.moved(pair[1]), relative.margin);
      const double distance = norm(pair[0].center - relative.moved(pair[1]).center);
      const bool near = distance < norm(pair[0].half) + norm(pair[1].half);
      auto& list = overlap ? overlapping : apart;
      if (near && list.size() < kPairs) list.push_back(pair);
    }
  }
};

}  // namespace

void register_box_benchmarks() {
  scenes::Random random(3);
  const auto boxes = std::make_shared<const Boxes>(random);
  for (const bool overlapping : {true, false})
    benchmark::RegisterBenchmark(
        overlapping ? "box test: overlapping" : "box test: near but apart",
        [boxes, &pairs = overlapping ? boxes->overlapping : boxes->apart](benchmark::State& state) {
          const paper::RelativePose& relative = boxes->relative;
          for (auto _ : state)
            for (const auto& [a, b] : pairs)
              benchmark::DoNotOptimize(paper::may_overlap(a, relative.moved(b), relative.margin));
          state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPairs));
        });
}

}  // namespace impinge::bench
