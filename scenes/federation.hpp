// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "impinge/clash.hpp"

/// A building as four trades model it in IFC files of their own, with the verdict on every pair of its parts known from
/// how they were placed.
///
/// Architecture is IFC4 in millimetres, structure IFC2X3 in metres, ventilation IFC2X3 in feet and electrical IFC4 in
/// millimetres. The building is rooms, at least 0.4 m apart, of 20 parts each and 7 of 8 with one clash, by turns:
///   1  a duct through the web of an I-beam          penetrating
///   2  a pipe through a wall, without a sleeve       penetrating
///   3  a conduit within a wall that has a window     inside
///   4  a slab 0.2 m deep in a wall with an opening   penetrating
///   5  a column that architecture has too            duplicate
///   6  a cabinet that is 30 mm deep in a slab        penetrating
///   7  a pump that is 4 mm deep in a wall            penetrating
/// What fills openings, stands or hangs on something, or goes on in line, touches it; a pipe in a sleeve in a round
/// opening touches nothing.
namespace impinge::scenes {

struct FederationOptions {
  int storeys = 12, rooms = 25;          ///< rooms: of each storey
  std::array<int, 4> files{4, 3, 4, 3};  ///< of each trade, which takes its rooms by turns
  bool national_grid = false;            ///< 5e6 m away and turned, by the placement of the site
};

struct FederationPair {
  std::string a, b;  ///< names of parts, the lesser first
  Verdict verdict;
  double depth;        ///< in metres: how far one reaches into the other; of duplicates, their inner radius
  double fails_below;  ///< in metres, as in `Clash`: infinity if each goes through the other or lies in it
};

struct IfcFile {
  std::string name, text;
};

struct Federation {
  std::vector<IfcFile> files;
  std::vector<FederationPair> pairs;  ///< all that are not apart, by names
  int parts = 0;                      ///< of all files; no two have the same name
};

Federation federation(const FederationOptions& options = {});

}  // namespace impinge::scenes
