// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/motion.hpp"

#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "io/importer/gltf_json.hpp"
#include "io/text.hpp"

namespace impinge::importer {
namespace {

using Property = io::Track::Property;
constexpr auto kPlace = io::Unfollowed::What::place, kShape = io::Unfollowed::What::shape;

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

/// Whether a channel goes on beyond its keys, which nothing here does: "from" the first key back, or after the last
/// one.
bool goes_on(const aiNodeAnim& channel, const io::Track& track, double end) {
  const auto moves = [](aiAnimBehaviour way) { return way == aiAnimBehaviour_LINEAR || way == aiAnimBehaviour_REPEAT; };
  return track.times.size() > 1 && ((moves(channel.mPreState) && track.times.front() > 0) ||
                                    (moves(channel.mPostState) && track.times.back() < end));
}

/// The animations as assimp gives them. Their channels name nodes, which need not be different ones by name.
class SceneReader {
 public:
  SceneReader(const aiScene& scene, Movement& movement)
      : scene_(scene), movement_(movement), nodes_(movement.numbers.size()) {
    for (const auto& [node, number] : movement.numbers) nodes_[number] = node;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) called_[nodes_[i]->mName.C_Str()].push_back(i);
  }

  void read() {
    for (unsigned a = 0; a < scene_.mNumAnimations; ++a) add(*scene_.mAnimations[a]);
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) add_skin(*nodes_[i], i);
    if (!movement_.animations.empty() && !movement_.skins.empty()) movement_.warnings.emplace_back(kSkins);
  }

 private:
  void add(const aiAnimation& from) {
    constexpr double kTicksUnlessSaid = 25;  // what assimp's own tools take
    const double second = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : kTicksUnlessSaid;
    io::Animation& to = movement_.animations.emplace_back();
    to.name = from.mName.C_Str();
    const double end = from.mDuration / second;
    for (unsigned c = 0; c < from.mNumChannels; ++c) add(*from.mChannels[c], second, end, to);
    for (unsigned c = 0; c < from.mNumMeshChannels; ++c) add_shape(from.mMeshChannels[c]->mName, to);
    for (unsigned c = 0; c < from.mNumMorphMeshChannels; ++c) add_shape(from.mMorphMeshChannels[c]->mName, to);
  }

  void add(const aiNodeAnim& channel, double second, double end, io::Animation& to) {
    const std::string name = channel.mNodeName.C_Str(), node = io::sentence("node ", io::in_quotes(name));
    const auto numbers = called_.find(name);
    if (numbers == called_.end()) {
      to.unfollowed.push_back({kPlace, std::nullopt, io::sentence("the channel of ", node, ": it has no such node")});
      return;
    }
    if (numbers->second.size() > 1) {
      for (const std::uint32_t number : numbers->second)
        to.unfollowed.push_back(
            {kPlace, number, io::sentence("the channel of ", node, ": several nodes are called so")});
      return;
    }
    const auto add = [&](Property property, const char* what, const auto* keys, unsigned count) {
      if (count == 0) return;
      io::Track track = track_of(numbers->second[0], property, keys, count, second);
      const bool is_longer = goes_on(channel, track, end);
      add_track(to, std::move(track), io::sentence("the ", what, " of ", node),
                is_longer ? "it goes on beyond its keys" : "");
    };
    add(Property::translation, "translation", channel.mPositionKeys, channel.mNumPositionKeys);
    add(Property::rotation, "rotation", channel.mRotationKeys, channel.mNumRotationKeys);
    add(Property::scale, "scale", channel.mScalingKeys, channel.mNumScalingKeys);
  }

