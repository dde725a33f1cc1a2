// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Animations of files: glTF in all its ways to hold numbers, hostile ones, and those of other formats.
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>

#include "animated_gltf.hpp"
#include "support.hpp"

namespace impinge::io {
namespace {

using test::AnimatedGltf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<double> kTimes{0, 1, 3};
const std::vector<double> kPlaces{0, 0, 0, 1, 2, 3, -4, 5, 0.5};
// Quarter and half turns, whose numbers are exact as fractions of whole ones too.
const std::vector<double> kTurns{0, 0, 0, 1, 0, 0, 1, 0, -1, 0, 0, 0};

/// One cube that is moved; the channel is the caller's.
AnimatedGltf one_cube() {
  AnimatedGltf file;
  file.roots({file.node({{"name", "cube"}, {"mesh", 0}})});
  file.animation("go");
  return file;
}

const Track& only_track(const Model& model) {
  static const Track kNone;
  EXPECT_EQ(model.animations.size(), 1u);
  if (model.animations.size() != 1 || model.animations[0].tracks.size() != 1) {
    ADD_FAILURE() << "not one track";
    return kNone;
  }
  EXPECT_LT(model.animations[0].tracks[0].node, model.nodes.size());
  return model.animations[0].tracks[0];
}

void expect_places(const Model& model) {
  const Track& track = only_track(model);
  EXPECT_EQ(track.times, kTimes);
  EXPECT_EQ(track.values, kPlaces);
  EXPECT_EQ(track.property, Track::Property::translation);
  ASSERT_EQ(model.objects.size(), 1u);
  EXPECT_EQ(model.objects[0].node, track.node);
  EXPECT_EQ(model.animations[0].name, "go");
  EXPECT_EQ(model.animations[0].seconds, 3);
  EXPECT_THAT(model.warnings, IsEmpty());
}

TEST(GltfMotion, BuffersAreInTheTextBesideItOrInTheFile) {
  AnimatedGltf file = one_cube();
  file.channel(0, "translation", kTimes, kPlaces);
  expect_places(read_text(file.text()));
  expect_places(read_text(file.glb(), "case.glb"));
  const TemporaryFolder folder;
  (void)folder.write("a b.bin", file.bytes);
  expect_places(model_of(read(folder.write("case.gltf", file.text("a b.bin")))));
  (void)folder.write("gr\u00f6\u00dfe.bin", file.bytes);
  expect_places(model_of(read(folder.write("plain.gltf", file.text("gr\u00f6\u00dfe.bin")))));
}

TEST(GltfMotion, WaysBetweenKeys) {
  const std::map<std::string, Track::Between> ways{
      {"STEP", Track::Between::step}, {"LINEAR", Track::Between::linear}, {"CUBICSPLINE", Track::Between::cubic}};
  for (const auto& [name, between] : ways) {
    AnimatedGltf file = one_cube();
    std::vector<double> values = kPlaces;
    if (between == Track::Between::cubic)
      for (int i = 0; i < 18; ++i) values.push_back(i);
    file.channel(0, "translation", kTimes, values, name.c_str());
    const Model model = read_text(file.text());
    EXPECT_EQ(only_track(model).between, between);
    EXPECT_EQ(only_track(model).values, values);
  }
  AnimatedGltf file = one_cube();
  file.channel(0, "translation", kTimes, kPlaces);
  file.root["animations"][0]["samplers"][0].erase("interpolation");
  EXPECT_EQ(only_track(read_text(file.text())).between, Track::Between::linear) << "what glTF takes if nothing is said";
}

/// Section 3.6.2: whole numbers stand for fractions, the least one for -1.
template <class T>
void expect_fractions(int component, double one) {
  SCOPED_TRACE(component);
  AnimatedGltf file = one_cube();
  std::string data;
  const std::vector<T> numbers{0, 0, 0, std::numeric_limits<T>::max(), 0, 0, std::numeric_limits<T>::min(), 3, 9,
                               7, 5, 1};
  for (const T number : numbers) AnimatedGltf::append(data, number);
  file.channel(0, "rotation", file.floats(kTimes, "SCALAR"), file.accessor(file.view(data), component, 3, "VEC4"),
               "LINEAR");
  const Model model = read_text(file.text());
  std::vector<double> expected;
  for (const T number : numbers) expected.push_back(std::max(number / one, -1.0));
  EXPECT_EQ(only_track(model).values, expected);
}

TEST(GltfMotion, WholeNumbersStandForFractions) {
  expect_fractions<std::int8_t>(5120, 127);
  expect_fractions<std::uint8_t>(5121, 255);
  expect_fractions<std::int16_t>(5122, 32767);
  expect_fractions<std::uint16_t>(5123, 65535);
}

TEST(GltfMotion, NumbersMayStandApartAndBeginLater) {
  AnimatedGltf file = one_cube();
  // Each key is its time, 8 bytes of something else, its place and 4 bytes of something else; 12 bytes come before.
  std::string data(12, '\x7f');
  for (std::size_t i = 0; i < 3; ++i) {
    AnimatedGltf::append(data, static_cast<float>(kTimes[i]));
    data += "12345678";
    for (std::size_t k = 0; k < 3; ++k) AnimatedGltf::append(data, static_cast<float>(kPlaces[3 * i + k]));
    if (i < 2) data += "1234";  // the last needs none
  }
  const int view = file.view(data, 28);
  file.channel(0, "translation", file.accessor(view, 5126, 3, "SCALAR", 12), file.accessor(view, 5126, 3, "VEC3", 24),
               "LINEAR");
  expect_places(read_text(file.text()));
}

/// Whatever moves them, at rest nodes are where the objects that they show are.
void expect_rest(const Model& model) {
  const std::vector<Affine> rest = nodes_at(model, {}, 0);
  for (const Object& object : model.objects) {
    if (!object.node || object.is_baked) continue;
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(rest.at(*object.node).m[i], object.pose.R[i], 1e-5) << object.name;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(rest[*object.node].t[i], object.pose.t[i], 1e-5 * (1 + std::fabs(object.pose.t[i]))) << object.name;
  }
}

TEST(GltfMotion, HierarchiesRootsMatricesAndScales) {
  AnimatedGltf file;
  const int hand = file.node({{"name", "hand"}, {"mesh", 0}, {"translation", {0, 3, 0}}});
  const int arm = file.node({{"name", "arm"}, {"translation", {10, 0, 0}}, {"children", {hand}}});
  // A quarter turn about z, moved; columns come first.
  const int still =
      file.node({{"name", "still"}, {"mesh", 0}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}});
  const int child = file.node({{"name", "child"}, {"mesh", 0}});
  const int wide = file.node({{"name", "wide"}, {"scale", {2, 1, 1}}, {"children", {child}}});
  file.roots({arm, still, wide});
  file.animation("lift");
  file.channel(arm, "translation", {0, 2}, {10, 0, 0, 10, 4, 0});
  file.animation("turn");
  file.channel(child, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0});
  const Model model = read_text(file.text());
  expect_rest(model);
  EXPECT_EQ(names_of(model), (std::vector<std::string>{"hand", "still", "child"}));
  EXPECT_THAT(model.warnings, IsEmpty());
  ASSERT_EQ(model.animations.size(), 2u);
  EXPECT_EQ(model.animations[1].name, "turn");
  const auto lifted = nodes_at(model, model.animations[0], 1);
  EXPECT_EQ(lifted.at(*model.objects[0].node).t, (std::array<double, 3>{10, 5, 0})) << "with its parent";
  EXPECT_EQ(lifted.at(*model.objects[1].node).t, (std::array<double, 3>{5, 6, 7}));
  EXPECT_EQ(lifted[*model.objects[1].node].m, (std::array<double, 9>{0, -1, 0, 1, 0, 0, 0, 0, 1}));
  EXPECT_TRUE(model.objects[2].is_baked);
  const Affine turned = nodes_at(model, model.animations[1], 0.5).at(*model.objects[2].node);
  const std::array<double, 9> sheared{0, -2, 0, 1, 0, 0, 0, 0, 1};  // a quarter turn, then twice as wide
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(turned.m[i], sheared[i], 1e-15);
}

