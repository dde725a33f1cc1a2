// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Two meshes that nobody has seen before, from raw vertices to every pair of triangles: meshes and trees are made
/// within the time. Each run is a process of its own, so that its peak memory is its own.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <string>

#include "bench/ours.hpp"
#include "bench/peers/cgal.hpp"
#include "bench/peers/fcl.hpp"
#include "bench/rough_sheets.hpp"

namespace impinge::bench {
namespace {

struct OneShot {
  double seconds = 0;
  std::uint64_t triangles = 0, pairs = 0;  // triangles of one mesh
  double peak_bytes = 0;                   // of the whole process, raw numbers included
};

using Ask = std::function<std::uint64_t(const scenes::MeshData&, const scenes::MeshData&)>;

std::uint64_t ask_impinge(const scenes::MeshData& a, const scenes::MeshData& b, const Options& options) {
  return must(collide(make_mesh(a), {}, make_mesh(b), {}, options)).triangles.size();
}

std::uint64_t ask_fcl(const scenes::MeshData& a, const scenes::MeshData& b) {
  FclDebianMesh mesh_a(a);
  return mesh_a.collide({}, FclDebianMesh(b), {});
}

std::uint64_t ask_cgal(const scenes::MeshData& a, const scenes::MeshData& b) {
  CgalBody body_a(a, {});
  return body_a.collide(CgalBody(b, {}));
}

/// Makes the sheets and asks, in a child process that sends its figures through a pipe.
OneShot in_child(int triangles, const Ask& ask) {
  int ends[2];
  if (pipe(ends) != 0) fail("cannot open a pipe");
  const pid_t child = fork();
  if (child < 0) fail("cannot start a process");
  if (child == 0) {
    const scenes::PlacedScene scene = rough_sheets(triangles);
    OneShot result{.triangles = scene.meshes[0].triangle_count()};
    result.seconds = wall_seconds_of([&] { result.pairs = ask(scene.meshes[0], scene.meshes[1]); });
    const bool sent = write(ends[1], &result, sizeof result) == static_cast<ssize_t>(sizeof result);
    _exit(sent ? 0 : 1);
  }
  close(ends[1]);
  OneShot result;
  const bool received = read(ends[0], &result, sizeof result) == static_cast<ssize_t>(sizeof result);
  close(ends[0]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (!received || status != 0)
    fail("a process that was to intersect " + std::to_string(triangles) + " triangles failed");
  result.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
  return result;
}

}  // namespace

void bench_main(const Arguments& arguments) {
  struct Way {
    const char* library;
    int threads, largest;
    Ask ask;
  };
  const auto impinge_with = [](const Options& options) {
    return [options](const scenes::MeshData& a, const scenes::MeshData& b) { return ask_impinge(a, b, options); };
  };
  const std::vector<int> sizes =
      arguments.quick ? std::vector{100'000, 1'000'000} : std::vector{100'000, 1'000'000, 7'000'000};
  const int largest = sizes.back(), next = sizes[sizes.size() - 2];
  const std::vector<Way> ways{{"impinge", 2, largest, impinge_with(fast(2))},
                              {"impinge", 1, largest, impinge_with(fast(1))},
                              {"impinge paper", 2, next, impinge_with(paper_way(2))},
                              {"FCL", 1, next, ask_fcl},
                              {"CGAL", 1, next, ask_cgal}};
  Table table({"triangles_each", "library", "threads", "pairs", "seconds", "peak_GB"});
  for (const int triangles : sizes) {
    std::uint64_t exact = 0;
    for (const Way& way : ways) {
      if (triangles > way.largest) continue;
      std::vector<double> seconds, peaks;
      OneShot last;
      for (int i = 0; i < (arguments.quick || triangles > 100'000 ? 1 : 3); ++i) {
        last = in_child(triangles, way.ask);
        seconds.push_back(last.seconds);
        peaks.push_back(last.peak_bytes);
      }
      if (exact == 0) exact = last.pairs;
      if (way.library != std::string("FCL") && last.pairs != exact)
        fail("exact libraries found different numbers of pairs");
      table.add({count(last.triangles), way.library, std::to_string(way.threads), count(last.pairs),
                 digits(median(seconds)), digits(1e-9 * median(peaks))});
    }
  }
  table.write(arguments.folder, "one_shot");
}

}  // namespace impinge::bench
