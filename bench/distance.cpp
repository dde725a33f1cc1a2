// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The distance of two rigid copies of one mesh, impinge's and FCL's: nearly in contact, a few percent of their size
/// apart, as far as they are large, and farther.
#include <cmath>

#include "bench/contest.hpp"
#include "bench/mesh_pairs.hpp"
#include "bench/peers/fcl_distance.hpp"
#include "impinge/collide.hpp"
#include "impinge/measures.hpp"

namespace impinge::bench {
namespace {

using Poses = std::vector<scenes::PosePair>;

/// In bounding-sphere diameters.
constexpr double kGaps[] = {0.001, 0.03, 1, 10};
const MeasureOptions kOneThread{.threads = 1};

bool touch(const Mesh& mesh, const scenes::PosePair& poses) {
  return !must(collide(mesh, poses.a, mesh, poses.b, {.find = Options::Find::first})).triangles.empty();
}

Poses poses_apart(const Mesh& mesh, double gap, int count) {
  scenes::Random random(19990527);
  Poses poses;
  while (poses.size() < static_cast<std::size_t>(count))
    if (const auto pair = must(scenes::near_first_touch(random, mesh, mesh, -gap)); !touch(mesh, pair))
      poses.push_back(pair);
  return poses;
}

/// The answers of a contestant's last round.
struct Answers {
  std::vector<double> distances;
  /// How many are off by more than a millionth.
  [[nodiscard]] std::uint64_t off(const Answers& reference) const {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < distances.size(); ++i)
      count += !(std::abs(distances[i] - reference.distances[i]) <= 1e-6 * reference.distances[i]);
    return count;
  }
};

class DistanceTable {
 public:
  DistanceTable(int poses, const Effort& effort) : poses_(poses), effort_(effort) {}

  void add(const Subject& subject) {
    const Mesh mesh = make_mesh(subject.data);
    must(mesh.build_tree());
    FclDistanceMesh<FclBuild::debian> fcl(subject.data);
    FclDistanceMesh<FclBuild::native> fcl_native(subject.data);
    for (const double gap : kGaps) add(subject.name, mesh, fcl, fcl_native, gap);
  }

  void write(const std::filesystem::path& folder) const { table_.write(folder, "distance"); }

 private:
  template <class Fcl, class FclNative>
  void add(const std::string& name, const Mesh& mesh, Fcl& fcl, FclNative& fcl_native, double gap) {
    const Poses poses = poses_apart(mesh, gap, poses_);
    Answers answers[3];
    for (Answers& a : answers) a.distances.resize(poses.size());
    const auto ours = [&](std::size_t i) {
      answers[0].distances[i] = must(distance(mesh, poses[i].a, mesh, poses[i].b, kOneThread)).distance;
    };
    for (std::size_t i = 0; i < poses.size(); ++i) ours(i);
    const std::vector<double> known = answers[0].distances;
    const Contestant contestants[] = {
        {"impinge", ours},
        {"impinge closer_than",
         [&](std::size_t i) {
           const auto closer = closer_than(mesh, poses[i].a, mesh, poses[i].b, 1.1 * known[i], kOneThread);
           if (!closer.has_value() || !*closer) fail("impinge closer_than is wrong");
         }},
        {"FCL", [&](std::size_t i) { answers[1].distances[i] = fcl.distance(poses[i].a, fcl, poses[i].b); }},
        {"FCL native",
         [&](std::size_t i) { answers[2].distances[i] = fcl_native.distance(poses[i].a, fcl_native, poses[i].b); }}};
    const std::vector<Times> times = contest(contestants, poses.size(), effort_);
    const std::uint64_t off[] = {0, 0, answers[1].off(answers[0]), answers[2].off(answers[0])};
    for (std::size_t c = 0; c < std::size(contestants); ++c) {
      const Spread ratio = spread(times[c].ratio);
      table_.add({name, count(mesh.triangle_count()), digits(gap), contestants[c].name, count(poses.size()),
                  digits(1e6 * median(times[c].seconds)), digits(ratio.median), digits(ratio.low), digits(ratio.high),
                  count(times[c].seconds.size()), count(off[c])});
    }
  }

  int poses_;
  Effort effort_;
  Table table_{
      {"mesh", "triangles", "gap", "library", "questions", "us", "ratio", "ratio_low", "ratio_high", "repeats", "off"}};
};

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  DistanceTable table(arguments.quick ? 8 : 40, arguments.quick ? Effort{2, 2, 0} : Effort{3, 7, 2});
  const std::vector<int> knots = arguments.quick ? std::vector{968, 9612} : std::vector{968, 9612, 100'000, 1'000'000};
  const std::vector<std::string> files =
      arguments.quick ? std::vector<std::string>{"armadillo.off"}
                      : std::vector<std::string>{"elephant.off", "fandisk.off", "camel.off", "armadillo.off"};
  for (const int triangles : knots) table.add(torus_knot_subject(triangles));
  for (const std::string& file : files) table.add(demo_subject(file));
  table.write(arguments.folder);
}

}  // namespace impinge::bench
