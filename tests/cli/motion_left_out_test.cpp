// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What impinge motion cannot follow: channels that are broken, and parts whose shape changes.
#include <cmath>
#include <filesystem>

#include "motion_fixture.hpp"

namespace impinge::test {
namespace {

/// Two cubes of which one goes through the other, and a third node that goes elsewhere.
AnimatedGltf two_channels(const json& third, const std::vector<double>& times, const std::vector<double>& places) {
  AnimatedGltf file = still_and_moving();
  file.roots({0, 1, file.node(third)});
  file.channel(2, "translation", {0, 8}, {20, 0, 0, 30, 0, 0});
  file.channel(1, "translation", times, places);
  return file;
}

/// Of a motion that is not known nothing is said, least of all that nothing clashes.
TEST_F(Motion, AChannelThatCannotBeFollowedIsAnError) {
  const std::vector<double> kWay{-4, 0, 0, 0, 0, 0, 4, 0, 0};
  const std::vector<double> kNoTimes{0, std::nan(""), 8};
  for (const auto& times : {std::vector<double>{0, 8, 4}, kNoTimes, {0, 8}})
    for (const Words& words : {Words{}, {"--quiet", "--json", "out.json"}}) {
      write(two_channels({{"name", "third"}, {"mesh", 0}}, times, kWay));
      EXPECT_THAT(
          refused(words),
          AllOf(HasSubstr("case.glb: animation 'pass' cannot be run: channel 1, the translation of node 1 'moving': "),
                Not(HasSubstr("--animation"))))
          << "there is no other";
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
  write(file);
  EXPECT_THAT(refused(),
              AllOf(HasSubstr(", and so with 1 more channel; "), HasSubstr("or choose another by --animation\n")));
  EXPECT_EQ(run({"--animation", "sound"}).code, 1);
}

/// It is the only channel, so that nothing moves; but not because there were none.
TEST_F(Motion, AnAnimationThatIsBrokenAltogetherIsNotCalledMissing) {
  AnimatedGltf file;
  file.roots({file.node({{"name", "part"}, {"mesh", 0}})});
  file.animation("go");
  file.channel(0, "translation", {0, 1, 2}, {0, 0, 0, 1, std::nan(""), 0, 2, 0, 0});
  write(file);
  EXPECT_THAT(refused(), AllOf(HasSubstr("'go' cannot be run: "), Not(HasSubstr("no animation"))));
}

/// It moves no part, nor anything that has one: the answer is whole, and what is strange about the file is said.
TEST_F(Motion, ABrokenChannelOfNoPartDoesNoHarm) {
  AnimatedGltf file = two_channels({{"name", "light"}}, {0, 8}, {-4, 0, 0, 4, 0, 0});
  file.channel(2, "rotation", {0, 8}, {0, 0, 0, 0, 0, 0, 0, 0});
  write(file);
  const Ended ended = run({"--json", "out.json"});
  EXPECT_EQ(ended.code, 1);
  const std::string_view kSaid = "animation 'pass' has a channel that cannot be followed, but moves no part: channel 2";
  EXPECT_THAT(ended.err, HasSubstr(kSaid));
  const json report = json::parse(folder.read("out.json"));
  ASSERT_EQ(report.at("left_out").size(), 1U);
  EXPECT_THAT(report["left_out"][0].get<std::string>(), StartsWith(kSaid));
  EXPECT_EQ(run({"--quiet"}).err, "");
  // A part below it is moved by it.
  file.root["nodes"][2]["children"] = {3};
  file.node({{"name", "lamp"}, {"mesh", 0}});
  write(file);
  EXPECT_EQ(run().code, 2);
}

/// Parts that an animation would bend keep their shape, as is documented: the answer names them, quiet or not.
TEST_F(Motion, PartsWhoseShapeWouldChangeAreNamed) {
  AnimatedGltf file = two_channels({{"name", "third"}, {"mesh", 0}}, {0, 8}, {9, 0, 0, 9, 0, 0});
  file.channel(0, "weights", file.floats({0, 8}, "SCALAR"), file.floats({0, 1}, "SCALAR"), "LINEAR");
  write(file);
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
  write(face);
  EXPECT_THAT(refused(), HasSubstr("nothing moves in it: animation 'smile' changes the shape of part 'face'"));
}

/// Nothing is left of a part that is scaled to nothing where it rests.
TEST_F(Motion, APartWithoutAShapeIsAnError) {
  AnimatedGltf file;
  const int part = file.node({{"name", "seed"}, {"mesh", 0}, {"scale", {0, 0, 0}}});
  file.roots({part});
  file.animation("grow");
  file.channel(part, "scale", {0, 1}, {0, 0, 0, 1, 1, 1});
  write(file);
  EXPECT_THAT(refused(), AllOf(HasSubstr("'seed'"), HasSubstr("scale other than 0")));
}

}  // namespace
}  // namespace impinge::test
