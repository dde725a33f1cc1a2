// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bench/support.hpp"

/// Micro-benchmarks by Google Benchmark. Each counts its items, so that the table shows the time of one.
namespace impinge::bench {

void register_exact_benchmarks();
void register_box_benchmarks();
/// `count` points located at a time, and a tenth as many at a surface.
void register_point_benchmarks(int count);
/// `objects` in the scene.
void register_broad_benchmarks(int objects);
/// The paper's sorted borders of 10,000 drifting spheres, repaired after frames of several speeds.
Table border_moves(int frames);

}  // namespace impinge::bench
