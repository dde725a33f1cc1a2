// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// How a query's time grows: with the triangles while the contacts stay the same, because finer meshes are put less
/// deep into each other, and with the contacts while the triangles stay the same.
#include "bench/mesh_pairs.hpp"
#include "bench/ours.hpp"
#include "bench/pair_contestants.hpp"

namespace impinge::bench {
namespace {

class Growth {
 public:
  Growth(int poses, const Effort& effort) : poses_(poses), effort_(effort) {}

  void add(const char* grows, Copies& copies, std::size_t contacts) {
    scenes::Random random(11);
    std::vector<scenes::PosePair> poses;
    for (int i = 0; i < poses_; ++i)
      poses.push_back(must(scenes::with_contacts(random, copies.mesh, copies.mesh, contacts)));
    auto contestants = pair_contestants(copies, poses, {.query_alone = false});
    std::erase_if(contestants, [](const Contestant& c) { return c.name.starts_with("Embree"); });
    table_.add({grows, count(copies.mesh.triangle_count()), count(contacts)}, contestants,
               exact_answers(copies.mesh, poses), effort_);
  }

  void write(const std::filesystem::path& folder) const { table_.write(folder, "growth"); }

 private:
  int poses_;
  Effort effort_;
  ContestTable table_{{"grows", "triangles", "contacts"}};
};

}  // namespace

void bench_main(const Arguments& arguments) {
  constexpr std::size_t kContacts = 100;
  constexpr int kTriangles = 100'000;
  pin_to_one_core();
  Growth growth(arguments.quick ? 4 : 16, arguments.quick ? Effort{2, 2, 0} : Effort{3, 7, 2});
  const std::vector<int> sizes = arguments.quick ? std::vector{3162, 10'000, 31'620, 100'000}
                                                 : std::vector{3162, 10'000, 31'620, 100'000, 316'200, 1'000'000};
  for (const int triangles : sizes) {
    const Subject subject = torus_knot_subject(triangles);
    Copies copies(subject.data);
    growth.add("triangles", copies, kContacts);
  }
  const Subject subject = torus_knot_subject(kTriangles);
  Copies copies(subject.data);
  for (const std::size_t contacts : {10, 30, 100, 300, 1000}) growth.add("contacts", copies, contacts);
  growth.write(arguments.folder);
}

}  // namespace impinge::bench
