// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What impinge motion cannot follow: channels that are broken, and parts whose shape changes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "motion_fixture.hpp"
#include "tests/io/animated_gltf.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;

/// Two cubes of which one goes through the other, and a third node that goes elsewhere.
AnimatedGltf two_channels(const json& third, const std::vector<double>& times, const std::vector<double>& places) {
  AnimatedGltf file;
  const int still = file.node({{"name", "still"}, {"mesh", 0}});
  const int moving = file.node({{"name", "moving"}, {"mesh", 0}});
  file.roots({still, moving, file.node(third)});
  file.animation("pass");
  file.channel(2, "translation", {0, 8}, {20, 0, 0, 30, 0, 0});
  file.channel(moving, "translation", times, places);
  return file;
}

/// Of a motion that is not known nothing is said, least of all that nothing clashes.
TEST_F(Motion, AChannelThatCannotBeFollowedIsAnError) {
  const std::vector<double> kWay{-4, 0, 0, 0, 0, 0, 4, 0, 0};
  const std::vector<double> kNoTimes{0, std::nan(""), 8};
  for (const auto& times : {std::vector<double>{0, 8, 4}, kNoTimes, {0, 8}})
    for (const bool is_quiet : {false, true}) {
      folder.write("case.glb", two_channels({{"name", "third"}, {"mesh", 0}}, times, kWay).glb());
      const Ended ended =
          run(is_quiet ? std::vector<std::string>{"--quiet", "--json", "out.json"} : std::vector<std::string>{});
      EXPECT_EQ(ended.code, 2) << ended.out;
      EXPECT_EQ(ended.out, "");
      EXPECT_NE(
          ended.err.find("case.glb: animation 'pass' cannot be run: channel 1, the translation of node 1 'moving': "),
          std::string::npos)
          << ended.err;
      EXPECT_EQ(ended.err.find("--animation"), std::string::npos) << "there is no other";
      EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.json"));
    }
  // Where its parts stand is known all the same.
  EXPECT_EQ(impinge(folder, {"clash", "case.glb"}).code, 1);
}

TEST_F(Motion, AnotherAnimationIsRunAllTheSame) {
  AnimatedGltf file = two_channels({{"name", "third"}, {"mesh", 0}}, {0, 8, 4}, {-4, 0, 0, 0, 0, 0, 4, 0, 0});
  file.channel(0, "rotation", {0, 1}, {0, 0, 0, 0, 0, 0, 0, 0});
  file.animation("sound");
  file.channel(1, "translation", {0, 8}, {-4, 0, 0, 4, 0, 0});
  folder.write("case.glb", file.glb());
  const Ended ended = run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find(", and so with 1 more channel; "), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("or choose another by --animation\n"), std::string::npos) << ended.err;
  EXPECT_EQ(run({"--animation", "sound"}).code, 1);
}

/// It is the only channel, so that nothing moves; but not because there were none.
TEST_F(Motion, AnAnimationThatIsBrokenAltogetherIsNotCalledMissing) {
  AnimatedGltf file;
  file.roots({file.node({{"name", "part"}, {"mesh", 0}})});
  file.animation("go");
  file.channel(0, "translation", {0, 1, 2}, {0, 0, 0, 1, std::nan(""), 0, 2, 0, 0});
  folder.write("case.glb", file.glb());
  const Ended ended = run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("'go' cannot be run: "), std::string::npos) << ended.err;
  EXPECT_EQ(ended.err.find("no animation"), std::string::npos) << ended.err;
}

/// It moves no part, nor anything that has one: the answer is whole, and what is strange about the file is said.
TEST_F(Motion, ABrokenChannelOfNoPartDoesNoHarm) {
  AnimatedGltf file = two_channels({{"name", "light"}}, {0, 8}, {-4, 0, 0, 4, 0, 0});
  file.channel(2, "rotation", {0, 8}, {0, 0, 0, 0, 0, 0, 0, 0});
  folder.write("case.glb", file.glb());
  const Ended ended = run({"--json", "out.json"});
  EXPECT_EQ(ended.code, 1);
  const std::string_view kSaid = "animation 'pass' has a channel that cannot be followed, but moves no part: channel 2";
  EXPECT_NE(ended.err.find(kSaid), std::string::npos) << ended.err;
  const json report = json::parse(folder.read("out.json"));
  ASSERT_EQ(report.at("left_out").size(), 1U);
  EXPECT_TRUE(report["left_out"][0].get<std::string>().starts_with(kSaid));
  EXPECT_EQ(run({"--quiet"}).err, "");
  // A part below it is moved by it.
  file.root["nodes"][2]["children"] = {3};
  file.node({{"name", "lamp"}, {"mesh", 0}});
  folder.write("case.glb", file.glb());
  EXPECT_EQ(run().code, 2);
}

/// Parts that an animation would bend keep their shape, as is documented: the answer names them, quiet or not.
TEST_F(Motion, PartsWhoseShapeWouldChangeAreNamed) {
  AnimatedGltf file = two_channels({{"name", "third"}, {"mesh", 0}}, {0, 8}, {9, 0, 0, 9, 0, 0});
  file.channel(0, "weights", file.floats({0, 8}, "SCALAR"), file.floats({0, 1}, "SCALAR"), "LINEAR");
  folder.write("case.glb", file.glb());
  const std::string kSaid =
      "animation 'pass' changes the shape of part 'still', which keeps its shape here: its morph targets are animated";
  const Ended quiet = run({"--quiet", "--json", "out.json"});
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.err, "impinge: " + kSaid + "\n");
  EXPECT_EQ(json::parse(folder.read("out.json")).at("left_out"), json::array({kSaid}));
  // With nothing else nothing is run.
  AnimatedGltf face;
  face.roots({face.node({{"name", "face"}, {"mesh", 0}})});
  face.animation("smile");
  face.channel(0, "weights", face.floats({0, 8}, "SCALAR"), face.floats({0, 1}, "SCALAR"), "LINEAR");
  folder.write("case.glb", face.glb());
  const Ended smile = run();
  EXPECT_EQ(smile.code, 2);
  EXPECT_NE(smile.err.find("nothing moves in it: animation 'smile' changes the shape of part 'face'"),
            std::string::npos)
      << smile.err;
}

/// Nothing is left of a part that is scaled to nothing where it rests.
TEST_F(Motion, APartWithoutAShapeIsAnError) {
  AnimatedGltf file;
  const int part = file.node({{"name", "seed"}, {"mesh", 0}, {"scale", {0, 0, 0}}});
  file.roots({part});
  file.animation("grow");
  file.channel(part, "scale", {0, 1}, {0, 0, 0, 1, 1, 1});
  folder.write("case.glb", file.glb());
  const Ended ended = run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("'seed'"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("scale other than 0"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace impinge::test
