// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// A generated process plant (scenes/plant.hpp), from its file to the verdict on every pair of its parts, and the
/// verdicts held against what was planted. On all cores that the process may use: pin it to two for the figures of
/// docs/benchmarks.md (taskset -c 0,1).
#include "scenes/plant.hpp"

#include <sys/resource.h>

#include <fstream>
#include <limits>

#include "bench/support.hpp"
#include "impinge/clash.hpp"
#include "impinge/io.hpp"
#include "scenes/glb.hpp"
#include "scenes/plant_answer.hpp"

namespace impinge::bench {
namespace {

/// The most memory so far, of this process or of the largest child that has ended: the reader. Linux counts in KiB.
double peak_megabytes(int who) {
  rusage usage{};
  if (getrusage(who, &usage) != 0) fail("cannot ask how much memory was used");
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

struct Run {
  std::uint64_t triangles = 0;
  double read_seconds = 0, scene_seconds = 0, clash_seconds = 0, depth_seconds = 0;
  Clashes clashes;
};

Run run(const std::filesystem::path& file) {
  Run result;
  io::Model model;
  result.read_seconds = wall_seconds_of([&] { model = must(io::read(file)); });
  Scene scene;
  result.scene_seconds = wall_seconds_of([&] {
    for (io::Object& object : model.objects) {
      result.triangles += object.mesh.triangle_count();
      must(scene.add(object.mesh, object.pose));
    }
    must(scene.update());
  });
  ClashOptions options{.clearance = scenes::kPlantClearance,
                       .depth_precision = std::numeric_limits<double>::infinity()};
  result.clash_seconds = wall_seconds_of([&] { result.clashes = must(find_clashes(scene, options)); });
  options.depth_precision = ClashOptions{}.depth_precision;
  result.depth_seconds = wall_seconds_of([&] { must(find_clashes(scene, options)); });
  return result;
}

/// Makes the file apart from the measuring, so that its memory is given back before.
void write_file(const std::filesystem::path& path, const scenes::Plant& plant) {
  std::ofstream file(path, std::ios::binary);
  file << scenes::glb_bytes(plant.scene, plant.names);
  if (!file.flush()) fail("cannot write " + path.string());
}

struct Tables {
  Table times{{"parts", "meshes", "triangles", "candidates", "listed pairs", "read s", "scene s", "verdicts s",
               "with depths s", "file to verdicts s", "us a candidate", "peak MB", "reader's peak MB", "mismatches"}};
  Table families{{"what was planted", "pairs", "right"}};
};

/// A family's name with no comma, for a cell.
std::string cell(std::string_view family) {
  std::string text(family);
  for (char& c : text)
    if (c == ',') c = ';';
  return text;
}

void measure(int parts, const Arguments& arguments, Tables& tables, bool with_families) {
  const std::filesystem::path file = arguments.folder / "plant.glb";
  const scenes::Plant plant = scenes::plant(parts);
  write_file(file, plant);
  const Run result = run(file);
  std::filesystem::remove(file);
  // A file keeps poses to 2^-24 of their numbers; of positions up to 127 m, and of parts of some meters.
  const auto answer = scenes::compare(plant, result.clashes.pairs, {.slack = 0.05});
  for (std::size_t i = 0; i < answer.faults.size() && i < 20; ++i) std::printf("%s\n", answer.faults[i].c_str());
  std::size_t surfaces = 0;
  for (const PartFacts& part : result.clashes.parts) surfaces += part.part_class == PartClass::solid ? 0 : 1;
  const double seconds = result.read_seconds + result.scene_seconds + result.clash_seconds;
  const auto candidates = static_cast<double>(result.clashes.candidates);
  tables.times.add({count(plant.names.size()), count(plant.scene.meshes.size()), count(result.triangles),
                    count(result.clashes.candidates), count(result.clashes.pairs.size()), digits(result.read_seconds),
                    digits(result.scene_seconds), digits(result.clash_seconds), digits(result.depth_seconds),
                    digits(seconds), digits(1e6 * result.clash_seconds / candidates),
                    digits(peak_megabytes(RUSAGE_SELF)), digits(peak_megabytes(RUSAGE_CHILDREN)),
                    count(answer.faults.size() + surfaces)});
  if (!with_families) return;
  for (const auto& [family, score] : answer.scores)
    tables.families.add({cell(family), count(score.planted), count(score.right)});
}

}  // namespace

void bench_main(const Arguments& arguments) {
  Tables tables;
  // Upwards: a process's peak of memory never falls.
  const std::vector<int> sizes = arguments.quick ? std::vector{1000, 10'000} : std::vector{1000, 10'000, 100'000};
  for (const int parts : sizes) measure(parts, arguments, tables, parts == 10'000);
  tables.times.write(arguments.folder, "plant");
  tables.families.write(arguments.folder, "plant_families");
}

}  // namespace impinge::bench
