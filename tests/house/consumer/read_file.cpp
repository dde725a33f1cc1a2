// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <iostream>

#include "impinge/impinge.hpp"
#include "impinge/io.hpp"

/// read_file FILE [IMPORTER]: prints how many triangles the objects of the file have.
int main(int argc, char** argv) {
  if (argc < 2) return 2;
  impinge::io::ReadOptions options;
  if (argc > 2) options.importer = argv[2];
  const auto model = impinge::io::read(argv[1], options);
  if (!model) {
    std::cerr << model.error().message << '\n';
    return 2;
  }
  std::size_t triangles = 0;
  for (const auto& object : model->objects) triangles += object.mesh.triangle_count();
  std::cout << triangles << " triangles\n";
}
