// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "impinge/mesh.hpp"

namespace impinge::io {

/// Collects the parts whose coordinates passed through 32-bit floats and lost too much there: the spacing of floats at
/// the part's coordinates, or at its place in the world, exceeds a millionth of the part's size.
class PrecisionCheck {
 public:
  /// `world` maps the mesh, whose vertices are the floats of the file, to where it stands.
  void add(std::string_view name, const Mesh& mesh, const Affine& world);
  /// At most one sentence, about the worst part.
  void report(std::vector<std::string>& warnings) const;

 private:
  void note(std::string_view name, double coordinate, double size);

  std::uint64_t parts_ = 0, coarse_ = 0;
  bool last_is_coarse_ = false;
  std::string worst_;
  double worst_ratio_ = 0, worst_spacing_ = 0, worst_coordinate_ = 0, worst_size_ = 0;
};

}  // namespace impinge::io
