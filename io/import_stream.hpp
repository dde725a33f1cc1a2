// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "impinge/io.hpp"
#include "impinge/result.hpp"

/// What impinge-import writes and its parent reads, over a pipe on one machine: a magic word, then records. A record is
/// a letter and its fields. Numbers are 32-bit or 64-bit unsigned integers and doubles in the machine's byte order; a
/// text is its length (32 bits) and its bytes.
///
///     "impinge6"
///     'M' mesh     vertices (64), triangles (64), 3 doubles a vertex, 3 indices (32) a triangle
///     'G' group    name; parent (32)
///     'O' object   name, path, product: texts; mesh, node, group (32 each), 16 doubles: the world matrix, row-major
///     'P' property of the last 'O': name, value: texts
///     'I' lost     of the last 'O': text: what of its shape is left out
///     'L' unit     double: metres in one of the file's units of length
///     'D' places   no field: the world matrices never were 32-bit floats
///     'R' grid     name, storey: texts; axes (32), and for each tag: text; family (32), points (64), 3 doubles each
///     'N' node     parent (32), 16 doubles: its matrix to its parent; 3 doubles: scale, 4: rotation, 3: translation
///     'A' anim     name; double: seconds
///     'T' track    of the last 'A': node, property, between (32 each), keys (64), a double a key, and the values
///     'U' lost     of the last 'A': node, what (32 each), text: what it does and no track says
///     'W' warning  text
///     'X' missing  text: what of the file is in no mesh
///     'E' error    text; nothing follows
///     'Z' end      nothing follows; a stream without it or an error is incomplete
///
/// Meshes, nodes and groups are numbered in the order in which they come, each before those that speak of it; kNoNode
/// is none. Only files with animations have nodes.
namespace impinge::io {

inline constexpr std::uint32_t kNoNode = 0xFFFFFFFF;

struct ImportedMesh {
  std::vector<double> xyz;
  std::vector<std::uint32_t> triangles;
};
struct ImportedGroup {
  std::string name;
  std::uint32_t parent;
};
struct ImportedObject {
  std::string name, path, product;
  std::uint32_t mesh, node, group;
  std::array<double, 16> world;
  std::vector<std::pair<std::string, std::string>> properties;
  std::string incomplete;
};
struct ImportedNode {
  std::uint32_t parent;
  std::array<double, 16> local;
  std::array<double, 3> scale;
  std::array<double, 4> rotation;
  std::array<double, 3> translation;
};
struct Imported {
  std::vector<ImportedMesh> meshes;
  std::vector<ImportedObject> objects;
  std::vector<ImportedNode> nodes;
  std::vector<ImportedGroup> groups;
  std::vector<Animation> animations;
  std::vector<Grid> grids;
  std::vector<std::string> warnings, missing;
  std::optional<double> unit_in_metres;
  bool exact_places = false;
  std::string error;  ///< not empty: the importer's own reason why there is no answer
};

/// Writes records to a file descriptor. The first failed write makes all others do nothing.
class ImportWriter {
 public:
  explicit ImportWriter(int descriptor);
  void mesh(std::span<const double> xyz, std::span<const std::uint32_t> triangles);
  void group(std::string_view name, std::uint32_t parent);
  void object(std::string_view name, std::string_view path, std::string_view product, std::uint32_t mesh,
              std::uint32_t node, std::uint32_t group, const std::array<double, 16>& world);
  void node(const ImportedNode& node);
  void animation(const Animation& animation);
  void grid(const Grid& grid);
  void property(std::string_view name, std::string_view value);
  void incomplete(std::string_view text);
  void unit(double metres);
  void exact_places();
  void warning(std::string_view text);
  void missing(std::string_view text);
  void error(std::string_view text);
  /// Ends the stream; false if anything could not be written.
  bool end();

 private:
  void bytes(const void* data, std::size_t count);
  void field(std::string_view text);
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void field(const T& value) { bytes(&value, sizeof value); }
  template <class... Fields>
  void record(char letter, const Fields&... fields);
  void flush();

  int descriptor_;
  bool failed_ = false;
  std::string buffer_;
};

/// Reads a stream. Every size is checked against the bytes that are there before anything is allocated, every index
/// against what it counts. Errors: `bad_file`, with half a sentence that says what is wrong with the stream.
Result<Imported> decode_import(std::string_view stream);

}  // namespace impinge::io
