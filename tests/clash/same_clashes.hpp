// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "impinge/clash.hpp"

/// Fails where two clashes, or two whole answers, differ in any number.
namespace impinge::test {

inline std::string text(const Interval& interval) {
  return std::to_string(interval.lo) + ".." + std::to_string(interval.hi);
}

inline void expect_same(const PartFacts& p, const PartFacts& q) {
  EXPECT_EQ(p.closed, q.closed);
  EXPECT_EQ(p.part_class, q.part_class);
  EXPECT_EQ(p.pieces, q.pieces);
  EXPECT_EQ(p.turned, q.turned);
  EXPECT_EQ(p.unclear_edges, q.unclear_edges);
  EXPECT_EQ(p.unclear_edge, q.unclear_edge);
  EXPECT_EQ(p.open_edges, q.open_edges);
  EXPECT_EQ(p.self_crossings, q.self_crossings);
  EXPECT_EQ(p.degenerate, q.degenerate);
  EXPECT_EQ(p.open_edge, q.open_edge);
  ASSERT_EQ(p.self_crossing.has_value(), q.self_crossing.has_value());
  if (p.self_crossing) {
    EXPECT_EQ(p.self_crossing->a, q.self_crossing->a);
    EXPECT_EQ(p.self_crossing->b, q.self_crossing->b);
  }
  EXPECT_EQ(p.volume, q.volume);
  EXPECT_EQ(p.area, q.area);
  EXPECT_EQ(p.radius, q.radius);
}

inline void expect_same(const Region& p, const Region& q) {
  EXPECT_EQ(p.pairs, q.pairs);
  EXPECT_EQ(p.box, q.box);
  EXPECT_EQ(p.area, q.area);
  EXPECT_EQ(p.length, q.length);
  EXPECT_EQ(p.centroid, q.centroid);
  EXPECT_EQ(p.normal, q.normal);
  EXPECT_EQ(p.lines, q.lines);
  EXPECT_EQ(p.triangles_a, q.triangles_a);
  EXPECT_EQ(p.triangles_b, q.triangles_b);
}

inline void expect_same(const Clash& p, const Clash& q) {
  ASSERT_EQ(p.objects, q.objects);
  EXPECT_EQ(p.test, q.test);
  EXPECT_EQ(p.verdict, q.verdict);
  EXPECT_EQ(p.inner, q.inner);
  EXPECT_EQ(p.note, q.note);
  EXPECT_EQ(p.tolerance, q.tolerance);
  EXPECT_EQ(p.fails_below, q.fails_below);
  EXPECT_EQ(p.contacts, q.contacts);
  ASSERT_EQ(p.nearest.has_value(), q.nearest.has_value());
  if (p.nearest) {
    EXPECT_EQ(p.nearest->distance, q.nearest->distance);
    EXPECT_EQ(p.nearest->a, q.nearest->a);
    EXPECT_EQ(p.nearest->b, q.nearest->b);
  }
  ASSERT_EQ(p.overlap_depth.has_value(), q.overlap_depth.has_value());
  if (p.overlap_depth) {
    EXPECT_EQ(text(p.overlap_depth->a_in_b), text(q.overlap_depth->a_in_b));
    EXPECT_EQ(text(p.overlap_depth->b_in_a), text(q.overlap_depth->b_in_a));
  }
  ASSERT_EQ(p.overlap_volume.has_value(), q.overlap_volume.has_value());
  if (p.overlap_volume) {
    EXPECT_EQ(p.overlap_volume->volume, q.overlap_volume->volume);
    EXPECT_EQ(p.overlap_volume->error, q.overlap_volume->error);
  }
  ASSERT_EQ(p.regions.size(), q.regions.size());
  for (std::size_t i = 0; i < p.regions.size(); ++i) expect_same(p.regions[i], q.regions[i]);
}

inline void expect_same(const Clashes& expected, const Clashes& found) {
  EXPECT_EQ(expected.candidates, found.candidates);
  ASSERT_EQ(expected.parts.size(), found.parts.size());
  for (std::size_t i = 0; i < expected.parts.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same(expected.parts[i], found.parts[i]);
  }
  ASSERT_EQ(expected.pairs.size(), found.pairs.size());
  for (std::size_t i = 0; i < expected.pairs.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same(expected.pairs[i], found.pairs[i]);
  }
}

}  // namespace impinge::test
