// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "impinge/mesh.hpp"
#include "impinge/result.hpp"

/// Mesh files: OBJ, OFF, PLY and STL by readers of our own, in double; glTF, 3MF, COLLADA, IFC, FBX and the rest by
/// assimp in a child process with limits on time and memory. Link `impinge::io`.
namespace impinge::io {

/// A mesh node of a file: all its triangles together.
struct Object {
  std::string name;     ///< one that a person finds again, unique in the file
  std::string path;     ///< the given names from the root to the node, '/' between them
  std::string product;  ///< the IFC product that it is part of; empty elsewhere
  Mesh mesh;            ///< nodes that show the same mesh share it
  Pose pose;            ///< identity where the node's transform was baked into the mesh
};

struct Model {
  std::vector<Object> objects;        ///< in the file's order
  std::vector<std::string> warnings;  ///< sentences: lost precision, turned axes, changed units
};

struct ReadOptions {
  std::uint64_t max_file_bytes = 2'000'000'000;  ///< larger files are refused unread
  double scale = 1;                              ///< positive and finite; multiplies every coordinate of the file
  std::chrono::seconds time_limit{300};          ///< for the child process
  std::uint64_t memory_limit_bytes = std::uint64_t{8} << 30;  ///< for the child process
  std::filesystem::path importer{};  ///< the child's program; empty: beside the running program, or as installed
  std::stop_token stop{};            ///< ends the child process
};

/// Reads a mesh file; the format is told by the name's ending. Errors: `bad_file` (the sentence names the file, the
/// line or byte, and the mend), `bad_option` (scale), `cancelled`, `out_of_memory`.
Result<Model> read(const std::filesystem::path& file, const ReadOptions& options = {});

/// The readers alone, on bytes in memory; `name` stands for the file in messages and names its only object.
Result<Model> read_obj(std::string_view bytes, std::string_view name);
Result<Model> read_off(std::string_view bytes, std::string_view name);
Result<Model> read_ply(std::string_view bytes, std::string_view name);
Result<Model> read_stl(std::string_view bytes, std::string_view name);

}  // namespace impinge::io
