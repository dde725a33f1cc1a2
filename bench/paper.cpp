// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The paper's experiment, its equation 6: two bodies in mutual motion, T = t / C, the time of C detections over C.
#include "bench/mesh_pairs.hpp"
#include "bench/ours.hpp"
#include "bench/pair_contestants.hpp"

namespace impinge::bench {

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  const Effort effort = arguments.quick ? Effort{2, 2, 0} : Effort{3, 7, 3};
  auto poses = published_poses("mutual_motion.csv");
  if (arguments.quick) {
    constexpr std::size_t kEvery = 5;
    for (std::size_t i = 0; kEvery * i < poses.size(); ++i) poses[i] = poses[kEvery * i];
    poses.resize((poses.size() + kEvery - 1) / kEvery);
  }
  ContestTable table({"mesh", "triangles"});
  for (const Subject& subject : paper_subjects()) {
    Copies copies(subject.data);
    table.add({subject.name, count(copies.mesh.triangle_count())}, pair_contestants(copies, poses),
              exact_answers(copies.mesh, poses), effort);
  }
  table.write(arguments.folder, "paper");
}

}  // namespace impinge::bench
