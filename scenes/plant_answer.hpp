// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "impinge/clash.hpp"
#include "scenes/plant.hpp"

/// An answer held against a plant's list.
namespace impinge::scenes {

struct PlantQuestion {
  double clearance = kPlantClearance;  ///< that was asked for, at most kPlantClearance
  double slack = 1e-6;                 ///< how far distances may be off what was planted, by roundings of poses
};

struct PlantScore {
  std::size_t planted = 0, right = 0;
};

struct PlantAnswer {
  std::vector<std::string> faults;                ///< a sentence for each pair that is missing, wrong, or too much
  std::map<std::string_view, PlantScore> scores;  ///< by family
};

/// `pairs` by (object, object), objects in the plant's order.
PlantAnswer compare(const Plant& plant, std::span<const Clash> pairs, const PlantQuestion& question = {});

/// "inside, the first in the second" and so on.
std::string in_words(Verdict verdict, int inner);

}  // namespace impinge::scenes
