// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "impinge/options.hpp"

namespace impinge {

/// Triangle `a` of the row's first object and triangle `b` of its second.
struct TrianglePair {
  std::uint32_t a, b;
  friend bool operator==(const TrianglePair&, const TrianglePair&) = default;
};

/// What a query did and what it cost. Times are 0 unless `Options::statistics` asks for them or a device takes part;
/// those of stages add up the threads' own.
/// The cost function is the paper's equation 1 with terms for its broad phase and its grid, and one for exact
/// arithmetic, which came after it: T = N_b C_b + N_m C_m + N_s C_s + N_o C_o + N_v C_v + N_p C_p + N_u C_u + N_t C_t +
/// N_l C_l + N_e C_e.
struct Statistics {
  std::uint64_t object_pairs = 0;       ///< N_o: survivors of the broad phase; `collide_poses`: all rows
  std::uint64_t bounds_updated = 0;     ///< N_b: objects whose sorted borders were written; "paper" and "raster" only
  std::uint64_t border_moves = 0;       ///< N_m: of a border past another in sorting; "paper" and "raster" only
  std::uint64_t sphere_tests = 0;       ///< N_s: pairs of objects whose bounds were compared, but for `collide`'s one
  std::uint64_t box_tests = 0;          ///< N_v: pairs of bounding volumes tested
  std::uint64_t element_tests = 0;      ///< N_p: pairs of triangles tested; of an edge and one by "paper" and "raster"
  std::uint64_t nodes_built = 0;        ///< N_u: tree nodes made by this query
  std::uint64_t triangles_sorted = 0;   ///< N_t: triangles below those nodes, each counted with every such node
  std::uint64_t leaf_pairs = 0;         ///< N_l: pairs of leaves that the walk could not separate
  std::uint64_t triangle_pairs = 0;     ///< pairs of triangles that the partition could not separate
  std::uint64_t exact_calls = 0;        ///< N_e: pairs of triangles that the narrow phase left undecided
  std::uint64_t images_drawn = 0;       ///< images of tests of edges and triangles; "raster" only
  std::uint64_t images_overlapped = 0;  ///< of them, those begun before the CPU had waited for the one before
  std::uint64_t images_read = 0;        ///< of them, those whose occlusion query saw a test that is not certainly apart
  double bounds_update_seconds = 0;     ///< C_b, calibrated on this machine; 0 unless `Options::predict_cost`
  double border_move_seconds = 0;       ///< C_m, likewise
  double sphere_test_seconds = 0;       ///< C_s, likewise
  double object_pair_seconds = 0;       ///< C_o, likewise
  double box_test_seconds = 0;          ///< C_v, likewise
  double element_test_seconds = 0;      ///< C_p, likewise
  double node_seconds = 0;              ///< C_u, likewise
  double sorted_triangle_seconds = 0;   ///< C_t, likewise
  double leaf_pair_seconds = 0;         ///< C_l, likewise
  double exact_call_seconds = 0;        ///< C_e, likewise
  double predicted_seconds = 0;         ///< T; 0 unless `Options::predict_cost`
  double measured_seconds = 0;          ///< from the broad phase to the exact stage: the part that T speaks of
  double device_predicted_seconds = 0;  ///< of the device's part, by constants of its own; 0 unless `predict_cost`
  double device_seconds = 0;            ///< what the device's part took, by the clock; the counts above include it
  double device_wait_seconds = 0;       ///< of these, while whoever served it did nothing but wait
  double cpu_seconds = 0;               ///< where "hybrid" lets both take work: of the CPU's part, by the clock
  double broad_seconds = 0;
  double hierarchy_seconds = 0;
  double partition_seconds = 0;
  double narrow_seconds = 0;
  double exact_seconds = 0;
  double results_seconds = 0;
  double total_seconds = 0;  ///< wall clock of the whole query
};

/// Every pair of triangles that touch: compressed rows, a row a pair of objects that touch, in canonical order
/// (object, object, triangle, triangle).
struct Contacts {
  std::vector<std::array<std::uint32_t, 2>> objects;  ///< per row, the lower object first
  std::vector<std::uint64_t> offsets{0};              ///< rows + 1; row r holds [offsets[r], offsets[r + 1])
  std::vector<TrianglePair> triangles;                ///< per contact
  std::vector<Kind> kinds;                            ///< per contact
  bool truncated = false;                             ///< more contacts exist than `Options::limit` kept
  bool partial = false;                               ///< `Find::first`, or not all kinds, was asked for
  std::uint64_t hash = 0;                             ///< of the kept contacts (docs/hash.md); 0 with `Find::first`
  Statistics statistics;
  std::vector<std::string> warnings;  ///< a device that was left out, and why; the answer is whole all the same
};

}  // namespace impinge
