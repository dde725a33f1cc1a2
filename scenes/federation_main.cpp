// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// impinge-federation STOREYS ROOMS FOLDER
///
/// Writes the IFC files of federation.hpp, with so many rooms in each storey, into a folder, which it makes.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "scenes/argument.hpp"
#include "scenes/federation.hpp"

int main(int argc, char** argv) {
  using impinge::scenes::parse_whole;
  int storeys = 0, rooms = 0;
  if (argc != 4 || !parse_whole(argv[1], storeys) || !parse_whole(argv[2], rooms) || storeys <= 0 || rooms <= 0) {
    std::fprintf(stderr, "usage: %s STOREYS ROOMS FOLDER\n", argv[0]);
    return 2;
  }
  std::error_code unmade;  // then the first file says so
  std::filesystem::create_directories(argv[3], unmade);
  const auto made = impinge::scenes::federation({.storeys = storeys, .rooms = rooms});
  for (const auto& [name, text] : made.files) {
    std::ofstream file(argv[3] + ("/" + name), std::ios::binary);
    file << text;
    if (!file.flush()) {
      std::fprintf(stderr, "%s: %s/%s cannot be written\n", argv[0], argv[3], name.c_str());
      return 1;
    }
  }
}
