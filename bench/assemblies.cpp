// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Two real assemblies: what a query counts, and the time of each stage, for the first query, which builds trees as it
/// goes, and for the same again; then every library on the same parts.
#include "bench/assemblies.hpp"

#include "bench/assembly_contest.hpp"
#include "bench/ours.hpp"
#include "bench/support.hpp"

namespace impinge::bench {
namespace {

struct Repeats {
  std::vector<Statistics> first, again;
  std::uint64_t rows = 0, contacts = 0;
};

Repeats query(const io::Model& model, int repeats) {
  Repeats result;
  for (int i = 0; i < repeats; ++i) {
    const Scene scene = fresh_scene(model);
    result.first.push_back(must(scene.collide(timed())).statistics);
    const Contacts contacts = must(scene.collide(timed()));
    result.again.push_back(contacts.statistics);
    result.rows = contacts.objects.size();
    result.contacts = contacts.triangles.size();
  }
  return result;
}

void add_times(Table& table, const std::string& name, const char* which, const Statistics& s) {
  table.add({name, which, milliseconds(s.broad_seconds), milliseconds(s.hierarchy_seconds),
             milliseconds(s.partition_seconds), milliseconds(s.narrow_seconds), milliseconds(s.exact_seconds),
             milliseconds(s.results_seconds), milliseconds(s.total_seconds)});
}

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  const int repeats = arguments.quick ? 2 : 7;
  Table counts({"assembly", "objects", "triangles", "read ms", "candidate object pairs", "touching object pairs",
                "touching triangle pairs", "candidate triangle pairs", "exact calls", "share of candidates"});
  Table times({"assembly", "query", "broad ms", "hierarchy ms", "partition ms", "narrow ms", "exact ms", "results ms",
               "total ms"});
  AssemblyContest contest;
  for (const Assembly& assembly : assemblies()) {
    std::vector<double> reading;
    for (int i = 0; i < (arguments.quick ? 1 : 3); ++i)
      reading.push_back(wall_seconds_of([&] { (void)read_model(assembly); }));
    const io::Model model = read_model(assembly);
    std::size_t triangles = 0;
    for (const io::Object& object : model.objects) triangles += object.mesh.triangle_count();

    const Repeats result = query(model, repeats);
    const Statistics first = median(result.first), again = median(result.again);
    counts.add({assembly.name, count(model.objects.size()), count(triangles), milliseconds(median(reading)),
                count(again.object_pairs), count(result.rows), count(result.contacts), count(again.triangle_pairs),
                count(again.exact_calls),
                percent(static_cast<double>(again.exact_calls), static_cast<double>(again.triangle_pairs))});
    add_times(times, assembly.name, "first", first);
    add_times(times, assembly.name, "repeated", again);
    contest.add(assembly.name, model, arguments.quick ? Effort{2, 2, 0} : Effort{5, 9, 5});
  }
  counts.write(arguments.folder, "assembly_counts");
  times.write(arguments.folder, "assembly_times");
  contest.write(arguments.folder);
}

}  // namespace impinge::bench
