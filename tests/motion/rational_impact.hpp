// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>

#include "impinge/mesh.hpp"

/// What moving features do, in GMP's rationals, slowly: Sturm sequences isolate the roots of the cubic, and the
/// features meet there by the signs of products with the normal itself, of degree four in time. It shares no code or
/// formula with the library's.
namespace impinge::oracle {

using Points = std::array<Point, 4>;  ///< a vertex and a face, or two edges

/// An interval of rationals that holds the first time and no other root, and is as narrow as asked for.
struct Time {
  mpq_class lo, hi;
};
enum class Features { vertex_face, edge_edge };

std::optional<Time> first_impact(Features features, const Points& from, const Points& to);

/// The distance's square at a time: the least of those of vertices and edges, of lines whose nearest points are on both
/// edges, and of a vertex and a plane whose nearest point is on the face.
mpq_class squared_distance(Features features, const Points& from, const Points& to, const mpq_class& time);

}  // namespace impinge::oracle
