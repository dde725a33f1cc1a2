// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// --ignore: names, patterns, and what it says about words that name nothing.
#include <set>

#include "meshes.hpp"
#include "program.hpp"
#include "tests/io/animated_gltf.hpp"

namespace impinge::test {
namespace {

/// Three cubes around one corner: every two of them touch.
class Ignore : public testing::Test {
 protected:
  void SetUp() override {
    write_off(folder, {{"plate", cube(0, 0, 0)}, {"bolt_1", cube(2, 0, 0)}, {"bolt_2", cube(2, 2, 0)}});
  }
  /// How many pairs of objects are left, or the sentence.
  std::string left(Words more) const {
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
  EXPECT_THAT(left({"--ignore", "plate", "pl*"}), HasSubstr("names only one object"));
}

TEST_F(Ignore, TakesALabelAsItIsPrinted) {
  folder.write("pair.gltf", gltf({{"plate", {0, 2, 0}}, {"lid", {0, 0, 2}}}));
  // Five objects around one corner; "plate" is in two files.
  EXPECT_EQ(left({"pair.gltf"}), "10 pairs");
  EXPECT_EQ(left({"pair.gltf", "--ignore", "plate (pair.gltf)", "lid"}), "9 pairs");
  EXPECT_EQ(left({"pair.gltf", "--ignore", "plate", "lid"}), "8 pairs");
  EXPECT_EQ(left({"pair.gltf", "--ignore", "plate", "plate"}), "9 pairs");
}

// What same_parent leaves out: it goes by the nodes of the files, whatever these are called.

using Pairs = std::set<std::string>;

/// A file of parts in nodes. Each part is a cube of edge 2, and they are so near that any two of a test overlap.
class Tree : public AnimatedGltf {
 public:
  /// A part; with an empty name one that nobody has named.
  int part(const std::string& name) {
    const double shift = 0.01 * ++parts_;
    return node(named(name, {{"mesh", 0}, {"translation", {shift, 2 * shift, 3 * shift}}}));
  }
  int group(const std::string& name, const std::vector<int>& children) {
    return node(named(name, {{"children", children}}));
  }

 private:
  static json named(const std::string& name, json about) {
    if (!name.empty()) about["name"] = name;
    return about;
  }
  int parts_ = 0;
};

class SameParent : public testing::Test {
 protected:
  /// "a b" of each pair that is left, by names, when all parts are held against each other.
  [[nodiscard]] Pairs left(const Words& files) const {
    folder.write("c.json", R"({"tests":[{"name":"t","a":"*","ignore":{"same_parent":true}}]})");
    Pairs pairs;
    const json report = document(folder, joined({"clash", "--config", "c.json"}, files), 1);
    for (const json& pair : report.at("pairs"))
      pairs.insert(name_in(report, pair, "a") + " " + name_in(report, pair, "b"));
    return pairs;
  }
  Folder folder;
};

TEST_F(SameParent, TwoAssembliesOfOneNameAreTwo) {
  Tree tree;
  const int one = tree.group("asm", {tree.part("p"), tree.part("q")});
  const int two = tree.group("asm", {tree.part("r"), tree.part("s")});
  tree.roots({tree.group("plant", {one, two})});
  folder.write("m.glb", tree.glb());
  EXPECT_EQ(left({"m.glb"}), (Pairs{"p r", "p s", "q r", "q s"}));
}

TEST_F(SameParent, GroupsWithoutANameAreParents) {
  Tree tree;
  const int one = tree.group("", {tree.part("p"), tree.part("q")});
  const int two = tree.group("", {tree.part("r"), tree.group("", {tree.part("s")})});
  tree.roots({tree.group("plant", {one, two})});
  folder.write("m.glb", tree.glb());
  EXPECT_EQ(left({"m.glb"}), (Pairs{"p r", "p s", "q r", "q s", "r s"}));
}

TEST_F(SameParent, ASlashInANameIsNoParent) {
  folder.write("flat.obj",
               "o pipe 1/2\nv 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
               "o pipe 1/4\nv 0.1 0.1 0.1\nv 2.1 0.1 0.1\nv 0.1 2.1 0.1\nv 0.1 0.1 2.1\n"
               "f 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n");
  EXPECT_EQ(left({"flat.obj"}), Pairs{"pipe 1/2 pipe 1/4"});
  Tree tree;
  tree.roots({tree.part("DN 1/2"), tree.part("DN 1/4"), tree.group("valve", {tree.part("seat"), tree.part("disc 1/2")}),
              tree.group("valve", {tree.part("disc 1/4")})});
  folder.write("m.glb", tree.glb());
  EXPECT_EQ(left({"m.glb"}), (Pairs{"DN 1/2 DN 1/4", "DN 1/2 seat", "DN 1/2 disc 1/2", "DN 1/2 disc 1/4", "DN 1/4 seat",
                                    "DN 1/4 disc 1/2", "DN 1/4 disc 1/4", "seat disc 1/4", "disc 1/2 disc 1/4"}));
}

TEST_F(SameParent, TheRootOfAFileAndNodesOfTwoFilesAreNone) {
  for (const std::string name : {"", "plant"}) {
    Tree tree;
    tree.roots({tree.group(name, {tree.part("p"), tree.part("q")})});
    folder.write("m.glb", tree.glb());
    EXPECT_EQ(left({"m.glb"}), Pairs{"p q"}) << name;
  }
  for (const char* const parts : {"pq", "rs"}) {
    Tree tree;
    const int group = tree.group("asm", {tree.part({parts, 1}), tree.part({parts + 1, 1})});
    tree.roots({tree.group("plant", {group})});
    folder.write(std::string(parts) + ".glb", tree.glb());
  }
  EXPECT_EQ(left({"pq.glb", "rs.glb"}), (Pairs{"p r", "p s", "q r", "q s"}));
}

}  // namespace
}  // namespace impinge::test
