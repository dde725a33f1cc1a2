// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Parts that are hardly any: each pair gets a verdict or a sentence, and an end.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "core/vec3.hpp"
#include "impinge/clash.hpp"
#include "judged_at_once.hpp"
#include "scenes/damaged.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::MeshData;
using test::fails, test::judged_at_once, test::Pair;

Mesh mesh_of(const std::vector<double>& xyz, const std::vector<std::uint32_t>& triangles) {
  return Mesh::create(std::span<const double>(xyz), triangles).value();
}

/// So many small cubes in each direction, all apart.
MeshData crowd(int nx, int ny, int nz, double shift) {
  MeshData result;
  const MeshData cube = scenes::box({0, 0, 0}, {0.5, 0.5, 0.5});
  for (int i = 0; i < nx * ny * nz; ++i)
    result = scenes::joined(std::move(result),
                            scenes::shifted(cube, shift + i % nx, shift + i / nx % ny, shift + i / nx / ny));
  return result;
}

struct BadInput {
  std::string name;
  Mesh mesh, other;
  bool is_far = false;  ///< out of range
  /// At each tolerance; nothing: whatever it is.
  std::optional<Verdict> verdict{};
  [[nodiscard]] bool is_large() const { return mesh.triangle_count() > 100'000; }
};

std::vector<BadInput> bad_input() {
  const Mesh block = test::mesh_of(scenes::cube());
  const auto scaled = [](const MeshData& mesh, double by, double shift) {
    return test::mesh_of(scenes::shifted(scenes::scaled(mesh, by, by, by), shift, shift, shift));
  };
  const MeshData apart = scenes::joined(scenes::box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}),
                                        scenes::inverted(scenes::box({2, 0, 0}, {3, 1, 1}))),
                 notched = scenes::block({0, 1e-3, 1}, {0, 1e-3, 1}, {0, 1e-3, 1});
  const Mesh shells = test::mesh_of(crowd(10, 10, 10, 0));
  return {
      {"no triangles", mesh_of({}, {}), block, false, Verdict::apart},
      {"vertices alone", mesh_of({0, 0, 0, 0.5, 0.5, 0.5}, {}), block, false, Verdict::apart},
      {"two without triangles", mesh_of({}, {}), mesh_of({}, {}), false, Verdict::apart},
      {"a triangle within", mesh_of({0.3, 0.3, 0.5, 0.7, 0.3, 0.5, 0.3, 0.7, 0.5}, {0, 1, 2}), block, false,
       Verdict::inside},
      {"a triangle across", mesh_of({0.5, 0.5, 0.5, 2, 0.5, 0.5, 0.5, 2, 0.5}, {0, 1, 2}), block, false,
       Verdict::crossing},
      {"two triangles", mesh_of({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}),
       mesh_of({0.2, 0.2, -1, 0.2, 0.2, 1, 1, 1, 0}, {0, 1, 2}), false, Verdict::crossing},
      {"one point as triangles", mesh_of({0.5, 0.5, 0.5}, {0, 0, 0, 0, 0, 0}), block},
      {"segments as triangles", mesh_of({0.5, 0.5, 0.5, 0.75, 0.5, 0.5, 2, 0.5, 0.5}, {0, 1, 2, 0, 1, 1}), block},
      {"degenerate against itself", mesh_of({0, 0, 0, 1, 1, 1}, {0, 1, 1}), mesh_of({0, 0, 0, 1, 1, 1}, {0, 1, 1})},
      {"small features far out", scaled(notched, 1, 1e6), scaled(notched, 1, 1e6 + 1e-3)},
      {"small parts far out", scaled(notched, 1e-3, 1e6), scaled(notched, 1e-3, 1e6 + 5e-4)},
      {"very far", scaled(scenes::cube(), 1, 1e200), block, true},
      {"very large", scaled(scenes::cube(), 1e200, 0), block, true},
      {"very small", scaled(scenes::cube(), 1e-200, 0), block, true},
      {"two shells of opposite winding", test::mesh_of(apart), block, false, Verdict::penetrating},
      {"a Moebius band", scaled(scenes::moebius_band(12), 0.5, 0.5), block},
      {"10,000 shells", test::mesh_of(crowd(25, 20, 20, 0)), test::mesh_of(crowd(25, 20, 20, 0.25)), false,
       Verdict::penetrating},
      {"1,000 shells in a block", shells, test::mesh_of(scenes::box({-1, -1, -1}, {30, 30, 30})), false,
       Verdict::inside},
      {"1,000 shells across a block", shells, test::mesh_of(scenes::box({-1, -1, -1}, {4.2, 30, 30})), false,
       Verdict::penetrating},
  };
}

TEST(BadInput, IsRefusedOrJudged) {
  for (const double wrong : {std::nan(""), kInfinity}) {
    const std::vector<double> xyz{0, 0, 0, 1, 0, 0, 0, wrong, 0};
    const Result<Mesh> refused = Mesh::create(std::span<const double>(xyz), std::vector<std::uint32_t>{0, 1, 2});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, Code::bad_mesh);
  }
  for (const BadInput& each : bad_input())
    for (const bool swapped : {false, true}) {
      if (swapped && each.is_large()) continue;
      SCOPED_TRACE(each.name + (swapped ? ", swapped" : ""));
      const Pair pair{"", swapped ? each.other : each.mesh, swapped ? each.mesh : each.other};
      const auto clashes = judged_at_once(pair, {std::nullopt, 0, 0.1});
      ASSERT_EQ(clashes.has_value(), !each.is_far);
      if (!clashes) {
        EXPECT_EQ(clashes.error().code, Code::out_of_range);
        EXPECT_NE(clashes.error().message.find("scale the scene"), std::string::npos);
        continue;
      }
      for (const Clash& clash : *clashes) {
        EXPECT_EQ(fails(clash), clash.tolerance < clash.fails_below) << "at " << clash.tolerance;
        if (each.verdict) {
          EXPECT_EQ(name(clash.verdict), name(*each.verdict)) << "at " << clash.tolerance;
        }
      }
    }
}

/// At once, or when pairs are about to be judged.
TEST(BadInput, IsNoLongerLookedAtOnceStopped) {
  for (const BadInput& each : bad_input()) {
    if (each.is_far) continue;
    SCOPED_TRACE(each.name);
    std::stop_source stop;
    stop.request_stop();
    const Result<Clash> clash = judge(each.mesh, {}, each.other, {}, {.stop = stop.get_token()});
    ASSERT_FALSE(clash);
    EXPECT_EQ(clash.error().code, Code::cancelled);
    const auto none = judged_at_once({"", each.mesh, each.other}, {0}, &stop);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, Code::cancelled);
    std::stop_source later;
    const auto some = judged_at_once({"", each.mesh, each.other}, {0}, &later);
    EXPECT_EQ(some.has_value(), !later.stop_requested());
    if (!some) {
      EXPECT_EQ(some.error().code, Code::cancelled);
    }
  }
}

}  // namespace
}  // namespace impinge
