// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "impinge/io.hpp"
#include "io/text.hpp"

/// The way from a reader's polygons to a `Model`.
namespace impinge::io {

/// An object as its reader found it.
struct Part {
  std::string name;                    ///< empty: the file gives none
  std::vector<std::uint32_t> corners;  ///< indices of vertices, polygon after polygon
  std::vector<std::uint32_t> sizes;    ///< corners of each polygon
};

/// What a reader found. Every corner is the index of a vertex, every coordinate is finite.
struct Parts {
  std::vector<double> xyz;
  std::vector<Part> parts;
  bool floats = false;  ///< the coordinates passed through 32-bit floats
  std::vector<std::string> warnings;
};

/// Triangulates each part and makes an object of it; parts without a triangle are left out. Where several parts share
/// the vertices, each mesh gets those that it uses, in the file's order.
Result<Model> make_model(const Source& source, Parts&& parts);

/// Gives objects of the same name a number: "bolt", "bolt (2)", "bolt (3)".
void make_names_unique(std::vector<Object>& objects);

}  // namespace impinge::io
