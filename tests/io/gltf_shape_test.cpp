// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What bones and morph targets of glTF files do to shapes, which is not applied but told.
#include "animated_gltf.hpp"
#include "support.hpp"

namespace impinge::io {
namespace {

using test::AnimatedGltf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Two nodes show the cube; "body" hangs on a bone, which a node holds, with all its corners.
struct Skinned {
  AnimatedGltf file;
  int bone, root, body, other;

  explicit Skinned(const nlohmann::json& of_root = nlohmann::json::object()) {
    bone = file.node({{"name", "bone"}});
    nlohmann::json holder = of_root;
    holder["name"] = "root", holder["children"] = {bone};
    root = file.node(holder);
    body = file.node({{"name", "body"}, {"mesh", 0}, {"skin", 0}});
    other = file.node({{"name", "other"}, {"mesh", 1}});
    file.roots({root, body, other});
    file.root["meshes"].push_back(file.root["meshes"][0]);
    auto& attributes = file.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = file.accessor(file.view(std::string(32, '\0')), 5121, 8, "VEC4");
    file.root["accessors"].back().erase("normalized");
    std::vector<double> weights;
    for (int i = 0; i < 8; ++i) weights.insert(weights.end(), {1, 0, 0, 0});
    attributes["WEIGHTS_0"] = file.floats(weights, "VEC4");
    std::string unit;
    for (int i = 0; i < 16; ++i) AnimatedGltf::append(unit, i % 5 == 0 ? 1.0F : 0.0F);
    const int matrix = file.accessor(file.view(unit), 5126, 1, "MAT4");
    file.root["skins"] = nlohmann::json::array({{{"joints", {bone}}, {"inverseBindMatrices", matrix}}});
  }
};

TEST(GltfShape, BentPartsAreToldOfWhereABoneMoves) {
  for (const int moving : {0, 1, 2, 3}) {
    Skinned skinned;
    skinned.file.animation("bend");
    skinned.file.channel(moving, "translation", {0, 1}, {0, 0, 0, 1, 2, 3});
    const Model model = read_text(skinned.file.text());
    EXPECT_THAT(model.missing, IsEmpty()) << "at rest the bone is where it was bound";
    const auto& unfollowed = model.animations.at(0).unfollowed;
    ASSERT_EQ(unfollowed.size(), moving == skinned.bone || moving == skinned.root ? 1U : 0U) << moving;
    if (unfollowed.empty()) continue;
    EXPECT_EQ(unfollowed[0].what, Unfollowed::What::shape);
    EXPECT_EQ(unfollowed[0].node, model.objects.at(0).node) << model.objects[0].name;
  }
}

TEST(GltfShape, PartsThatBonesBendAtRestAreToldOf) {
  const Skinned skinned(nlohmann::json{{"translation", {1, 0, 0}}});
  EXPECT_THAT(read_text(skinned.file.text()).missing,
              ElementsAre(HasSubstr("1 part, 'body', is reshaped by bones, which is not read")));
}

TEST(GltfShape, MorphTargetsAtWorkAreToldOf) {
  AnimatedGltf file;
  const int shown = file.node({{"name", "face"}, {"mesh", 0}});
  const int relaxed = file.node({{"name", "relaxed"}, {"mesh", 0}, {"weights", {0}}});
  file.roots({shown, relaxed});
  EXPECT_THAT(read_text(file.text()).missing, IsEmpty());
  auto& mesh = file.root["meshes"][0];
  mesh["weights"] = {0.5};
  EXPECT_THAT(read_text(file.text()).missing, IsEmpty()) << "without targets";
  mesh["primitives"][0]["targets"] =
      nlohmann::json::array({{{"POSITION", mesh["primitives"][0]["attributes"]["POSITION"]}}});
  EXPECT_THAT(read_text(file.text()).missing,
              ElementsAre(HasSubstr("1 part, 'face', is reshaped by morph targets, which is not read")));
  mesh.erase("weights");
  EXPECT_THAT(read_text(file.text()).missing, IsEmpty());
}

}  // namespace
}  // namespace impinge::io