  /// Of a mesh, by its own name or that of a node; some readers add a star and a number.
  void add_shape(const aiString& of, io::Animation& to) const {
    std::string name = of.C_Str();
    name.resize(std::min(name.size(), name.rfind('*')));
    bool is_known = false;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      const aiNode& node = *nodes_[i];
      const bool shows = std::any_of(node.mMeshes, node.mMeshes + node.mNumMeshes, [&](unsigned mesh) {
        return name == scene_.mMeshes[mesh]->mName.C_Str() || name == node.mName.C_Str();
      });
      if (!shows) continue;
      is_known = true;
      to.unfollowed.push_back({kShape, i, kMorphs});
    }
    if (!is_known) to.unfollowed.push_back({kShape, std::nullopt, kMorphs});
  }

  void add_skin(const aiNode& node, std::uint32_t number) {
    Skin skin{number, {}};
    bool is_skinned = false;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
      is_skinned |= mesh.mNumBones > 0;
      for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const auto joints = called_.find(mesh.mBones[b]->mName.C_Str());
        if (joints == called_.end()) continue;
        skin.joints.insert(skin.joints.end(), joints->second.begin(), joints->second.end());
      }
    }
    if (is_skinned) movement_.skins.push_back(std::move(skin));
  }

  const aiScene& scene_;
  Movement& movement_;
  std::vector<const aiNode*> nodes_;  ///< by number
  std::map<std::string, std::vector<std::uint32_t>, std::less<>> called_;
};

/// What is wrong with a track, or nothing.
std::string_view problem_of(const io::Track& track) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (track.times.empty()) return "it has no keys";
  if (!std::all_of(track.times.begin(), track.times.end(), is_finite) ||
      !std::all_of(track.values.begin(), track.values.end(), is_finite))
    return "it has keys that are not finite";
  if (!std::is_sorted(track.times.begin(), track.times.end())) return "its keys are not in the order of time";
  if (track.property != Property::rotation) return {};
  // A quaternion's four numbers; those of a cubic key stand between its tangents.
  const std::size_t parts = track.between == io::Track::Between::cubic ? 3 : 1;
  for (std::size_t i = 4 * (parts / 2); i < track.values.size(); i += 4 * parts)
    if (std::all_of(&track.values[i], &track.values[i] + 4, [](double value) { return value == 0; }))
      return "it has a quaternion of four zeros, which is no rotation";
  return {};
}

/// Of the skinned nodes those with a joint that the animation moves, by itself or with a node above it.
void find_bent(const Movement& movement, io::Animation& animation) {
  std::vector<bool> moves(movement.nodes.size(), false);
  for (const io::Track& track : animation.tracks) moves[track.node] = true;
  for (const io::Unfollowed& lost : animation.unfollowed)
    if (lost.what == kPlace && lost.node) moves[*lost.node] = true;
  for (std::size_t i = 0; i < moves.size(); ++i)
    if (movement.nodes[i].parent != io::kNoNode && moves[movement.nodes[i].parent]) moves[i] = true;
  for (const Skin& skin : movement.skins) {
    const bool is_bent = skin.joints.empty() || std::any_of(skin.joints.begin(), skin.joints.end(),
                                                            [&](std::uint32_t joint) { return moves[joint]; });
    if (is_bent) animation.unfollowed.push_back({kShape, skin.node, "bones bend it"});
  }
}

/// Makes up what follows from all tracks, and leaves out animations that do nothing or last no time.
void finish(Movement& movement) {
  for (io::Animation& animation : movement.animations) {
    for (const io::Unfollowed& lost : animation.unfollowed)
      if (lost.what == kPlace)
        movement.warnings.push_back(
            io::sentence("animation ", io::in_quotes(animation.name), " cannot be followed: ", lost.sentence));
    for (const io::Track& track : animation.tracks) animation.seconds = std::max(animation.seconds, track.times.back());
    if (!movement.skins.empty()) find_bent(movement, animation);
  }
  std::erase_if(movement.animations,
                [](const io::Animation& animation) { return animation.seconds == 0 && animation.unfollowed.empty(); });
  if (movement.animations.empty()) movement.nodes.clear(), movement.numbers.clear();
}

}  // namespace

void add_track(io::Animation& animation, io::Track&& track, std::string_view channel, std::string_view problem) {
  if (problem.empty()) problem = problem_of(track);
  if (problem.empty())
    animation.tracks.push_back(std::move(track));
  else
    animation.unfollowed.push_back({kPlace, track.node, io::sentence(channel, ": ", problem)});
}

Movement read_movement(const char* file, const aiScene& scene) {
  Movement movement;
  number_nodes(scene, movement);
  if (is_gltf_name(file)) {
    read_gltf_motion(file, scene, movement);
  } else {
    SceneReader(scene, movement).read();
  }
  finish(movement);
  return movement;
}

}  // namespace impinge::importer
