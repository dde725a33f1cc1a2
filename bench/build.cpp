// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// What a mesh costs before it is asked anything: the time to make it and its tree, and the memory that it holds.
#include <memory>

#include "bench/contest.hpp"
#include "bench/mesh_pairs.hpp"
#include "bench/ours.hpp"
#include "bench/peers/cgal.hpp"
#include "bench/peers/embree.hpp"
#include "bench/peers/fcl.hpp"

namespace impinge::bench {
namespace {

constexpr int kOneThread = 1;

struct Maker {
  std::string name;
  std::function<std::shared_ptr<void>()> make;  ///< what it makes is dropped with the pointer
};

std::vector<Maker> makers(const scenes::MeshData& data) {
  const auto mesh_with = [&data](bool with_tree) {
    return [&data, with_tree]() -> std::shared_ptr<void> {
      auto mesh = std::make_shared<Mesh>(make_mesh(data));
      if (with_tree) must(mesh->build_tree(kOneThread));
      return mesh;
    };
  };
  std::vector<Maker> result{{"impinge", mesh_with(true)}, {"impinge without tree", mesh_with(false)}};
  result.push_back({"FCL", [&data]() -> std::shared_ptr<void> { return std::make_shared<FclDebianMesh>(data); }});
  result.push_back(
      {"FCL native", [&data]() -> std::shared_ptr<void> { return std::make_shared<FclNativeMesh>(data); }});
  result.push_back({"Embree", [&data]() -> std::shared_ptr<void> {
                      return std::make_shared<EmbreeBody>(data, Pose{}, EmbreeBody::Motion::fixed);
                    }});
  result.push_back({"Embree to be refitted", [&data]() -> std::shared_ptr<void> {
                      return std::make_shared<EmbreeBody>(data, Pose{}, EmbreeBody::Motion::moving);
                    }});
  result.push_back({"CGAL", [&data]() -> std::shared_ptr<void> {
                      auto body = std::make_shared<CgalBody>(data, Pose{});
                      body->build_tree();
                      return body;
                    }});
  return result;
}

/// On the heap, and what Embree takes beside it.
std::size_t bytes_held(const Maker& maker) {
  const auto held = [] { return heap_bytes() + EmbreeBody::bytes_held(); };
  const std::size_t before = held();
  const std::shared_ptr<void> kept = maker.make();
  return held() - before;
}

void measure(const Subject& subject, const Effort& effort, Table& table) {
  const std::vector<Maker> all = makers(subject.data);
  std::vector<Contestant> contestants;
  for (const Maker& maker : all) contestants.push_back({maker.name, [&](std::size_t) { maker.make(); }});
  const std::vector<Times> times = contest(contestants, 1, effort);
  const Mesh mesh = make_mesh(subject.data);
  must(mesh.build_tree(kOneThread));
  const auto n = static_cast<double>(mesh.triangle_count());
  for (std::size_t c = 0; c < all.size(); ++c) {
    const Spread ratio = spread(times[c].ratio);
    const bool ours = all[c].name == "impinge";
    table.add({subject.name, count(mesh.triangle_count()), all[c].name, milliseconds(median(times[c].seconds)),
               digits(ratio.median), digits(ratio.low), digits(ratio.high),
               digits(static_cast<double>(bytes_held(all[c])) / n),
               ours ? digits(static_cast<double>(mesh.memory_bytes()) / n) : "-"});
  }
}

/// The first query builds the nodes that it reaches; the same again finds them.
void measure_first_query(const Subject& subject, int repeats, Table& table) {
  const auto pose = random_poses(make_mesh(subject.data), Depth::deep, 1).front();
  std::vector<double> create, first, again;
  for (int i = 0; i < repeats; ++i) {
    create.push_back(seconds_of([&] { (void)make_mesh(subject.data); }));
    const Mesh mesh = make_mesh(subject.data);
    const auto query = [&] { (void)must(collide(mesh, pose.a, mesh, pose.b, fast())); };
    first.push_back(seconds_of(query));
    again.push_back(seconds_of(query));
  }
  table.add({subject.name, count(subject.data.triangle_count()), milliseconds(median(create)),
             milliseconds(median(first)), milliseconds(median(again))});
}

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  const Effort effort = arguments.quick ? Effort{2, 2, 0} : Effort{3, 7, 1};
  std::vector<Subject> subjects{torus_knot_subject(968), torus_knot_subject(9612), demo_subject("armadillo.off"),
                                demo_subject("refined_elephant.off")};
  if (!arguments.quick) subjects.push_back(torus_knot_subject(1'000'000));
  Table table({"mesh", "triangles", "library", "ms", "ratio", "ratio_low", "ratio_high", "bytes_a_triangle",
               "beyond_the_input_bytes_a_triangle"});
  Table queries({"mesh", "triangles", "create ms", "first query ms", "repeated query ms"});
  for (const Subject& subject : subjects) {
    measure(subject, effort, table);
    measure_first_query(subject, arguments.quick ? 2 : 5, queries);
  }
  table.write(arguments.folder, "build");
  queries.write(arguments.folder, "first_query");
}

}  // namespace impinge::bench