TEST(GltfMotion, WhatCannotBeFollowedIsToldOf) {
  const auto warnings = [](AnimatedGltf file) { return read_text(file.text()).warnings; };
  AnimatedGltf file = one_cube();
  file.channel(0, "translation", kTimes, kPlaces);
  AnimatedGltf other = file;
  other.channel(0, "weights", other.floats({0, 1}, "SCALAR"), other.floats({0, 1}, "SCALAR"), "LINEAR");
  EXPECT_THAT(warnings(other), ElementsAre(HasSubstr("morph targets")));
  other = file;
  other.root["animations"][0]["channels"].push_back({{"sampler", 0}, {"target", {{"path", "pointer"}}}});
  EXPECT_THAT(warnings(other), ElementsAre(HasSubstr("by pointers")));
}

/// A cube with one sound channel on its scale, and one that is not.
template <class Spoil>
void expect_left_out(const char* what, const Spoil& spoil, std::string_view why) {
  SCOPED_TRACE(what);
  AnimatedGltf file = one_cube();
  file.channel(0, "translation", kTimes, kPlaces);
  file.channel(0, "scale", {0, 1}, {1, 1, 1, 2, 2, 2});
  auto& root = file.root;
  spoil(file, root["accessors"][root["animations"][0]["samplers"][0]["input"].get<std::size_t>()],
        root["accessors"][root["animations"][0]["samplers"][0]["output"].get<std::size_t>()]);
  const TemporaryFolder folder;
  const Result<Model> answer = read(folder.write("case.gltf", file.text()));
  if (!answer) {  // assimp refuses some of these files, or falls over them in its own process
    EXPECT_EQ(answer.error().code, Code::bad_file);
    return;
  }
  const Model& model = *answer;
  EXPECT_EQ(only_track(model).property, Track::Property::scale);
  EXPECT_EQ(model.animations.at(0).seconds, 1);
  EXPECT_THAT(model.warnings, ElementsAre(HasSubstr(std::string(why))));
  ASSERT_EQ(model.animations[0].unfollowed.size(), 1U);
  const Unfollowed& lost = model.animations[0].unfollowed[0];
  EXPECT_EQ(lost.what, Unfollowed::What::place);
  EXPECT_EQ(lost.node, model.objects.at(0).node);
  EXPECT_THAT(lost.sentence, testing::StartsWith("channel 0, the translation of node 0 'cube': "));
  EXPECT_THAT(lost.sentence, HasSubstr(std::string(why)));
}

