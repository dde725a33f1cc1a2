// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/mutual_motion.hpp"

#include <cstdlib>
#include <sstream>
#include <string>

#include "bench/support.hpp"

namespace impinge::bench {
namespace {

/// A step a row, R and t of both bodies.
constexpr const char* kRows =
#include "mutual_motion.inc"
    ;

}  // namespace

std::vector<scenes::PosePair> mutual_motion(std::size_t every) {
  std::istringstream rows(kRows);
  std::vector<scenes::PosePair> poses;
  std::size_t step = 0;
  for (std::string row; std::getline(rows, row);) {
    if (row.empty() || row[0] == '#' || row[0] == 's') continue;  // a remark, or the columns' names
    if (step++ % every != 0) continue;
    std::vector<double> numbers;
    std::istringstream cells(row);
    for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(std::strtod(cell.c_str(), nullptr));
    if (numbers.size() != 25) fail("a row of the poses is not a step and twice R and t: " + row);
    scenes::PosePair pair;
    auto next = numbers.begin() + 1;
    for (Pose* pose : {&pair.a, &pair.b}) {
      for (double& entry : pose->R) entry = *next++;
      for (double& entry : pose->t) entry = *next++;
    }
    poses.push_back(pair);
  }
  return poses;
}

}  // namespace impinge::bench
