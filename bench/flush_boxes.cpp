// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// 10,000 unit boxes that fill a lattice, so that everything touches and nothing crosses: the worst case of the exact
/// stage, axis-aligned and turned.
#include "bench/assemblies.hpp"
#include "bench/support.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"

namespace impinge::bench {
namespace {

void measure(const char* name, const scenes::PlacedScene& placed, int repeats, Table& counts, Table& times) {
  const Scene scene = fresh_scene(placed);
  const Options one_thread{.threads = 1, .statistics = true};
  std::vector<Statistics> queries;
  std::size_t rows = 0, contacts = 0;
  for (int i = 0; i < repeats; ++i) {
    const Contacts found = must(scene.collide(one_thread));
    queries.push_back(found.statistics);
    rows = found.objects.size();
    contacts = found.triangles.size();
  }
  const Statistics s = median(queries);
  const double calls = static_cast<double>(s.exact_calls), candidates = static_cast<double>(s.triangle_pairs);
  counts.add({name, count(scene.size()), count(s.object_pairs), count(rows), count(s.triangle_pairs), count(contacts),
              count(s.exact_calls), percent(calls, candidates), nanoseconds(s.exact_seconds / candidates)});
  times.add({name, milliseconds(s.broad_seconds), milliseconds(s.hierarchy_seconds), milliseconds(s.partition_seconds),
             milliseconds(s.narrow_seconds), milliseconds(s.exact_seconds), milliseconds(s.results_seconds),
             milliseconds(s.total_seconds)});
}

void run(const Arguments& arguments) {
  const int repeats = arguments.quick ? 1 : 3;
  Table counts({"lattice", "boxes", "candidate object pairs", "touching object pairs", "candidate triangle pairs",
                "touching triangle pairs", "exact calls", "share of candidates", "exact ns a candidate"});
  Table times(
      {"lattice", "broad ms", "hierarchy ms", "partition ms", "narrow ms", "exact ms", "results ms", "total ms"});
  const scenes::PlacedScene boxes = scenes::ten_thousand_flush_boxes();
  scenes::Random random(10000);
  const Pose motion = scenes::random_motion(random, 10);
  measure("axis-aligned", boxes, repeats, counts, times);
  measure("turned", scenes::moved(boxes, motion), repeats, counts, times);
  counts.write(arguments.folder, "flush_boxes_counts");
  times.write(arguments.folder, "flush_boxes_times");
}

}  // namespace
}  // namespace impinge::bench

int main(int argc, char** argv) {
  const auto arguments = impinge::bench::parse_arguments(argc, argv);
  impinge::bench::pin_to_one_core();
  impinge::bench::run(arguments);
}
