// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/support.hpp"
#include "impinge/io.hpp"

namespace impinge::bench {

scenes::MeshData demo_mesh(const std::string& file) {
  const auto path = std::filesystem::path(IMPINGE_DATA_DIR) / "cgal/data/meshes" / file;
  if (!std::filesystem::exists(path)) fail(path.string() + " is missing; run scripts/fetch_data.sh");
  return numbers_of(must(io::read(path)).objects.at(0).mesh);
}

}  // namespace impinge::bench
