// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "io/import_stream.hpp"

namespace impinge::importer {

/// Reads a file by assimp and writes its meshes, objects and warnings; the caller ends the stream. An object is a node
/// that shows triangles, in depth-first order, parents first; its mesh is all its meshes' triangles in their order.
/// Nodes that show the same meshes share one. Polygons are cut by assimp; points and lines are left out.
/// The world matrix is the product of the nodes' matrices from the root down, parent * local, in double, every entry
/// summed from left to right. Returns an empty text, or why the file has no answer.
std::string write_scene(const char* file, io::ImportWriter& writer);

}  // namespace impinge::importer
