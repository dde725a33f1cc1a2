// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// --ignore: names, patterns, and what it says about words that name nothing.
#include <gtest/gtest.h>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

/// Three cubes around one corner: every two of them touch.
class Ignore : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("plate.off", off(cube(0, 0, 0)));
    folder.write("bolt_1.off", off(cube(2, 0, 0)));
    folder.write("bolt_2.off", off(cube(2, 2, 0)));
  }
  /// How many pairs of objects are left, or the sentence.
  std::string left(std::vector<std::string> more) const {
    const Ended run = impinge(folder, joined({"check", "plate.off", "bolt_1.off", "bolt_2.off"}, more));
    if (run.code == 2) return run.err;
    if (run.code == 0) return run.out.substr(0, run.out.find('\n'));
    const std::size_t end = run.out.find(" of objects touch");
    return run.out.substr(run.out.rfind('\n', end) + 1, end - run.out.rfind('\n', end) - 1);
  }
  Folder folder;
};

TEST_F(Ignore, LeavesOutNamedPairsInEitherOrder) {
  EXPECT_EQ(left({}), "3 pairs");
  EXPECT_EQ(left({"--ignore", "plate", "bolt_1"}), "2 pairs");
  EXPECT_EQ(left({"--ignore", "bolt_1", "plate"}), "2 pairs");
  EXPECT_EQ(left({"--ignore", "bolt_1", "plate", "--ignore", "plate", "bolt_2"}), "1 pair");
}

TEST_F(Ignore, TakesPatterns) {
  EXPECT_EQ(left({"--ignore", "plate", "bolt*"}), "1 pair");
  EXPECT_EQ(left({"--ignore", "bolt_?", "bolt_?"}), "2 pairs");
  EXPECT_EQ(left({"--ignore", "*", "*"}), "Nothing touches.");
  EXPECT_EQ(left({"--ignore", "*_1", "pl?te"}), "2 pairs");
}

TEST_F(Ignore, AWordThatIsANameIsNoPattern) {
  folder.write("*.off", off(cube(0, 2, 0)));
  // Named "*", it shares a corner, an edge or a face with each of the three.
  EXPECT_EQ(left({"*.off"}), "6 pairs");
  EXPECT_EQ(left({"*.off", "--ignore", "*", "plate"}), "5 pairs");
  EXPECT_EQ(left({"*.off", "--ignore", "**", "plate"}), "3 pairs");
}

TEST_F(Ignore, NamesTheNearestNameForATypingError) {
  EXPECT_EQ(left({"--ignore", "plaet", "bolt_1"}),
            "impinge: --ignore: nothing is named 'plaet'; the nearest name is 'plate'\n");
  EXPECT_EQ(left({"--ignore", "plate", "BOLT-2*"}),
            "impinge: --ignore: nothing is named 'BOLT-2*'; the nearest name is 'bolt_2'\n");
}

TEST_F(Ignore, BetweenLooksAtTwoFilesAlone) {
  folder.write("pair.gltf", gltf({{"lid", {0, 2, 0}}, {"rim", {0, 0, 2}}}));
  const auto found = [&](const std::string& a, const std::string& b) {
    const Ended run = impinge(folder, {"clash", "plate.off", "bolt_1.off", "pair.gltf", "--between", a, b});
    return run.code == 2 ? run.err : run.out.substr(0, run.out.find("\n\n"));
  };
  EXPECT_EQ(found("plate.off", "bolt_1.off"), "verdict   part   part\ntouching  plate  bolt_1");
  EXPECT_EQ(found("pair.gltf", "plate.off"), "verdict   part   part\ntouching  plate  lid\ntouching  plate  rim");
  EXPECT_EQ(found("plate.off", "bolt.off"),
            "impinge: --between bolt.off: it is none of the files to read; the nearest is 'bolt_1.off'\n");
  EXPECT_EQ(
      impinge(folder, {"clash", "plate.off", "bolt_1.off", "plate.off", "--between", "plate.off", "bolt_1.off"}).err,
      "impinge: --between plate.off: 2 of the files to read have this name; name each once\n");
}

TEST_F(Ignore, RefusesAPairThatIsNone) {
  EXPECT_NE(left({"--ignore", "plate", "pl*"}).find("names only one object"), std::string::npos);
}

TEST_F(Ignore, TakesALabelAsItIsPrinted) {
  folder.write("pair.gltf", gltf({{"plate", {0, 2, 0}}, {"lid", {0, 0, 2}}}));
  // Five objects around one corner; "plate" is in two files.
  EXPECT_EQ(left({"pair.gltf"}), "10 pairs");
  EXPECT_EQ(left({"pair.gltf", "--ignore", "plate (pair.gltf)", "lid"}), "9 pairs");
  EXPECT_EQ(left({"pair.gltf", "--ignore", "plate", "lid"}), "8 pairs");
  EXPECT_EQ(left({"pair.gltf", "--ignore", "plate", "plate"}), "9 pairs");
}

}  // namespace
}  // namespace impinge::test