TEST(GltfMotion, ChannelsThatLieAreLeftOut) {
  using json = nlohmann::json;
  const char* const kNoKeys = "its times or values are not there";
  const auto change = [](const char* member, const json& value) {
    return [member, value](AnimatedGltf&, json& input, json&) { input[member] = value; };
  };
  expect_left_out("sparse", change("sparse", json::object()), kNoKeys);
  expect_left_out("fewer", change("count", 2), "it has 2 times and 3 values");
  expect_left_out("none", change("count", 0), kNoKeys);
  expect_left_out("too far on", change("byteOffset", 1U << 20U), kNoKeys);
  expect_left_out("another type", change("type", "VEC2"), kNoKeys);
  expect_left_out("another component", change("componentType", 5125), kNoKeys);
  expect_left_out(
      "values of another type", [](AnimatedGltf&, json&, json& output) { output["type"] = "VEC4"; }, kNoKeys);
  expect_left_out(
      "no such accessor",
      [](AnimatedGltf& file, json&, json&) { file.root["animations"][0]["samplers"][0].erase("input"); }, kNoKeys);
  const auto times = [](const std::vector<double>& numbers) {
    return [numbers](AnimatedGltf& file, json&, json&) {
      file.root["animations"][0]["samplers"][0]["input"] = file.floats(numbers, "SCALAR");
    };
  };
  expect_left_out("backwards", times({0, 3, 1}), "not in the order of time");
  expect_left_out("not a number", times({0, 1, std::numeric_limits<double>::quiet_NaN()}), "not finite");
  expect_left_out("before the beginning", times({-1, 0, 3}), "it begins before the time 0");
  expect_left_out("endless", times({0, 1, std::numeric_limits<double>::infinity()}), "not finite");
}

