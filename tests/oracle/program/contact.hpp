// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace oracle {

using WorldTriangle = std::array<std::array<double, 3>, 3>;

struct WorldObject {
  std::vector<WorldTriangle> triangles;
  std::uint32_t group = 0;  ///< objects of one non-zero group are not compared
};

struct Mesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Row-major 3x3 matrix and translation.
struct Placement {
  std::array<double, 9> m;
  std::array<double, 3> t;
};

/// ((m00*x + m01*y) + m02*z) + t0 and so on, each product and sum rounded once.
WorldObject placed(const Mesh& mesh, const Placement& placement);

/// Two triangles of different objects that share a point; object_a < object_b.
struct Contact {
  std::uint32_t object_a, object_b, triangle_a, triangle_b, kind;
  friend auto operator<=>(const Contact&, const Contact&) = default;
};

/// Writes "impset01", the number of contacts as u64, then 5 u32 a contact, in the machine's byte order. The file
/// appears under its name only when it is whole.
bool write_contacts(const std::string& file, const std::vector<Contact>& contacts);

}  // namespace oracle
