// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "contact.hpp"

#include <unistd.h>

#include <cstdio>
#include <fstream>

namespace oracle {

WorldObject placed(const Mesh& mesh, const Placement& placement) {
  std::vector<std::array<double, 3>> world;
  world.reserve(mesh.vertices.size());
  for (const auto& v : mesh.vertices) {
    std::array<double, 3> w{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double* const row = &placement.m[3 * i];
      w[i] = ((row[0] * v[0] + row[1] * v[1]) + row[2] * v[2]) + placement.t[i];
    }
    world.push_back(w);
  }
  WorldObject object;
  object.triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) object.triangles.push_back({world.at(t[0]), world.at(t[1]), world.at(t[2])});
  return object;
}

bool write_contacts(const std::string& file, const std::vector<Contact>& contacts) {
  static_assert(sizeof(Contact) == 5 * sizeof(std::uint32_t));
  const std::string unfinished = file + "." + std::to_string(::getpid());
  {
    std::ofstream out(unfinished, std::ios::binary);
    const std::uint64_t count = contacts.size();
    out.write("impset01", 8);
    out.write(reinterpret_cast<const char*>(&count), sizeof count);
    out.write(reinterpret_cast<const char*>(contacts.data()),
              static_cast<std::streamsize>(contacts.size() * sizeof(Contact)));
    if (!out.flush()) {
      std::remove(unfinished.c_str());
      return false;
    }
  }
  return std::rename(unfinished.c_str(), file.c_str()) == 0;
}

}  // namespace oracle