TEST(GltfMotion, SamplersThatLieAreLeftOut) {
  const auto sampler = [](const char* member, const nlohmann::json& value) {
    return [member, value](AnimatedGltf& file, nlohmann::json&, nlohmann::json&) {
      file.root["animations"][0]["samplers"][0][member] = value;
    };
  };
  const char* const kUnknown = "its interpolation is none of STEP, LINEAR and CUBICSPLINE";
  expect_left_out("another way", sampler("interpolation", "CATMULL"), kUnknown);
  expect_left_out("no name of a way", sampler("interpolation", 7), kUnknown);
  expect_left_out("no tangents", sampler("interpolation", "CUBICSPLINE"), "not three for each time");
  expect_left_out(
      "no number",
      [](AnimatedGltf& file, nlohmann::json&, nlohmann::json&) {
        std::vector<double> values = kPlaces;
        values[4] = std::numeric_limits<double>::quiet_NaN();
        file.root["animations"][0]["samplers"][0]["output"] = file.floats(values, "VEC3");
      },
      "not finite");
}

/// What a channel on node 0 leaves unfollowed.
Unfollowed only_unfollowed(const AnimatedGltf& file) {
  const Model model = read_text(file.text());
  if (model.animations.size() != 1 || model.animations[0].unfollowed.size() != 1) {
    ADD_FAILURE() << "not one thing unfollowed";
    return {};
  }
  return model.animations[0].unfollowed[0];
}

TEST(GltfMotion, RotationsThatAreNoneAreLeftOut) {
  for (const bool is_cubic : {false, true}) {
    SCOPED_TRACE(is_cubic);
    AnimatedGltf file = one_cube();
    std::vector<double> turns{0, 0, 0, 1, 0, 0, 0, 0};
    // Tangents may be zero, and those that are not make up for nothing.
    if (is_cubic) turns = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1};
    file.channel(0, "rotation", {0, 1}, turns, is_cubic ? "CUBICSPLINE" : "LINEAR");
    EXPECT_THAT(only_unfollowed(file).sentence, HasSubstr("quaternion of four zeros"));
    turns[is_cubic ? 16 : 4] = 1;
    file = one_cube();
    file.channel(0, "rotation", {0, 1}, turns, is_cubic ? "CUBICSPLINE" : "LINEAR");
    EXPECT_THAT(read_text(file.text()).warnings, IsEmpty());
  }
}

TEST(GltfMotion, TwoChannelsForOneThingAreLeftOut) {
  AnimatedGltf file = one_cube();
  file.channel(0, "translation", kTimes, kPlaces);
  file.channel(0, "scale", {0, 1}, {1, 1, 1, 2, 2, 2});
  file.channel(0, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
  const Unfollowed lost = only_unfollowed(file);
  EXPECT_EQ(lost.what, Unfollowed::What::place);
  EXPECT_THAT(lost.sentence, HasSubstr("channel 2, the translation of node 0 'cube': another channel"));
}

TEST(GltfMotion, PointersToNodesAreLeftOut) {
  const auto pointing = [](const char* to) {
    AnimatedGltf file = one_cube();
    file.channel(0, "translation", kTimes, kPlaces);
    file.channel(0, "scale", {0, 1}, {1, 1, 1, 2, 2, 2});
    file.root["animations"][0]["channels"][1]["target"] = {
        {"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", to}}}}}};
    return file;
  };
  EXPECT_EQ(only_unfollowed(pointing("/nodes/0/rotation")).what, Unfollowed::What::place);
  EXPECT_EQ(only_unfollowed(pointing("/nodes/0/weights/1")).what, Unfollowed::What::shape);
  EXPECT_EQ(only_unfollowed(pointing("/nodes/9/rotation")).node, std::nullopt);
  for (const char* harmless : {"/materials/0/emissiveFactor", "/nodes/0/extensions/KHR_node_visibility/visible", ""})
    EXPECT_THAT(read_text(pointing(harmless).text()).animations.at(0).unfollowed, IsEmpty()) << harmless;
}

