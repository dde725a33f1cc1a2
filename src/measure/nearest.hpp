// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>

#include "core/for_each.hpp"
#include "core/vec3.hpp"
#include "hierarchy/placed_tree.hpp"
#include "impinge/contacts.hpp"

/// Distances between placed meshes as sets of triangles (their surfaces; what they enclose does not count), by branch
/// and bound over their wide trees. A distance is a double with a bound on its error, in which the rounding of the
/// points found is counted; it is 0 if and only if the sets share a point, exactly.
namespace impinge::measure {

struct NearestPoint {
  double distance;  ///< from the point asked about; the true one is within `error` of it
  double error;
  Vec3 point;  ///< on the triangle, up to rounding
  std::uint32_t triangle;
};

/// The point of the body nearest to `point`. Nothing if all are farther than `within`. Where the distance is below
/// `enough`, any point nearer than that may be given instead of the nearest. A search that was stopped finds nothing.
std::optional<NearestPoint> nearest_point(const hierarchy::PlacedTree& body, const Vec3& point, double within,
                                          double enough = 0, const std::stop_token& stop = {});

struct NearestPair {
  double distance, error;
  Vec3 a, b;
  std::uint32_t triangle_a, triangle_b;
};

struct PairMemory;

/// How a search is run.
struct SearchMeans {
  ForEach for_each{};            ///< shares the making of large nodes
  std::stop_token stop{};        ///< a search that was stopped finds nothing
  PairMemory* memory = nullptr;  ///< of an earlier search, to be used again (measure/pair_queue.hpp)
};

/// The nearest points of two bodies; same rules.
std::optional<NearestPair> nearest_pair(const hierarchy::PlacedTree& a, const hierarchy::PlacedTree& b, double within,
                                        double enough = 0, const SearchMeans& means = {});

/// What is done with a pair of triangles that was found; false ends the search.
using TakePair = std::function<bool(const TrianglePair&)>;

/// Every pair of triangles whose distance is at most `within` (0: those that may share a point), and perhaps some that
/// are farther by a few roundings, once and in no particular order. A search that was stopped does not find all.
void near_pairs(const hierarchy::PlacedTree& a, const hierarchy::PlacedTree& b, double within, const TakePair& take,
                const std::stop_token& stop = {});

/// The same without looking at more than the triangles' boxes, so that there are more of them.
void candidate_pairs(const hierarchy::PlacedTree& a, const hierarchy::PlacedTree& b, double within,
                     const TakePair& take, const std::stop_token& stop = {});

}  // namespace impinge::measure
