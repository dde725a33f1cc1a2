// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// impinge_oracle [--rational] SCENE SET: reads a scene (scenes/scene_file.hpp) and writes every pair of triangles of
/// different objects that touch, by exact arithmetic that is not impinge's.
#include <iostream>
#include <string>

#include "decide.hpp"
#include "read_scene.hpp"

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool rational = !arguments.empty() && arguments.front() == "--rational";
  if (rational) arguments.erase(arguments.begin());
  if (arguments.size() != 2) {
    std::cerr << "usage: impinge_oracle [--rational] SCENE SET\n";
    return 2;
  }
  const auto objects = oracle::read_scene(arguments[0]);
  if (!objects) {
    std::cerr << arguments[0] << ": not a scene that the oracle can read.\n";
    return 2;
  }
  oracle::Counts counts;
  const auto contacts = rational ? oracle::contacts_by_rationals(*objects) : oracle::contacts_of(*objects, counts);
  if (!oracle::write_contacts(arguments[1], contacts)) {
    std::cerr << arguments[1] << ": cannot be written.\n";
    return 2;
  }
  if (!rational)
    std::cout << contacts.size() << " contacts, " << counts.candidates << " candidates, " << counts.rationals
              << " decided by rationals\n";
  return 0;
}
