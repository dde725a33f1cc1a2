// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "impinge/mesh.hpp"
#include "impinge/result.hpp"

/// Mesh files: OBJ, OFF, PLY and STL by readers of our own, in double; IFC by web-ifc, which needs Node.js, 3MF by
/// lib3mf, and glTF, COLLADA, FBX and the rest by assimp, all in a child process with limits on time and memory. Link
/// `impinge::io`.
namespace impinge::io {

/// A node that objects hang under, themselves or in other groups.
struct Group {
  std::string name;                     ///< as the file gives it; may be empty, and that of others
  std::optional<std::uint32_t> parent;  ///< an earlier one; nothing: the file's root
};

/// A mesh node of a file: all its triangles together.
struct Object {
  std::string name;                      ///< one that a person finds again, unique in the file
  std::string path;                      ///< for people: the given names from the root to the node, '/' between them
  std::string product;                   ///< the IFC product that it is part of; empty elsewhere
  Mesh mesh;                             ///< nodes that show the same mesh share it
  Pose pose;                             ///< identity where the node's transform was baked into the mesh
  std::optional<std::uint32_t> node{};   ///< of the model's nodes, where the file has animations
  bool is_baked = false;                 ///< the mesh is that of the node, mapped by where the node is at rest
  std::optional<std::uint32_t> group{};  ///< of the model's groups, that it hangs under; nothing: it is at the top
  /// Names and values, of IFC alone and those that the file gives: class, GlobalId, Tag, Description, ObjectType,
  /// space, storey, building, site, type, and one for each material, layer, system and group. With
  /// `ReadOptions::property_sets` also "Pset_WallCommon.FireRating" and so on; what a product lacks, its type has.
  std::vector<std::pair<std::string, std::string>> properties{};
  std::string incomplete{};  ///< part of a sentence, on what the reader left out of the shape; empty: nothing known
};

/// A node of an animated file.
struct Node {
  std::optional<std::uint32_t> parent;  ///< an earlier one; nothing: a root
  Affine local;                         ///< to its parent, at rest
  /// The same in parts, of a node that an animation moves: first scaled, then turned by the unit quaternion x y z w,
  /// then moved.
  std::array<double, 3> scale{1, 1, 1};
  std::array<double, 4> rotation{0, 0, 0, 1};
  std::array<double, 3> translation{};
};

/// How one part of a node's transform changes with time (glTF 2.0, section 3.11 and appendix C).
struct Track {
  enum class Property : std::uint8_t { translation, rotation, scale };
  enum class Between : std::uint8_t { step, linear, cubic };
  std::uint32_t node = 0;
  Property property = Property::translation;
  Between between = Between::linear;
  std::vector<double> times;  ///< seconds, ascending
  /// 3 of each key, or the 4 of a quaternion; with `cubic` its tangent from before, itself and its tangent to after.
  std::vector<double> values;
};

/// What an animation does and no track says: a channel that is broken, or one that changes shapes.
struct Unfollowed {
  enum class What : std::uint8_t { place, shape };
  What what = What::place;            ///< where the node is and all below it, or the shape of its own mesh
  std::optional<std::uint32_t> node;  ///< nothing: it is not known which
  std::string sentence;               ///< names the channel, and says what is wrong with it; without a full stop
};

struct Animation {
  std::string name;
  double seconds = 0;  ///< its last key's time; 0 only where it has no tracks, but something unfollowed
  std::vector<Track> tracks;
  std::vector<Unfollowed> unfollowed{};
};

/// An axis of a building's grid, in the coordinates of the objects.
struct GridAxis {
  std::string tag;            ///< "B"; empty: it has none
  std::uint32_t family = 0;   ///< 0 to 2: U, V, W of IfcGrid; axes of one family do not cross
  std::vector<Point> points;  ///< two or more, joined by straight lines; of a closed axis the last is the first
};

/// Axes by which people say where something is, of IFC alone.
struct Grid {
  std::string name;
  std::string storey;  ///< that it is for, by its name; empty: the whole building
  std::vector<GridAxis> axes;
};

struct Model {
  std::vector<Object> objects;        ///< in the file's order
  std::vector<std::string> warnings;  ///< sentences: lost precision, turned axes, changed units
  std::vector<std::string> missing;   ///< sentences: what of the file is not in the objects, and no answer is about
  std::vector<Node> nodes;            ///< of a file with animations, parents first
  std::vector<Group> groups;          ///< parents first
  std::vector<Animation> animations;
  std::optional<double> unit_in_metres{};  ///< metres in one of the units of the coordinates, where the file says it
  std::vector<Grid> grids{};               ///< without those of which some axis could not be read
};

/// Where each of the model's nodes is in the world at a time of an animation; before its first key and after its last
/// one, as there.
std::vector<Affine> nodes_at(const Model& model, const Animation& animation, double seconds);

/// The map that does b first, then a.
Affine product(const Affine& a, const Affine& b);

struct ReadOptions {
  std::uint64_t max_file_bytes = 2'000'000'000;  ///< larger files are refused unread
  /// Positive and finite; multiplies every coordinate of the file, whose unit is then unknown.
  double scale = 1;
  /// Without a scale: a file whose unit is known is brought to the one of so many metres.
  std::optional<double> unit_in_metres{};
  bool property_sets = false;                                 ///< of IFC, into the objects' properties
  std::chrono::seconds time_limit{300};                       ///< for the child process
  std::uint64_t memory_limit_bytes = std::uint64_t{8} << 30;  ///< for the child process
  std::filesystem::path importer{};  ///< the child's program; empty: beside the running program, or as installed
  std::stop_token stop{};            ///< ends the child process
};

/// Reads a mesh file; the format is told by the name's ending. Errors: `bad_file` (the sentence names the file, the
/// line or byte, and the mend), `bad_option` (scale), `cancelled`, `out_of_memory`.
Result<Model> read(const std::filesystem::path& file, const ReadOptions& options = {});

/// Brings a model whose unit is known to the one of so many metres, as `read` does by `ReadOptions::unit_in_metres`;
/// another stays as it is. Errors: `bad_file` (coordinates too large for it; the sentence names `file`),
/// `out_of_memory`; the model is of no use then.
Result<void> bring_to_unit(Model& model, double metres, const std::filesystem::path& file);

/// The readers alone, on bytes in memory; `name` stands for the file in messages, and for each object that it gives no
/// name.
Result<Model> read_obj(std::string_view bytes, std::string_view name);
Result<Model> read_off(std::string_view bytes, std::string_view name);
Result<Model> read_ply(std::string_view bytes, std::string_view name);
Result<Model> read_stl(std::string_view bytes, std::string_view name);

}  // namespace impinge::io
