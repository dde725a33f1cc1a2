// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene/validate_pose.hpp"

#include <cmath>
#include <cstdio>

#include "core/pose.hpp"

namespace impinge::scene {

namespace {

Result<void> explain(const Pose& pose, double most_defect) {
  const auto bad = [](const std::string& what) {
    return Error{Code::bad_pose,
                 "the pose's " + what + "; bake any other finite map into the mesh with Mesh::transformed"};
  };
  for (const double r : pose.R)
    if (!std::isfinite(r)) return bad("matrix has an entry that is not a finite number");
  for (const double t : pose.t)
    if (!std::isfinite(t)) return bad("translation has an entry that is not a finite number");
  const double defect = orthogonality_defect(pose);
  if (!(defect <= most_defect)) {
    char text[96];
    std::snprintf(text, sizeof text, "matrix is not a rotation: max|RᵀR - I| is %.3g, above %g", defect, most_defect);
    return bad(text);
  }
  if (!(determinant(to_mat3(pose.R)) > 0)) return bad("matrix is a mirror image: its determinant is not positive");
  return {};
}

}  // namespace

Result<void> validate(const Pose& pose, double most_defect) {
  // A sum that is finite has finite terms; one that overflows is looked at term by term.
  const auto magnitude = [](double x, double y, double z) { return std::abs(x) + std::abs(y) + std::abs(z); };
  const double sum = (magnitude(pose.R[0], pose.R[1], pose.R[2]) + magnitude(pose.R[3], pose.R[4], pose.R[5])) +
                     (magnitude(pose.R[6], pose.R[7], pose.R[8]) + magnitude(pose.t[0], pose.t[1], pose.t[2]));
  if (sum < kInfinity && orthogonality_defect(pose) <= most_defect && determinant(to_mat3(pose.R)) > 0) return {};
  return explain(pose, most_defect);
}

}  // namespace impinge::scene
