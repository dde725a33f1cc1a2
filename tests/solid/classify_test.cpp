// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/classify.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stop_token>
#include <thread>

#include "scenes/damaged.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/solid/placed.hpp"

namespace impinge {
namespace {

using Pieces = std::array<std::uint32_t, 3>;

solid::Classification classified(const scenes::MeshData& shape, const Pose& pose = {}) {
  const Mesh mesh = test::mesh_of(shape);
  const solid::Body body = solid::make_body(mesh.state().placed(pose));
  return solid::classify(body, solid::examine(body), {});
}

TEST(Classify, DamagedSolidsAreSolidOrCrackedWhatTheyWere) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const scenes::DamagedSolid& solid : scenes::damaged_solids(seed)) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << solid.name);
      const solid::Classification found = classified(solid.damaged);
      EXPECT_EQ(found.best, solid.is_open ? PartClass::cracked : PartClass::solid);
      EXPECT_EQ(found.counts(), (solid.is_open ? Pieces{0, 1, 0} : Pieces{1, 0, 0}));
      EXPECT_EQ(found.unclear_edges, 0U);
    }
}

TEST(Classify, OpenShapesStaySurfaces) {
  for (const scenes::OpenShape& shape : scenes::open_shapes()) {
    SCOPED_TRACE(shape.name);
    const solid::Classification found = classified(shape.mesh);
    EXPECT_EQ(found.best, PartClass::surface);
    EXPECT_EQ(found.counts(), (Pieces{0, 0, 1}));
    // Also where a large cracked block is in the same part: its open edges are longer than those of the duct's ends.
    scenes::Random random(1);
    const scenes::MeshData block =
        scenes::faces_apart(scenes::box({-200, -200, -200}, {-160, -160, -160}, 4), 1e-4, random);
    if (shape.name.starts_with("two-sided")) continue;  // closed, and so a piece of its own
    const solid::Classification beside = classified(scenes::joined(scenes::scaled(shape.mesh, 10, 10, 10), block));
    EXPECT_NE(beside.best, PartClass::solid);
  }
}

TEST(Classify, TurnsTheLesserAreaAndWhatWindsNegatively) {
  scenes::MeshData block = scenes::box({0, 0, 0}, {1, 1, 1}, 2);
  EXPECT_EQ(classified(block).turned, 0U);
  std::swap(block.triangles[0], block.triangles[1]);
  EXPECT_EQ(classified(block).turned, 1U);
  EXPECT_EQ(classified(scenes::inverted(block)).turned, block.triangle_count() - 1);
  // Two shells of opposite orientation: one of them is turned.
  const scenes::MeshData both =
      scenes::joined(scenes::cube(), scenes::inverted(scenes::shifted(scenes::cube(), 3, 0, 0)));
  EXPECT_EQ(classified(both).turned, 12U);
  EXPECT_EQ(classified(both).counts(), (Pieces{2, 0, 0}));
}

TEST(Classify, ACavityIsOnePieceWithItsShellAndTurnsWithIt) {
  const scenes::MeshData shell = scenes::box({0, 0, 0}, {4, 4, 4}), hole = scenes::box({1, 1, 1}, {3, 3, 3});
  const scenes::MeshData core = scenes::shifted(scenes::cube(), 1.5, 1.5, 1.5);
  const scenes::MeshData hollow = scenes::joined(scenes::joined(shell, scenes::inverted(hole)), core);
  EXPECT_EQ(classified(hollow).counts(), (Pieces{1, 0, 0}));
  EXPECT_EQ(classified(hollow).turned, 0U);
  EXPECT_EQ(classified(scenes::inverted(hollow)).counts(), (Pieces{1, 0, 0}));
  EXPECT_EQ(classified(scenes::inverted(hollow)).turned, 36U);
  // A block across the shell is not within it.
  const scenes::MeshData across = scenes::joined(shell, scenes::inverted(scenes::box({1, 1, 1}, {3, 3, 5})));
  EXPECT_EQ(classified(across).counts(), (Pieces{2, 0, 0}));
  EXPECT_EQ(classified(across).turned, 12U);
}

