// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/gltf_check.hpp"

#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "io/importer/gltf_json.hpp"
#include "io/text.hpp"

namespace impinge::importer {
namespace {

using nlohmann::json;

/// assimp decodes it. Without a decoder the compressed triangles are missing, which `lost_triangles` tells.
constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr std::int64_t kFloat = 5126;
/// A file of more nodes than this has a loop of them.
constexpr std::size_t kMostVisits = 10'000'000;
/// assimp counts in 32 bits.
constexpr std::uint64_t kMostElements = 0xFFFFFFFF;

/// The size of a component in bytes; 1, which asks nothing of its place, for a type that there is none of.
std::int64_t size_of_component(std::int64_t type) {
  if (type == kFloat || type == 5125) return 4;
  return type == 5122 || type == 5123 ? 2 : 1;
}

class Checker {
 public:
  explicit Checker(const json& file) : file_(file) {}

  GltfCheck check() {
    check_extensions();
    const json& meshes = member(file_, "meshes");
    for (auto mesh = meshes.begin(); mesh != meshes.end() && check_.problem.empty(); ++mesh) add_mesh(*mesh);
    if (check_.problem.empty() && requires_draco_ && !has_draco_) {
      check_.problem = io::sentence("it requires ", kDraco, ", but holds nothing compressed by it; export it again");
    }
    if (check_.problem.empty()) count_shown();
    if (check_.problem.empty()) check_nodes();
    return std::move(check_);
  }

 private:
  void check_extensions() {
    constexpr std::array<std::string_view, 8> kHarmless{"KHR_technique", "KHR_materials_", "KHR_texture_",
                                                        "KHR_lights_",   "KHR_animation_", "EXT_texture_",
                                                        "EXT_lights_",   "KHR_xmp"};
    for (const json& extension : member(file_, "extensionsRequired")) {
      const std::string name = text_of(extension);
      if (std::any_of(kHarmless.begin(), kHarmless.end(), [&](auto begin) { return name.starts_with(begin); }))
        continue;
      if (name == kDraco) {
        requires_draco_ = true;
        continue;
      }
      check_.problem = io::sentence("it requires the glTF extension ", io::in_quotes(name),
                                    ", which may change its geometry; export it without");
      return;
    }
  }

  void add_mesh(const json& mesh) {
    std::uint64_t triangles = 0;
    for (const json& primitive : member(mesh, "primitives")) {
      has_draco_ |= member(primitive, "extensions").contains(kDraco);
      triangles += triangles_of(primitive);
      if (!check_.problem.empty()) {
        check_.problem = io::sentence("mesh ", meshes_.size(), ": ", check_.problem);
        return;
      }
    }
    meshes_.emplace(&mesh, triangles);
  }

  /// What assimp passes over without a word, though parts are then elsewhere or missing.
  void check_nodes() {
    constexpr const char* kInstances = "EXT_mesh_gpu_instancing";
    const json& nodes = member(file_, "nodes");
    if (!nodes.is_structured()) return;
    for (const auto& [key, node] : nodes.items()) {
      std::string what;
      if (member(node, "extensions").contains(kInstances))
        what = io::sentence("is shown many times by ", kInstances, ", which is not read; export it without");
      for (const auto& [name, count] :
           {std::pair{"matrix", 16U}, std::pair{"translation", 3U}, std::pair{"rotation", 4U}, std::pair{"scale", 3U}})
        if (const json& list = member(node, name); !list.is_null() && !are_numbers(list, count))
          what = io::sentence("has a ", name, " that is not ", count, " numbers of single precision; export it again");
      const std::string called = text_of(member(node, "name"));
      if (const json& turn = member(node, "rotation"); what.empty() && !turn.is_null() && are_zeros(turn))
        what = "has a rotation of four zeros, which is no rotation; export it again";
      if (const json& skin = member(node, "skin"); !skin.is_null() && element(member(file_, "skins"), skin).is_null())
        what = io::sentence("has the skin ", skin.dump(), ", which is not in the file; export it again");
      if (is_morphed(node)) check_.morphed.add(called);
      if (const json& seen = member(member(member(node, "extensions"), "KHR_node_visibility"), "visible");
          seen.is_boolean() && !seen.get<bool>())
        check_.hidden.add(called);
      if (what.empty()) continue;
      check_.problem = io::sentence("node ", key, called.empty() ? "" : " " + io::in_quotes(called), " ", what);
      return;
    }
  }

