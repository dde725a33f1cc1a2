// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "partition/sweep.hpp"

namespace impinge::partition {

/// Lays the paper's grid over the overlap of the two leaves at hand, in the frame of A's, and maps their triangles to
/// its cells, which are as large as the mean box of the triangles there.
void map_to_cells(SweepState& state);

}  // namespace impinge::partition
