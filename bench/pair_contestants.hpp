// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "bench/contest.hpp"
#include "bench/peers/embree.hpp"
#include "bench/peers/fcl.hpp"
#include "scenes/contact_depth.hpp"

/// Every library, asked about two rigid copies of one mesh.
namespace impinge::bench {

/// The mesh in the terms of each library, trees built. Keeps a reference to the numbers.
struct Copies {
  explicit Copies(const scenes::MeshData& data);
  const scenes::MeshData& data;
  Mesh mesh;
  FclDebianMesh fcl;
  FclNativeMesh fcl_native;
  EmbreeBody embree_still, embree_moving;
};

struct PairQuestion {
  bool first = false;       ///< a yes or no for each pose, not every pair; libraries that cannot stop early stay out
  bool query_alone = true;  ///< also those that want a tree built for each pose beforehand
};

/// Question i is about `poses[i]`, which stay the caller's, as `copies` does. impinge comes first.
std::vector<Contestant> pair_contestants(Copies& copies, const std::vector<scenes::PosePair>& poses,
                                         const PairQuestion& question = {});

/// The same in the paper's experiment, with FCL compiled by the flags of impinge itself, the paper's way without its
/// grid, and the backends that need a device. Those are asked where there is one that is hardware;
/// IMPINGE_BENCH_SOFTWARE=1 takes a software driver too, to see whether everything works, and says so in their names.
std::vector<Contestant> paper_contestants(Copies& copies, const std::vector<scenes::PosePair>& poses);

/// The exact answers in the form of a `PairQuestion` with `first`: some pair where there is one.
std::vector<std::vector<TrianglePair>> yes_or_no(const std::vector<std::vector<TrianglePair>>& answers);

}  // namespace impinge::bench
