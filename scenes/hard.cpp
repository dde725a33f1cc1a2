// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/hard.hpp"

namespace impinge::scenes {

MeshData triangle_soup(Random& random, int n, double size) {
  MeshData mesh;
  for (int i = 0; i < n; ++i) {
    const std::array<double, 3> center{random.unit(), random.unit(), random.unit()};
    std::array<double, 9> corners{};
    for (std::size_t k = 0; k < 9; ++k) {
      corners[k] = center[k % 3] + random.uniform(-size / 2, size / 2);
    }
    mesh.add_triangle(corners);
  }
  return mesh;
}

MeshData integer_soup(Random& random, int n, int side) {
  MeshData mesh;
  for (int i = 0; i < n; ++i) {
    std::array<double, 9> corners{};
    for (double& x : corners) {
      x = random.integer(0, side);
    }
    mesh.add_triangle(corners);
  }
  return mesh;
}

MeshData sliver_soup(Random& random, int n, double width) {
  MeshData mesh;
  for (int i = 0; i < n; ++i) {
    std::array<double, 9> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = random.unit();
      corners[3 + k] = random.unit();
      corners[6 + k] = corners[3 * (random.bits() % 2) + k] + random.uniform(-width, width);
    }
    mesh.add_triangle(corners);
  }
  return mesh;
}

MeshData degenerate_soup(Random& random, int n, int side) {
  MeshData mesh;
  const auto vertex = [&] {
    const double x = random.integer(0, side);
    const double y = random.integer(0, side);
    return mesh.add_vertex(x, y, random.integer(0, side));
  };
  const auto along = [&](std::uint32_t a, std::uint32_t b, double s) {
    std::array<double, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = mesh.xyz[3 * a + k] + s * (mesh.xyz[3 * b + k] - mesh.xyz[3 * a + k]);
    }
    return mesh.add_vertex(at[0], at[1], at[2]);
  };
  for (int i = 0; i < n; ++i) {
    const std::uint32_t a = vertex();
    switch (i % 6) {
      case 0:
        mesh.add_triangle(a, a, a);
        break;
      case 1:
        mesh.add_triangle(a, along(a, a, 0), along(a, a, 0));
        break;
      case 2:
        mesh.add_triangle(a, vertex(), a);
        break;
      default: {
        // Halves, and 0, 1, 2 of the way: exact for small integers.
        constexpr std::array<double, 5> kSteps{0, 0.5, 1, 2, -0.5};
        const std::uint32_t b = vertex();
        mesh.add_triangle(a, b, along(a, b, kSteps[static_cast<std::size_t>(random.integer(0, 4))]));
      }
    }
  }
  return mesh;
}

MeshData with_duplicates(const MeshData& mesh, int times) {
  MeshData result;
  result.xyz = mesh.xyz;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    for (int copy = 0; copy < times; ++copy) {
      const std::size_t turn = static_cast<std::size_t>(copy) % 3;
      const std::size_t step = copy % 2 == 0 ? 1 : 2;
      result.add_triangle(mesh.triangles[t + turn], mesh.triangles[t + (turn + step) % 3],
                          mesh.triangles[t + (turn + 2 * step) % 3]);
    }
  }
  return result;
}

}  // namespace impinge::scenes
