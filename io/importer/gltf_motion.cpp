// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/gltf_motion.hpp"

#include <assimp/scene.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "io/importer/gltf_buffers.hpp"
#include "io/importer/gltf_json.hpp"
#include "io/text.hpp"

namespace impinge::importer {
namespace {

using io::Track;
using nlohmann::json;

class Reader {
 public:
  Reader(const char* file, const json& root, Movement& movement)
      : root_(root), buffers_(file, root), movement_(movement) {}

  void read(const aiScene& scene) {
    const json& animations = member(root_, "animations");
    if (animations.empty() || !animations.is_structured()) return;
    if (!match_nodes(scene)) {
      warn("its animations are left out: its nodes are not those that were read");
      return;
    }
    for (const auto& [key, animation] : animations.items()) add(animation, animations.is_object() ? key : "");
    if (has_weights_) warn("it animates morph targets, which are left out: those parts keep their shape");
    if (has_pointers_) warn("it animates by pointers, which are left out");
    if (is_skinned()) warn(kSkins);
  }

 private:
  void warn(std::string_view sentence) { movement_.warnings.emplace_back(sentence); }

  /// Goes down both trees at once; false where they differ.
  bool match_nodes(const aiScene& scene) {
    const json& chosen = member(root_, "scene");
    const json kFirst = 0U;
    const json& scenes = member(root_, "scenes");
    const json& roots = member(element(scenes, chosen.is_null() ? kFirst : chosen), "nodes");
    // One root is assimp's root; several are its children.
    if (!roots.is_array() || roots.empty()) return false;
    std::vector<std::pair<const aiNode*, const json*>> stack;
    const json& nodes = member(root_, "nodes");
    const auto push = [&](const aiNode& parent, const json& references) {
      const std::size_t count = references.is_array() ? references.size() : 0;
      if (parent.mNumChildren != count) return false;
      for (std::size_t i = 0; i < count; ++i) stack.emplace_back(parent.mChildren[i], &element(nodes, references[i]));
      return true;
    };
    if (roots.size() == 1) {
      stack.emplace_back(scene.mRootNode, &element(nodes, roots[0]));
    } else if (!push(*scene.mRootNode, roots)) {
      return false;
    }
    while (!stack.empty()) {
      const auto [node, from] = stack.back();
      stack.pop_back();
      const std::uint32_t number = movement_.numbers.at(node);
      numbers_.emplace(from, number);
      take_parts(*from, movement_.nodes[number]);
      if (!push(*node, member(*from, "children"))) return false;
    }
    return true;
  }

  /// The parts of a node's transform as the file has them, in double.
  static void take_parts(const json& from, io::ImportedNode& to) {
    if (from.contains("matrix")) return;
    to.scale = {1, 1, 1}, to.rotation = {0, 0, 0, 1}, to.translation = {0, 0, 0};
    const auto take = [&](const char* name, auto& values) {
      const json& list = member(from, name);
      if (!list.is_array() || list.size() != values.size()) return;
      for (std::size_t i = 0; i < values.size(); ++i)
        if (list[i].is_number()) values[i] = list[i].get<double>();
    };
    take("scale", to.scale), take("rotation", to.rotation), take("translation", to.translation);
  }

  /// An animation of glTF 1 is called as its key if it has no name.
  void add(const json& from, const std::string& key) {
    io::Animation& animation = movement_.animations.emplace_back();
    animation.name = text_of(member(from, "name"));
    if (animation.name.empty()) animation.name = key;
    for (const json& channel : member(from, "channels")) {
      if (auto track = track_of(from, channel)) animation.tracks.push_back(*std::move(track));
    }
  }

  /// Nothing where a channel moves no node that is shown.
  std::optional<Track> track_of(const json& animation, const json& channel) {
    const json& target = member(channel, "target");
    const std::string path = text_of(member(target, "path"));
    has_weights_ |= path == "weights";
    has_pointers_ |= path == "pointer";
    const json& id = member(target, "id");  // glTF 1
    const auto node = numbers_.find(&element(member(root_, "nodes"), id.is_null() ? member(target, "node") : id));
    if (node == numbers_.end()) return std::nullopt;
    Track track;
    track.node = node->second;
    if (path == "translation") {
      track.property = Track::Property::translation;
    } else if (path == "rotation") {
      track.property = Track::Property::rotation;
    } else if (path == "scale") {
      track.property = Track::Property::scale;
    } else {
      return std::nullopt;
    }
    const json& sampler = element(member(animation, "samplers"), member(channel, "sampler"));
    const std::string between = text_of(member(sampler, "interpolation"));
    track.between = between == "STEP"          ? Track::Between::step
                    : between == "CUBICSPLINE" ? Track::Between::cubic
                                               : Track::Between::linear;
    const std::size_t width = track.property == Track::Property::rotation ? 4 : 3;
    const std::size_t parts = track.between == Track::Between::cubic ? 3 : 1;
    track.times = buffers_.read(accessor(animation, member(sampler, "input")), 1);
    track.values = buffers_.read(accessor(animation, member(sampler, "output")), width);
    // What does not fit together is a track without keys, which is told of.
    if (track.values.size() != track.times.size() * width * parts) track.times.clear(), track.values.clear();
    return track;
  }

  /// glTF 1 names a parameter of the animation, which names an accessor.
  [[nodiscard]] const json& accessor(const json& animation, const json& reference) const {
    const json& parameters = member(animation, "parameters");
    return element(member(root_, "accessors"), parameters.is_null() ? reference : element(parameters, reference));
  }

  [[nodiscard]] bool is_skinned() const {
    return std::any_of(numbers_.begin(), numbers_.end(), [](const auto& node) { return node.first->contains("skin"); });
  }

  const json& root_;
  GltfBuffers buffers_;
  Movement& movement_;
  std::map<const json*, std::uint32_t> numbers_;
  bool has_weights_ = false, has_pointers_ = false;
};

}  // namespace

void read_gltf_motion(const char* file, const aiScene& scene, Movement& movement) {
  std::string problem;
  const std::string text = json_text(file, problem);
  if (!problem.empty()) return;
  const json root = json::parse(text, nullptr, false);
  if (!root.is_discarded()) Reader(file, root, movement).read(scene);
}

}  // namespace impinge::importer
