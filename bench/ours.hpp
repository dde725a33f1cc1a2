// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "bench/support.hpp"
#include "impinge/collide.hpp"
#include "impinge/scene.hpp"
#include "scenes/contact_depth.hpp"

/// impinge as the benchmarks ask it.
namespace impinge::bench {

/// "simd" where this build and this machine have it, "auto" otherwise.
std::string_view fast_backend();

Options fast(int threads = 1);
/// On one thread, with the times of its stages.
Options timed();
/// The plain twin, with its times.
Options paper_way(int threads = 1);

/// Every pair of triangles, by the backend `paper`. Ends the program if the fast one answers anything else.
std::vector<TrianglePair> exact_answer(const Mesh& a, const Pose& pose_a, const Mesh& b, const Pose& pose_b);
Contacts exact_answer(const Scene& scene);
/// Two copies of a mesh, pose by pose; question i of a contest.
std::vector<std::vector<TrianglePair>> exact_answers(const Mesh& mesh, const std::vector<scenes::PosePair>& poses);

/// (object, object, triangle, triangle), sorted.
std::vector<std::array<std::uint32_t, 4>> flat(const Contacts& contacts);

}  // namespace impinge::bench
