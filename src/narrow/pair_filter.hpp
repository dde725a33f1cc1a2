// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "impinge/contacts.hpp"
#include "partition/pair_stream.hpp"

namespace impinge::narrow {

/// What certified single precision makes of a stream: the pairs that certainly cross, and those left to more exact
/// arithmetic; the others are certainly apart.
struct Filtered {
  std::vector<TrianglePair> crossing, unsure;
};

/// Appends.
void filter_pairs(const partition::PairStream& stream, Filtered& filtered);
/// The same of one mesh's own triangles, by `PairStream::common`: left out are those that certainly share nothing
/// outside of the convex hull of their common corners.
void filter_self_pairs(const partition::PairStream& stream, Filtered& filtered);

}  // namespace impinge::narrow