/// assimp makes two nodes of it, of which only one would move.
TEST(GltfMotion, NodesWithTwoParentsAreNotFollowed) {
  AnimatedGltf file;
  const int part = file.node({{"name", "part"}, {"mesh", 0}});
  file.roots({file.node({{"children", {part}}}), file.node({{"children", {part}}, {"translation", {9, 0, 0}}})});
  file.animation("go");
  file.channel(part, "translation", kTimes, kPlaces);
  const Unfollowed lost = only_unfollowed(file);
  EXPECT_EQ(lost.what, Unfollowed::What::place);
  EXPECT_EQ(lost.node, std::nullopt);
}

/// assimp refuses a scene for each of these.
TEST(GltfMotion, BrokenAnimationsKeepNobodyFromReadingTheParts) {
  const std::vector<double> kWay{0, 0, 0, 1, 0, 0};
  const auto back_in_time = [&](AnimatedGltf& file) { file.channel(0, "translation", {3, 1}, kWay); };
  const auto too_few_values = [&](AnimatedGltf& file) { file.channel(0, "translation", {0, 1, 2}, kWay); };
  const auto no_keys = [&](AnimatedGltf& file) { file.channel(0, "translation", {}, {}); };
  const auto no_sampler = [&](AnimatedGltf& file) {
    back_in_time(file);
    file.root["animations"][0]["channels"][0]["sampler"] = 5;
  };
  const std::vector<std::function<void(AnimatedGltf&)>> kBreaks{back_in_time, too_few_values, no_keys, no_sampler};
  for (std::size_t i = 0; i < kBreaks.size(); ++i) {
    SCOPED_TRACE(i);
    AnimatedGltf file = one_cube();
    kBreaks[i](file);
    const Model model = read_text(file.text());
    EXPECT_EQ(model.objects.size(), 1U);
    ASSERT_EQ(model.animations.size(), 1U);
    EXPECT_THAT(model.animations[0].tracks, IsEmpty());
    EXPECT_EQ(model.animations[0].unfollowed.size(), 1U);
  }
  EXPECT_EQ(read_text(one_cube().text()).objects.size(), 1U) << "without a channel";
}

/// In a second scene nothing is shown, so that nothing is lost.
TEST(GltfMotion, ChannelsOfNodesThatAreNotShownAreNoLoss) {
  AnimatedGltf file = one_cube();
  const int hidden = file.node({{"name", "hidden"}, {"mesh", 0}});
  file.channel(0, "translation", kTimes, kPlaces);
  file.channel(hidden, "translation", {0, 3, 1}, kPlaces);
  const Model model = read_text(file.text());
  EXPECT_THAT(model.animations.at(0).unfollowed, IsEmpty());
  EXPECT_THAT(model.warnings, IsEmpty());
}

TEST(GltfMotion, WhatLastsNoTimeMovesNothing) {
  AnimatedGltf file = one_cube();
  file.channel(0, "translation", {0}, {1, 2, 3});
  const Model model = read_text(file.text());
  EXPECT_THAT(model.animations, IsEmpty());
  EXPECT_THAT(model.nodes, IsEmpty());
  EXPECT_EQ(model.objects.at(0).node, std::nullopt);
}

/// Its JSON, its numbers and its lengths are spoilt at random. There is a model that can be followed, or a sentence.
TEST(GltfMotion, MutatedFilesHaveAnAnswer) {
  AnimatedGltf file;
  const int hand = file.node({{"mesh", 0}, {"translation", {0, 3, 0}}});
  const int arm = file.node({{"rotation", {0, 0, 0, 1}}, {"children", {hand}}});
  file.roots({arm, file.node({{"mesh", 0}})});
  file.animation("a");
  file.channel(arm, "rotation", kTimes, kTurns);
  file.channel(hand, "translation", kTimes, kPlaces, "STEP");
  const std::string whole = file.glb();
  const std::size_t json_begin = whole.find("\"accessors\""), json_end = whole.find("\"bufferViews\"");
  const std::size_t motion_begin = whole.find("\"animations\"");
  const TemporaryFolder folder;
  const unsigned seed = 31;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  int followed = 0, refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::string mutated = whole;
    const std::string_view kLetters = "0123456789999-.,:[]{}\"x";
    for (int k = 0; k < 2; ++k) {
      switch (round % 3) {
        case 0:  // numbers of accessors and of animations
          while (true) {
            const std::size_t at = json_begin + random() % (json_end - json_begin);
            if (std::isdigit(static_cast<unsigned char>(mutated[at])) == 0) continue;
            mutated[at] = static_cast<char>('0' + random() % 10);
            break;
          }
          break;
        case 1:
          mutated[std::min(motion_begin, json_begin) + random() % (json_end - std::min(motion_begin, json_begin))] =
              kLetters[random() % kLetters.size()];
          break;
        default:  // the numbers themselves
          mutated[whole.size() - 1 - random() % 120] = static_cast<char>(random());
      }
    }
    const Result<Model> model = read(folder.write("mutated.glb", mutated));
    if (!model) {
      EXPECT_EQ(model.error().code, Code::bad_file) << round;
      ++refused;
      continue;
    }
    expect_sound(*model);
    for (const Animation& animation : model->animations) {
      EXPECT_TRUE(animation.seconds > 0 || !animation.unfollowed.empty()) << round;
      for (const double share : {0.0, 0.4, 1.0})
        EXPECT_EQ(nodes_at(*model, animation, share * animation.seconds).size(), model->nodes.size()) << round;
      ++followed;
    }
  }
  EXPECT_GT(followed, 50);
  EXPECT_GT(refused, 10);
}

