// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "impinge/contacts.hpp"

namespace impinge::schedule {

/// The constants of the cost function, in seconds: of the paper's equation 1 (C_v, C_p, C_u), and of what it leaves
/// out.
struct CostConstants {
  double bounds_update;    ///< C_b: writing an object's sorted borders
  double border_move;      ///< C_m: moving a border past another
  double sphere_test;      ///< C_s: comparing the bounds of two objects
  double object_pair;      ///< C_o: beginning with a pair of objects
  double box_test;         ///< C_v
  double element_test;     ///< C_p: an edge against a triangle
  double node;             ///< C_u: making a node of a tree
  double sorted_triangle;  ///< C_t: sorting a triangle into a node that is made
  double leaf_pair;        ///< C_l: laying the grid over two leaves
  double exact_call;       ///< C_e: a pair of triangles in the exact stage
};

/// A term of the cost function.
struct CostTerm {
  std::uint64_t Statistics::*count;
  double Statistics::*seconds;  ///< where a query reports the constant
  double CostConstants::*constant;
};
inline constexpr std::array kCostTerms{
    CostTerm{&Statistics::bounds_updated, &Statistics::bounds_update_seconds, &CostConstants::bounds_update},
    CostTerm{&Statistics::border_moves, &Statistics::border_move_seconds, &CostConstants::border_move},
    CostTerm{&Statistics::sphere_tests, &Statistics::sphere_test_seconds, &CostConstants::sphere_test},
    CostTerm{&Statistics::object_pairs, &Statistics::object_pair_seconds, &CostConstants::object_pair},
    CostTerm{&Statistics::box_tests, &Statistics::box_test_seconds, &CostConstants::box_test},
    CostTerm{&Statistics::element_tests, &Statistics::element_test_seconds, &CostConstants::element_test},
    CostTerm{&Statistics::nodes_built, &Statistics::node_seconds, &CostConstants::node},
    CostTerm{&Statistics::triangles_sorted, &Statistics::sorted_triangle_seconds, &CostConstants::sorted_triangle},
    CostTerm{&Statistics::leaf_pairs, &Statistics::leaf_pair_seconds, &CostConstants::leaf_pair},
    CostTerm{&Statistics::exact_calls, &Statistics::exact_call_seconds, &CostConstants::exact_call},
};

/// A query that made nodes of trees, and the same again, which found them made.
struct CostRuns {
  Statistics building, repeated;
};

/// Reads the constants of all stages after the broad phase off two queries, of which one makes few nodes and the other
/// many, and off one whose triangles touch in ways that only exact arithmetic can tell.
CostConstants constants_from(const CostRuns& light, const CostRuns& deep, const Statistics& touching);

/// T, the sum of the terms.
double predict_seconds(const Statistics& counts, const CostConstants& constants);

/// The part of a query that the cost function speaks of: the threads' time from the broad phase to the exact stage.
double modelled_seconds(const Statistics& statistics);

}  // namespace impinge::schedule