  [[nodiscard]] bool is_morphed(const json& node) const {
    const json& mesh = element(member(file_, "meshes"), member(node, "mesh"));
    const json &own = member(node, "weights"), &weights = own.is_null() ? member(mesh, "weights") : own;
    const json& primitives = member(mesh, "primitives");
    return weights.is_array() && primitives.is_array() &&
           std::any_of(weights.begin(), weights.end(),
                       [](const json& weight) { return weight.is_number() && weight.get<double>() != 0; }) &&
           std::any_of(primitives.begin(), primitives.end(),
                       [](const json& primitive) { return !member(primitive, "targets").empty(); });
  }

  static bool are_numbers(const json& list, std::size_t count) {
    return list.is_array() && list.size() == count && std::all_of(list.begin(), list.end(), [](const json& one) {
             return one.is_number() && std::fabs(one.get<double>()) <= std::numeric_limits<float>::max();
           });
  }

  /// assimp reads single precision.
  static bool are_zeros(const json& numbers) {
    return std::all_of(numbers.begin(), numbers.end(),
                       [](const json& one) { return static_cast<float>(one.get<double>()) == 0; });
  }

  /// What is wrong with where the elements of an accessor are (glTF 2.0, sections 3.6.2.4 and 3.7.2.1): assimp reads
  /// something else there. Empty if nothing is, or nothing is known.
  [[nodiscard]] std::string misplaced(const json& accessor, const char* what, std::int64_t components) const {
    const json& view = element(member(file_, "bufferViews"), member(accessor, "bufferView"));
    if (view.is_null()) return {};  // all zeros, sparse or compressed
    const std::int64_t component = size_of_component(integer_of(member(accessor, "componentType"), 0));
    const std::int64_t size = components * component, offset = integer_of(member(accessor, "byteOffset"), 0),
                       start = integer_of(member(view, "byteOffset"), 0);
    // Each is checked, so that their sum does not overflow.
    if (start % component != 0 || offset % component != 0)
      return io::sentence("its ", what, " begin at byte ", offset, " of a view that begins at byte ", start,
                          ", and both must be multiples of ", component,
                          ", the size of their numbers; export it again");
    const bool is_first_version = member(file_, "accessors").is_object();
    const json& stride_of = member(is_first_version ? accessor : view, "byteStride");
    const std::int64_t stride = integer_of(stride_of, stride_of.is_null() ? 0 : -1);
    if (stride == 0 || stride == size) return {};  // one directly after the other
    const bool is_vertex = components > 1;
    if (is_vertex && stride > size && stride <= 252 && stride % 4 == 0) return {};
    return io::sentence("its ", what, " are ", stride_of.dump(), " bytes apart, which must be ",
                        is_vertex ? "a multiple of 4 from " : "", size, is_vertex ? " to 252" : ", the size of one",
                        "; export it again");
  }

