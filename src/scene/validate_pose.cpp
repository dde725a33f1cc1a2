// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene/validate_pose.hpp"

#include <cmath>
#include <cstdio>

#include "core/pose.hpp"

namespace impinge::scene {

Result<void> validate(const Pose& pose, double most_defect) {
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

}  // namespace impinge::scene
