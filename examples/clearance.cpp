// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Distance and clearance: how near two meshes are, whether they are nearer than a limit, which is much faster to
// answer, and which pairs of a whole scene are.
//
// Of cubes of side 1, one shifted by (4, 5, 0), the nearest edges are 3 apart in x and 4 in y: 5. In the row of three,
// at x = 0, 1.5 and 4, the gaps are 0.5 and 1.5, and 1 of them is below 1.
//
// prints: 5 apart
// prints: nearer than 5.5: yes, nearer than 4.5: no
// prints: part 0 and part 1 are apart, by 0.5
#include "shapes.hpp"

int main() {
  const auto cube = box({0, 0, 0}, {1, 1, 1});
  const impinge::Pose here, there{.t{4, 5, 0}};
  const auto yes_or_no = [&](double limit) {
    return value_of(impinge::closer_than(cube, here, cube, there, limit)) ? "yes" : "no";
  };
  std::cout << value_of(impinge::distance(cube, here, cube, there)).distance << " apart\n"
            << "nearer than 5.5: " << yes_or_no(5.5) << ", nearer than 4.5: " << yes_or_no(4.5) << '\n';

  impinge::Scene row;
  for (const double x : {0.0, 1.5, 4.0}) value_of(row.add(cube, {.t{x, 0, 0}}));
  for (const impinge::Clash& clash : value_of(impinge::find_clashes(row, {.clearance = 1})).pairs) {
    std::cout << "part " << clash.objects[0] << " and part " << clash.objects[1] << " are "
              << impinge::name(clash.verdict) << ", by " << clash.nearest.value().distance << '\n';
  }
}
