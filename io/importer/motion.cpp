// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/motion.hpp"

#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "io/importer/gltf_json.hpp"
#include "io/importer/gltf_motion.hpp"
#include "io/text.hpp"

namespace impinge::importer {
namespace {

using Property = io::Track::Property;

io::ImportedNode imported(const aiNode& node, std::uint32_t parent) {
  const aiMatrix4x4& m = node.mTransformation;
  aiVector3D scale, translation;
  aiQuaternion rotation;
  m.Decompose(scale, rotation, translation);
  return {parent,
          {m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4},
          {scale.x, scale.y, scale.z},
          {rotation.x, rotation.y, rotation.z, rotation.w},
          {translation.x, translation.y, translation.z}};
}

void number_nodes(const aiScene& scene, Movement& movement) {
  std::vector<const aiNode*> stack{scene.mRootNode};
  while (!stack.empty()) {
    const aiNode& node = *stack.back();
    stack.pop_back();
    const std::uint32_t parent = node.mParent == nullptr ? io::kNoNode : movement.numbers.at(node.mParent);
    movement.numbers.emplace(&node, static_cast<std::uint32_t>(movement.nodes.size()));
    movement.nodes.push_back(imported(node, parent));
    for (unsigned i = node.mNumChildren; i-- > 0;) stack.push_back(node.mChildren[i]);
  }
}

template <class Key>
io::Track track_of(std::uint32_t node, Property property, const Key* keys, unsigned count, double second) {
  io::Track track;
  track.node = node;
  track.property = property;
  for (unsigned i = 0; i < count; ++i) {
    track.times.push_back(keys[i].mTime / second);
    if constexpr (requires { keys[i].mValue.w; }) {
      const aiQuaternion& q = keys[i].mValue;
      track.values.insert(track.values.end(), {q.x, q.y, q.z, q.w});
    } else {
      const aiVector3D& v = keys[i].mValue;
      track.values.insert(track.values.end(), {v.x, v.y, v.z});
    }
  }
  return track;
}

bool is_skinned(const aiScene& scene) {
  return std::any_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes,
                     [](const aiMesh* mesh) { return mesh->mNumBones > 0; });
}

/// The animations as assimp gives them.
void take_animations(const aiScene& scene, Movement& movement) {
  constexpr double kTicksUnlessSaid = 25;  // what assimp's own tools take
  for (unsigned a = 0; a < scene.mNumAnimations; ++a) {
    const aiAnimation& from = *scene.mAnimations[a];
    const double second = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : kTicksUnlessSaid;
    io::Animation& to = movement.animations.emplace_back();
    to.name = from.mName.C_Str();
    for (unsigned c = 0; c < from.mNumChannels; ++c) {
      const aiNodeAnim& channel = *from.mChannels[c];
      const aiNode* const node = scene.mRootNode->FindNode(channel.mNodeName);
      if (node == nullptr) continue;
      const std::uint32_t number = movement.numbers.at(node);
      const auto add = [&](Property property, const auto* keys, unsigned count) {
        if (count > 0) to.tracks.push_back(track_of(number, property, keys, count, second));
      };
      add(Property::translation, channel.mPositionKeys, channel.mNumPositionKeys);
      add(Property::rotation, channel.mRotationKeys, channel.mNumRotationKeys);
      add(Property::scale, channel.mScalingKeys, channel.mNumScalingKeys);
    }
  }
}

/// What is wrong with a track, or nothing.
std::string_view problem_of(const io::Track& track) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (track.times.empty()) return "it has no keys";
  if (!std::all_of(track.times.begin(), track.times.end(), is_finite) ||
      !std::all_of(track.values.begin(), track.values.end(), is_finite))
    return "it has keys that are not finite";
  if (!std::is_sorted(track.times.begin(), track.times.end())) return "its keys are not in the order of time";
  return {};
}

/// Leaves out tracks that cannot be followed, and animations that then move nothing or last no time.
void keep_sound(Movement& movement) {
  for (io::Animation& animation : movement.animations) {
    std::string_view problem;
    std::erase_if(animation.tracks, [&](const io::Track& track) {
      const std::string_view found = problem_of(track);
      if (!found.empty()) problem = found;
      return !found.empty();
    });
    if (!problem.empty())
      movement.warnings.push_back(io::sentence("animation ", io::in_quotes(animation.name),
                                               ": a channel is left out, for ", problem, "; export it again"));
    for (const io::Track& track : animation.tracks) animation.seconds = std::max(animation.seconds, track.times.back());
  }
  std::erase_if(movement.animations, [](const io::Animation& animation) { return animation.seconds == 0; });
  if (movement.animations.empty()) movement.nodes.clear(), movement.numbers.clear();
}

}  // namespace

Movement read_movement(const char* file, const aiScene& scene) {
  Movement movement;
  number_nodes(scene, movement);
  if (is_gltf_name(file)) {
    read_gltf_motion(file, scene, movement);
  } else {
    take_animations(scene, movement);
    if (!movement.animations.empty() && is_skinned(scene)) movement.warnings.emplace_back(kSkins);
  }
  keep_sound(movement);
  return movement;
}

}  // namespace impinge::importer
