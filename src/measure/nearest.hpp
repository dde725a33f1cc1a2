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

/// Distances between placed meshes as sets of triangles (their surfaces, not the volumes that they enclose), by branch
/// and bound over their wide trees. A distance is a double with a bound of its error, which includes the rounding of
/// the points found; it is 0 if and only if the sets share a point, exactly.
namespace impinge::measure {

struct NearestPoint {
  double distance;  ///< from the given point; the true distance is within `error` of it
  double error;
  Vec3 point;  ///< on the triangle, up to rounding
  std::uint32_t triangle;
};

/// The point of the body nearest to `point`. Nothing if all are farther than `within`. Where the distance is below
/// `enough`, any point nearer than that may be given instead of the nearest. A search that was stopped finds nothing.
std::optional<NearestPoint> nearest_point(const hierarchy::PlacedTree& body, const Vec3& point, double within,
                                          double enough = 0, const std::stop_token& stop = {});

/// Calls take with each triangle of the body that is within a distance of a point, and perhaps with some that are
/// farther, in no particular order.
void near_triangles(const hierarchy::PlacedTree& body, const Vec3& point, double within,
                    const std::function<void(std::uint32_t)>& take);

struct NearestPair {
  double distance, error;
  Vec3 a, b;
  std::uint32_t triangle_a, triangle_b;
};

struct PairMemory;

/// How a search is run.
struct SearchMeans {
  ForEach for_each{};            ///< builds large nodes of the trees in parallel
  std::stop_token stop{};        ///< a search that was stopped finds nothing
  PairMemory* memory = nullptr;  ///< memory of an earlier search, which is reused (measure/pair_queue.hpp)
};

/// The nearest points of two bodies, by the same rules.
std::optional<NearestPair> nearest_pair(const hierarchy::PlacedTree& a, const hierarchy::PlacedTree& b, double within,
                                        double enough = 0, const SearchMeans& means = {});

/// Called with each pair of triangles that is found; returns false to end the search.
using TakePair = std::function<bool(const TrianglePair&)>;

/// Every pair of triangles whose distance is at most `within` (0: those that may share a point), and perhaps some that
/// are farther by a few roundings, once and in no particular order. A search that was stopped does not find all.
void near_pairs(const hierarchy::PlacedTree& a, const hierarchy::PlacedTree& b, double within, const TakePair& take,
                const std::stop_token& stop = {});

/// The same by the triangles' boxes alone, which finds more pairs.
void candidate_pairs(const hierarchy::PlacedTree& a, const hierarchy::PlacedTree& b, double within,
                     const TakePair& take, const std::stop_token& stop = {});

}  // namespace impinge::measure
