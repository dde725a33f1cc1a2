// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

#include "impinge/clash.hpp"
#include "scenes/motion.hpp"
#include "tests/core/support.hpp"

namespace impinge::test {

inline Clash judged(const scenes::MeshData& a, const scenes::MeshData& b, const Pose& pose,
                    std::optional<double> tolerance) {
  return judge(mesh_of(a), pose, mesh_of(b), pose, {.tolerance = tolerance}).value();
}

/// As the parts are and exchanged, exchanged after a rigid motion, and after another one as they were.
inline void expect_verdict(Verdict verdict, const scenes::MeshData& a, const scenes::MeshData& b,
                           std::optional<double> tolerance = std::nullopt, std::optional<Note> note = std::nullopt) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Seeded seeded(seed);
    const Pose pose = seed < 2 ? Pose{} : scenes::random_motion(seeded.random, 30);
    const Clash clash = seed % 2 == 1 ? judged(b, a, pose, tolerance) : judged(a, b, pose, tolerance);
    EXPECT_EQ(name(clash.verdict), name(verdict)) << sentence(clash.note);
    if (note) {
      EXPECT_EQ(sentence(clash.note), sentence(*note));
    }
  }
}

}  // namespace impinge::test