/// The wheels turn about their axles once, both in the same time.
TEST(GltfMotion, TheWheelsOfTheMilkTruckTurn) {
  const Model model = model_of(read(kModels / "glTF/CesiumMilkTruck/CesiumMilkTruck.gltf"));
  expect_rest(model);
  ASSERT_EQ(model.animations.size(), 2u);
  for (const Animation& animation : model.animations) {
    EXPECT_THAT(animation.name, HasSubstr("animation")) << "the key of glTF 1";
    ASSERT_GT(animation.seconds, 0);
    double most = 0;
    for (int i = 0; i <= 20; ++i) {
      const auto worlds = nodes_at(model, animation, animation.seconds * i / 20);
      const auto rest = nodes_at(model, animation, 0);
      for (const Object& object : model.objects) {
        if (object.node != animation.tracks.at(0).node) continue;
        const Affine &now = worlds[*object.node], &then = rest[*object.node];
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(now.t[k], then.t[k], 1e-5) << "axles stay where they are";
        double trace = 0;
        for (std::size_t k = 0; k < 9; ++k) trace += now.m[k] * then.m[k];
        most = std::max(most, std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)));
      }
    }
    EXPECT_GT(most, 2.5) << "radians away from the beginning";
  }
}

TEST(GltfMotion, OtherFormatsMoveToo) {
  const std::map<std::string, std::string> kFiles{{"Collada/box_nested_animation.dae", "skins"},
                                                  {"FBX/animation_with_skeleton.fbx", "skins"},
                                                  {"X/Testwuson.X", "skins"},
                                                  {"3DS/RotatingCube.3DS", ""},
                                                  {"LWS/move_xz_linear.lws", ""},
                                                  {"ASE/RotatingCube.ASE", ""}};
  for (const auto& [name, warning] : kFiles) {
    SCOPED_TRACE(name);
    const Model model = model_of(read(kModels / name));
    expect_rest(model);
    ASSERT_FALSE(model.animations.empty());
    std::string warnings;
    for (const std::string& text : model.warnings) warnings += text + "\n";
    EXPECT_EQ(warnings.find("skins") != std::string::npos, !warning.empty()) << warnings;
    EXPECT_EQ(warnings.find("left out, for"), std::string::npos) << warnings;
    double moved = 0;
    for (const Animation& animation : model.animations) {
      const auto begin = nodes_at(model, animation, 0);
      for (int i = 1; i < 8; ++i) {
        const auto now = nodes_at(model, animation, animation.seconds * i / 8);
        for (std::size_t n = 0; n < now.size(); ++n) {
          for (std::size_t k = 0; k < 9; ++k) moved = std::max(moved, std::fabs(now[n].m[k] - begin[n].m[k]));
          for (std::size_t k = 0; k < 3; ++k) moved = std::max(moved, std::fabs(now[n].t[k] - begin[n].t[k]));
        }
      }
    }
    EXPECT_GT(moved, 1e-3);
    EXPECT_LT(moved, 1e6);
  }
}

}  // namespace
}  // namespace impinge::io
