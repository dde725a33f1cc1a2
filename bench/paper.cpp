// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The paper's experiment, its equation 6: two bodies in mutual motion, T = t / C, the time of C detections over C.
#include "bench/mesh_pairs.hpp"
#include "bench/mutual_motion.hpp"
#include "bench/ours.hpp"
#include "bench/pair_contestants.hpp"

namespace impinge::bench {

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  const Effort effort = arguments.quick ? Effort{2, 2, 0} : Effort{3, 7, 3};
  const auto poses = mutual_motion(arguments.quick ? 5 : 1);
  ContestTable table({"mesh", "triangles"});
  for (const Subject& subject : paper_subjects()) {
    Copies copies(subject.data);
    table.add({subject.name, count(copies.mesh.triangle_count())}, paper_contestants(copies, poses),
              exact_answers(copies.mesh, poses), effort);
  }
  table.write(arguments.folder, "paper");
}

}  // namespace impinge::bench
