// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What same_parent leaves out: it goes by the nodes of the files, whatever these are called.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "meshes.hpp"
#include "program.hpp"
#include "tests/io/animated_gltf.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;
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
  [[nodiscard]] Pairs left(const std::vector<std::string>& files) const {
    folder.write("c.json", R"({"tests":[{"name":"t","a":"*","ignore":{"same_parent":true}}]})");
    const Ended run = impinge(folder, joined({"clash", "--config", "c.json", "--json", "-"}, files));
    EXPECT_LE(run.code, 1) << run.err;
    Pairs pairs;
    const json report = json::parse(run.out);
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
