// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <assimp/scene.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "io/importer/gltf_buffers.hpp"
#include "io/importer/gltf_json.hpp"
#include "io/importer/motion.hpp"
#include "io/text.hpp"

namespace impinge::importer {
namespace {

using io::Track;
using nlohmann::json;
constexpr auto kPlace = io::Unfollowed::What::place, kShape = io::Unfollowed::What::shape;

class Reader {
 public:
  Reader(const char* file, const json& root, Movement& movement)
      : root_(root), buffers_(file, root), movement_(movement) {}

  void read(const aiScene& scene) {
    const json& animations = member(root_, "animations");
    if (animations.empty() || !animations.is_structured()) return;
    const bool is_matched = match_nodes(scene);
    for (const auto& [key, animation] : animations.items())
      add(animation, animations.is_object() ? key : "", is_matched);
    if (!is_matched) return;
    if (has_weights_) warn("it animates morph targets, which are left out: those parts keep their shape");
    if (has_pointers_) warn("it animates by pointers, which are left out");
    take_skins();
    if (!movement_.skins.empty()) warn(kSkins);
  }

 private:
  void warn(std::string_view sentence) { movement_.warnings.emplace_back(sentence); }

  /// Goes down both trees at once; false where they differ.
  bool match_nodes(const aiScene& scene) {
    const json& roots = shown_roots(root_);
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
      if (!numbers_.emplace(from, number).second) return false;  // below two parents: which of the two moves?
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
  void add(const json& from, const std::string& key, bool is_matched) {
    io::Animation& animation = movement_.animations.emplace_back();
    animation.name = text_of(member(from, "name"));
    if (animation.name.empty()) animation.name = key;
    if (!is_matched) {
      animation.unfollowed.push_back({kPlace, std::nullopt, "the nodes of the file are not those that were read"});
      return;
    }
    const json& channels = member(from, "channels");
    if (!channels.is_array()) return;
    std::set<std::pair<std::uint32_t, std::string>> known;
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const Channel channel = channel_of(channels[i], i);
      if (channel.path.empty()) continue;  // it is of no node
      if (!channel.node) {
        if (channel.is_missing)
          animation.unfollowed.push_back({kPlace, std::nullopt, channel.text + ": there is no such node"});
        continue;
      }
      if (channel.path == "weights") {
        animation.unfollowed.push_back({kShape, channel.node, kMorphs});
        continue;
      }
      const bool is_new = known.emplace(*channel.node, channel.path).second;
      std::string problem = is_new ? "" : "another channel says it too";
      io::Track track = track_of(from, channels[i], channel, problem);
      add_track(animation, std::move(track), channel.text, problem);
    }
  }

  /// What a channel is about.
  struct Channel {
    std::string path, text;  ///< no path: nothing of a node
    std::optional<std::uint32_t> node;
    bool is_missing = false;  ///< the node that it names is not in the file; one that is not shown is there
  };

  Channel channel_of(const json& from, std::size_t number) {
    const json& target = member(from, "target");
    const json& id = member(target, "id");  // glTF 1
    json reference = id.is_null() ? member(target, "node") : id;
    Channel channel{text_of(member(target, "path")), {}, {}};
    if (channel.path == "pointer") {
      has_pointers_ = true;
      follow_pointer(text_of(member(member(member(target, "extensions"), "KHR_animation_pointer"), "pointer")), channel,
                     reference);
    }
    has_weights_ |= channel.path == "weights";
    if (channel.path.empty()) channel.path = "unnamed property";
    if (reference.is_null()) channel.path.clear();  // section 3.11: it is to be passed over
    const json& node = element(member(root_, "nodes"), reference);
    const std::string name = text_of(member(node, "name"));
    channel.text = io::sentence("channel ", number, ", the ", channel.path.empty() ? "motion" : channel.path,
                                " of node ", reference.dump(), name.empty() ? "" : " " + io::in_quotes(name));
    channel.is_missing = node.is_null();
    if (const auto known = numbers_.find(&node); known != numbers_.end()) channel.node = known->second;
    return channel;
  }

  /// "/nodes/3/rotation" is about a node (KHR_animation_pointer); most others are about materials and lights.
  static void follow_pointer(std::string_view pointer, Channel& channel, json& reference) {
    constexpr std::string_view kNodes = "/nodes/";
    reference = nullptr;
    if (!pointer.starts_with(kNodes)) return;
    pointer.remove_prefix(kNodes.size());
    const std::string_view number = pointer.substr(0, pointer.find('/'));
    const std::string_view path = pointer.substr(std::min(pointer.size(), number.size() + 1));
    if (path.starts_with("extensions/")) return;
    reference = json::parse(number, nullptr, false);
    channel.path = path.starts_with("weights") ? "weights" : io::sentence("pointer to ", path);
  }

  /// The keys of a channel, or what is wrong with it.
  io::Track track_of(const json& animation, const json& from, const Channel& channel, std::string& problem) {
    Track track;
    track.node = *channel.node;
    if (channel.path == "translation") {
      track.property = Track::Property::translation;
    } else if (channel.path == "rotation") {
      track.property = Track::Property::rotation;
    } else if (channel.path == "scale") {
      track.property = Track::Property::scale;
    } else {
      problem = "it is none of translation, rotation, scale and weights";
      return track;
    }
    const json& sampler = element(member(animation, "samplers"), member(from, "sampler"));
    const json& between = member(sampler, "interpolation");
    const std::string way = between.is_null() ? "LINEAR" : text_of(between);
    track.between = way == "STEP"          ? Track::Between::step
                    : way == "CUBICSPLINE" ? Track::Between::cubic
                                           : Track::Between::linear;
    if (track.between == Track::Between::linear && way != "LINEAR")
      problem = "its interpolation is none of STEP, LINEAR and CUBICSPLINE";
    const std::size_t width = track.property == Track::Property::rotation ? 4 : 3;
    const std::size_t parts = track.between == Track::Between::cubic ? 3 : 1;
    track.times = buffers_.read(accessor(animation, member(sampler, "input")), 1);
    track.values = buffers_.read(accessor(animation, member(sampler, "output")), width);
    if (!problem.empty()) return track;
    if (track.times.empty() || track.values.empty())
      problem = "its times or values are not there, or in a way that cannot be read";
    else if (track.values.size() != track.times.size() * width * parts)
      problem = io::sentence("it has ", track.times.size(), " times and ", track.values.size() / width, " values",
                             parts == 3 ? ", and not three for each time" : "");
    else if (track.times.front() < 0)
      problem = "it begins before the time 0";
    return track;
  }

  /// glTF 1 names a parameter of the animation, which names an accessor.
  [[nodiscard]] const json& accessor(const json& animation, const json& reference) const {
    const json& parameters = member(animation, "parameters");
    return element(member(root_, "accessors"), parameters.is_null() ? reference : element(parameters, reference));
  }

  void take_skins() {
    for (const auto& [from, number] : numbers_) {
      if (!from->contains("skin")) continue;
      Skin skin{number, {}};
      const json& nodes = member(root_, "nodes");
      for (const json& joint : member(element(member(root_, "skins"), member(*from, "skin")), "joints"))
        if (const auto known = numbers_.find(&element(nodes, joint)); known != numbers_.end())
          skin.joints.push_back(known->second);
      movement_.skins.push_back(std::move(skin));
    }
    std::ranges::sort(movement_.skins, {}, &Skin::node);  // the order of addresses is no order
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
