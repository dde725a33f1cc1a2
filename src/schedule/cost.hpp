// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/contacts.hpp"

namespace impinge::schedule {

/// The constants of the paper's equation 1, in seconds, and two more.
struct CostConstants {
  double box_test;      ///< C_v
  double element_test;  ///< C_p: an edge against a triangle
  double node;          ///< C_u: making a node of a tree
  double leaf_pair;     ///< C_l: laying the grid over two leaves
  double exact_call;    ///< C_e: a pair of triangles in the exact stage
};

/// Reads the constants off two runs of one query, of which the first made the trees' nodes and the second found them
/// made, and off one whose triangles touch in ways that only exact arithmetic can tell.
CostConstants constants_from(const Statistics& building, const Statistics& repeated, const Statistics& touching);

/// T = N_v C_v + N_p C_p + N_u C_u + N_l C_l + N_e C_e.
double predict_seconds(const Statistics& counts, const CostConstants& constants);

/// The part of a query that the cost function speaks of: the threads' time from the hierarchy to the exact stage.
double modelled_seconds(const Statistics& statistics);

}  // namespace impinge::schedule
