// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// impinge-mechanism linkage|gears FILE.glb
///
/// Writes a machine of mechanism.hpp that moves for four seconds: a linkage whose rocker runs into a stop, or a pair of
/// gears whose teeth overlap again and again.
#include <cstdio>
#include <fstream>
#include <string_view>

#include "scenes/mechanism.hpp"

int main(int argc, char** argv) {
  constexpr double kSeconds = 4, kTooNear = 7.859375;
  const std::string_view what = argc == 3 ? argv[1] : "";
  if (what != "linkage" && what != "gears") {
    std::fprintf(stderr, "usage: %s linkage|gears FILE.glb\n", argv[0]);
    return 2;
  }
  namespace scenes = impinge::scenes;
  const auto parts = what == "gears" ? scenes::gear_pair(kSeconds, kTooNear) : scenes::four_bar_linkage(kSeconds);
  std::ofstream file(argv[2], std::ios::binary);
  file << scenes::animated_glb(parts);
  if (file.flush()) return 0;
  std::fprintf(stderr, "%s: %s cannot be written\n", argv[0], argv[2]);
  return 1;
}