TEST(Classify, PiecesOfEachClassAreCounted) {
  const scenes::MeshData sheet = scenes::shifted(scenes::flat_grid(3, 3), 10, 0, 0);
  EXPECT_EQ(classified(scenes::joined(scenes::cube(), sheet)).counts(), (Pieces{1, 0, 1}));
  scenes::Random random(3);
  const scenes::MeshData cracked = scenes::faces_apart(scenes::shifted(scenes::cube(), -5, 0, 0), 1e-4, random);
  const scenes::MeshData blocks = scenes::joined(scenes::cube(), scenes::shifted(scenes::cube(), 5, 0, 0));
  const solid::Classification found = classified(scenes::joined(blocks, cracked));
  EXPECT_EQ(found.counts(), (Pieces{2, 1, 0}));
  EXPECT_EQ(found.best, PartClass::solid);
}

TEST(Classify, WhatMeetsItselfIsSolid) {
  const scenes::MeshData across = scenes::joined(scenes::cube(), scenes::shifted(scenes::cube(), 0.5, 0.5, 0.5));
  EXPECT_EQ(classified(across).counts(), (Pieces{2, 0, 0}));
  // Twice the same, which winds twice around points.
  EXPECT_EQ(classified(scenes::joined(scenes::cube(), scenes::cube())).counts(), (Pieces{1, 0, 0}));
}

TEST(Classify, AMobiusBandIsASurfaceAndIsNotTurned) {
  const solid::Classification found = classified(scenes::moebius_band(24));
  EXPECT_EQ(found.best, PartClass::surface);
  EXPECT_EQ(found.turned, 0U);
}

TEST(Classify, FewOrDegenerateTrianglesAreSurfaces) {
  EXPECT_EQ(classified({}).best, PartClass::surface);
  scenes::MeshData one;
  one.add_triangle({0, 0, 0, 1, 0, 0, 0, 1, 0});
  EXPECT_EQ(classified(one).counts(), (Pieces{0, 0, 1}));
  scenes::MeshData segments;
  segments.add_triangle({0, 0, 0, 1, 0, 0, 2, 0, 0});
  segments.add_triangle({0, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(classified(segments).best, PartClass::surface);
  EXPECT_EQ(classified(scenes::two_sided(one)).best, PartClass::surface);
}

TEST(Classify, SizeAndPlaceDoNotMatter) {
  test::Seeded seeded(4);
  for (const scenes::DamagedSolid& solid : scenes::damaged_solids(4)) {
    if (solid.damaged.triangle_count() > 500) continue;
    SCOPED_TRACE(solid.name);
    const PartClass expected = solid.is_open ? PartClass::cracked : PartClass::solid;
    EXPECT_EQ(classified(scenes::scaled(solid.damaged, 0x1p-200, 0x1p-200, 0x1p-200)).best, expected);
    EXPECT_EQ(classified(scenes::scaled(solid.damaged, 0x1p250, 0x1p250, 0x1p250)).best, expected);
    EXPECT_EQ(classified(scenes::shuffled(solid.damaged, seeded.random)).best, expected);
  }
  // A plate thinner than single precision is still closed.
  EXPECT_EQ(classified(scenes::scaled(scenes::cube(), 1, 1, 0x1p-30)).best, PartClass::solid);
  EXPECT_EQ(classified(scenes::scaled(scenes::cube(), 1, 1, 0x1p-45)).best, PartClass::surface);
}

TEST(Classify, ManyShellsTakeTimeLinearInThem) {
  scenes::MeshData shells;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      for (int k = 0; k < 25; ++k)
        shells = scenes::joined(std::move(shells), scenes::shifted(scenes::cube(), 2 * i, 2 * j, 2 * k));
  EXPECT_EQ(classified(shells).counts(), (Pieces{10000, 0, 0}));
}

TEST(Classify, StopsWithinATenthOfASecond) {
  scenes::Random random(8);
  const Mesh mesh = test::mesh_of(scenes::faces_apart(scenes::uv_sphere(200, 100), 1e-5, random));
  const solid::Body body = solid::make_body(mesh.state().placed({}));
  const solid::Topology topology = solid::examine(body);
  std::stop_source source;
  std::chrono::steady_clock::time_point stopped;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stopped = std::chrono::steady_clock::now();
    source.request_stop();
  });
  solid::classify(body, topology, source.get_token());
  stopper.join();
  EXPECT_LT(std::chrono::steady_clock::now() - stopped, std::chrono::milliseconds(500));  // the machine may be busy
}

}  // namespace
}  // namespace impinge