  /// How many triangles a primitive has, with a problem if that is not to be told.
  std::uint64_t triangles_of(const json& primitive) {
    const std::int64_t mode = integer_of(member(primitive, "mode"), 4);
    const json& accessors = member(file_, "accessors");
    const json& positions = element(accessors, member(member(primitive, "attributes"), "POSITION"));
    if (mode < 4 || mode > 6 || positions.is_null()) return 0;
    const std::int64_t type = integer_of(member(positions, "componentType"), 0);
    if (type != kFloat || text_of(member(positions, "type")) != "VEC3") {
      check_.problem = io::sentence("its positions have the component type ", type, " and the type ",
                                    io::in_quotes(text_of(member(positions, "type"))),
                                    " instead of 5126 (32-bit float) and 'VEC3'; export it without quantization");
      return 0;
    }
    const json& indices = member(primitive, "indices");
    const json& count_of = indices.is_null() ? positions : element(accessors, indices);
    check_.problem = misplaced(positions, "positions", 3);
    if (check_.problem.empty() && !indices.is_null()) check_.problem = misplaced(count_of, "indices", 1);
    if (!check_.problem.empty()) return 0;
    const json& count = member(count_of, "count");
    if (!count.is_number_unsigned() || count.get<std::uint64_t>() > kMostElements) {
      check_.problem = "a primitive does not say how many corners it has; export it again";
      return 0;
    }
    const auto corners = count.get<std::uint64_t>();
    if (mode != 4) return corners < 2 ? 0 : corners - 2;
    if (corners % 3 != 0) {
      check_.problem =
          io::sentence("a list of triangles has ", corners, " corners, which is not a multiple of 3; export it again");
    }
    return corners / 3;
  }

  /// Adds up the meshes of the scene's nodes, as often as they are shown.
  void count_shown() {
    const json& nodes = member(file_, "nodes");
    const json& meshes = member(file_, "meshes");
    std::vector<const json*> stack;
    const auto push = [&](const json& references) {
      if (!references.is_array()) return;
      for (const json& reference : references) stack.push_back(&element(nodes, reference));
    };
    const auto show = [&](const json& mesh) {
      if (const auto known = meshes_.find(&mesh); known != meshes_.end()) check_.triangles += known->second;
    };
    push(shown_roots(file_));
    for (std::size_t visits = 0; !stack.empty(); ++visits) {
      if (visits > kMostVisits || stack.size() > kMostVisits) {
        check_.problem = "its nodes form a loop, or are too many; export it again";
        return;
      }
      const json& node = *stack.back();
      stack.pop_back();
      show(element(meshes, member(node, "mesh")));
      if (const json& list = member(node, "meshes"); list.is_array()) {  // glTF 1
        for (const json& reference : list) show(element(meshes, reference));
      }
      push(member(node, "children"));
    }
  }

  const json& file_;
  GltfCheck check_;
  bool requires_draco_ = false, has_draco_ = false;
  std::map<const json*, std::uint64_t> meshes_;  ///< each with its number of triangles
};

}  // namespace

std::optional<GltfCheck> check_gltf(const char* file) {
  if (!is_gltf_name(file)) return std::nullopt;
  std::string problem;
  const std::string text = json_text(file, problem);
  if (!problem.empty()) return GltfCheck{problem, 0, {}, {}};
  try {
    return Checker(json::parse(text)).check();
  } catch (const json::exception& error) {
    return GltfCheck{io::sentence("its JSON cannot be read: ", error.what()), 0, {}, {}};
  }
}

std::string lost_triangles(const GltfCheck& check, const aiScene& scene) {
  std::vector<std::uint64_t> triangles(scene.mNumMeshes);
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    triangles[i] = static_cast<std::uint64_t>(
        std::count_if(mesh.mFaces, mesh.mFaces + mesh.mNumFaces, [](const aiFace& f) { return f.mNumIndices == 3; }));
  }
  std::uint64_t found = 0;
  std::vector<const aiNode*> stack{scene.mRootNode};
  while (!stack.empty()) {
    const aiNode& node = *stack.back();
    stack.pop_back();
    for (unsigned i = 0; i < node.mNumMeshes; ++i) found += triangles[node.mMeshes[i]];
    stack.insert(stack.end(), node.mChildren, node.mChildren + node.mNumChildren);
  }
  if (found >= check.triangles) return {};
  return io::sentence("assimp dropped ", check.triangles - found, " of ", check.triangles,
                      " triangles whose indices are out of range; mend the indices");
}

}  // namespace impinge::importer
