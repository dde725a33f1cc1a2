// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/plant.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>

#include "scenes/motion.hpp"
#include "scenes/plant_bays.hpp"

namespace impinge::scenes {
namespace {

constexpr double kSlot = 8000;

std::array<double, 9> matrix(Turn turn) {
  switch (turn) {
    case Turn::upright:
      break;
    case Turn::along_x:
      return {0, 0, 1, 1, 0, 0, 0, 1, 0};
    case Turn::against_x:
      return {0, 0, -1, 1, 0, 0, 0, -1, 0};
    case Turn::along_y:
      return {-1, 0, 0, 0, 0, 1, 0, 1, 0};
    case Turn::down:
      return {1, 0, 0, 0, -1, 0, 0, 0, -1};
  }
  return {1, 0, 0, 0, 1, 0, 0, 0, 1};
}

std::array<double, 9> quarter_turn(int quarters) {
  const double c = quarters == 0 ? 1 : quarters == 2 ? -1 : 0, s = quarters == 1 ? 1 : quarters == 3 ? -1 : 0;
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}

/// The part's pose, then the bay's. Without rounding where the bay's rotation is a quarter turn: the part's is one.
Pose placed(const Pose& bay, const BayPart& part) {
  const std::array<double, 9> turn = matrix(part.turn);
  Pose pose;
  for (std::size_t i = 0; i < 3; ++i) {
    pose.t[i] = bay.t[i];
    for (std::size_t k = 0; k < 3; ++k) {
      pose.t[i] += bay.R[3 * i + k] * part.at[k];
      pose.R[3 * i + k] = 0;
      for (std::size_t j = 0; j < 3; ++j) pose.R[3 * i + k] += bay.R[3 * i + j] * turn[3 * j + k];
    }
  }
  return pose;
}

std::string name_of(const BayPart& part, std::size_t number) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*s-%05zu %.*s", static_cast<int>(part.code.size()), part.code.data(), number,
                static_cast<int>(part.kind.size()), part.kind.data());
  return text;
}

class Builder {
 public:
  Builder(int parts, const PlantOptions& options)
      : wanted_(static_cast<std::size_t>(parts)), options_(options), random_(options.seed) {
    constexpr std::size_t kFewestParts = 25;  // of a bay, about
    side_ = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(wanted_) / kFewestParts + 1)));
  }

  Plant build() {
    while (plant_.names.size() < wanted_) {
      Bay bay(catalogue_, random_);
      const std::size_t missing = wanted_ - plant_.names.size();
      fill(bay);
      if (bay.parts.size() > missing) {
        bay.parts.clear();
        bay.pairs.clear();
        store_bay(bay, static_cast<int>(std::min<std::size_t>(missing, kStoreParts)));
      }
      place(bay);
    }
    plant_.scene.meshes = catalogue_.take();
    std::sort(plant_.pairs.begin(), plant_.pairs.end(), [](const PlantPair& a, const PlantPair& b) {
      return a.first != b.first ? a.first < b.first : a.second < b.second;
    });
    return std::move(plant_);
  }

 private:
  void fill(Bay& bay) {
    const double kind = random_.unit();
    if (kind < 0.4) return line_bay(bay);
    if (kind < 0.55) return rack_bay(bay);
    if (kind < 0.8) return frame_bay(bay);
    if (kind < 0.9) return vessel_bay(bay);
    cells_bay(bay);
  }

  Pose next_slot(bool is_turned) {
    const std::size_t slot = plant_.is_turned.size();
    Pose pose;
    pose.R = is_turned ? random_rotation(random_) : quarter_turn(random_.integer(0, 3));
    pose.t = {(static_cast<double>(slot % side_) + 0.5) * kSlot,
              (static_cast<double>(slot / side_ % side_) + 0.5) * kSlot,
              (static_cast<double>(slot / side_ / side_) + 0.5) * kSlot};
    return pose;
  }

  void place(const Bay& bay) {
    const bool is_turned = random_.unit() < options_.turned;
    const Pose pose = next_slot(is_turned);
    const auto first = static_cast<std::uint32_t>(plant_.names.size());
    for (const BayPart& part : bay.parts) {
      plant_.scene.objects.push_back({.mesh = part.mesh, .pose = placed(pose, part)});
      plant_.names.push_back(name_of(part, plant_.names.size()));
      plant_.bays.push_back(static_cast<std::uint32_t>(plant_.is_turned.size()));
    }
    for (PlantPair pair : bay.pairs) {
      pair.first += first;
      pair.second += first;
      plant_.pairs.push_back(pair);
    }
    plant_.is_turned.push_back(is_turned);
  }

  std::size_t wanted_;
  PlantOptions options_;
  Random random_;
  Catalogue catalogue_;
  std::size_t side_;
  Plant plant_;
};

}  // namespace

Plant plant(int parts, const PlantOptions& options) { return Builder(parts, options).build(); }

}  // namespace impinge::scenes
