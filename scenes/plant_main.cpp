// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// impinge-plant PARTS SEED FILE.glb [LIST.csv]
///
/// Writes the plant of plant.hpp for whoever wants to look at it, and what was planted in it.
#include <cstdio>
#include <fstream>
#include <string>

#include "scenes/argument.hpp"
#include "scenes/glb.hpp"
#include "scenes/plant.hpp"
#include "scenes/plant_answer.hpp"

namespace {

using impinge::scenes::parse_whole;
using impinge::scenes::Plant;
using impinge::scenes::PlantPair;

bool write_list(const Plant& plant, const char* path) {
  std::ofstream file(path);
  file << "first;second;verdict;nearest at least;nearest at most;what was planted;in a turned bay\n";
  for (const PlantPair& pair : plant.pairs) {
    file << plant.names[pair.first] << ';' << plant.names[pair.second] << ';'
         << impinge::scenes::in_words(pair.verdict, pair.inner) << ';' << pair.distance.lo << ';' << pair.distance.hi
         << ';' << pair.family << ';' << plant.is_turned[plant.bays[pair.first]] << '\n';
  }
  return static_cast<bool>(file.flush());
}

}  // namespace

int main(int argc, char** argv) {
  int parts = 0;
  std::uint64_t seed = 0;
  if (argc < 4 || argc > 5 || !parse_whole(argv[1], parts) || parts <= 0 || !parse_whole(argv[2], seed)) {
    std::fprintf(stderr, "usage: %s PARTS SEED FILE.glb [LIST.csv]\n", argv[0]);
    return 2;
  }
  const Plant plant = impinge::scenes::plant(parts, {.seed = seed});
  std::ofstream file(argv[3], std::ios::binary);
  file << impinge::scenes::glb_bytes(plant.scene, plant.names);
  if (!file.flush() || (argc == 5 && !write_list(plant, argv[4]))) {
    std::fprintf(stderr, "%s: %s cannot be written, or the list\n", argv[0], argv[3]);
    return 1;
  }
}
