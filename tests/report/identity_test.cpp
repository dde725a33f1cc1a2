// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What parts and clashes are known by from one revision of the files to the next.
#include "report/identity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <span>

namespace impinge::report {
namespace {

using Names = std::vector<std::string>;

TEST(NamesOfFiles, HaveAsManyFoldersAsTellThemApart) {
  EXPECT_EQ(names_of_files({"a.off", "sub/b.off", "/x/c.off"}), (Names{"a.off", "b.off", "c.off"}));
  EXPECT_EQ(names_of_files({"p/x.off", "q/x.off", "y.off"}), (Names{"p/x.off", "q/x.off", "y.off"}));
  EXPECT_EQ(names_of_files({"/1/p/x.off", "/1/2/q/x.off"}), (Names{"p/x.off", "q/x.off"}));
  EXPECT_EQ(names_of_files({"a/c/x", "b/c/x", "d/x"}), (Names{"a/c/x", "b/c/x", "d/x"}));
  EXPECT_EQ(names_of_files({"a/../p/x", "./q/x"}), (Names{"p/x", "q/x"}));
  EXPECT_EQ(names_of_files({}), Names{});
  EXPECT_EQ(names_of_files({"", "x"}), (Names{"", "x"}));
}

TEST(NamesOfFiles, DoNotHaveTheFolderThatAllAreIn) {
  // Otherwise a project that is in another folder next time would be another project.
  EXPECT_EQ(names_of_files({"/p/x", "/p/q/x"}), (Names{"./x", "q/x"}));
  EXPECT_EQ(names_of_files({"/p/a/x", "/p/b/a/x"}), (Names{"./a/x", "b/a/x"}));
  EXPECT_EQ(names_of_files({"/x", "/q/x"}), (Names{"./x", "q/x"}));
  EXPECT_EQ(names_of_files({"x/x", "x/x/x"}), (Names{"./x", "x/x"}));
}

TEST(NamesOfFiles, OfOneFileAreOne) {
  EXPECT_EQ(names_of_files({"x", "./x", "p/../x"}), (Names{"x", "x", "x"}));
  EXPECT_EQ(names_of_files({"p/x", "q/x", "./p/x"}), (Names{"p/x", "q/x", "p/x"}));
}

TEST(NamesOfFiles, AreUtf8AndStillUnlike) {
  EXPECT_EQ(names_of_files({"\xff.off", "\xfe.off", "\\xff.off"}), (Names{"\\xff.off", "\\xfe.off", "\\x5cxff.off"}));
  EXPECT_EQ(names_of_files({"p\xff/x", "p\xfe/x"}), (Names{"p\\xff/x", "p\\xfe/x"}));
  EXPECT_EQ(names_of_files({"\xc3\xa4.off"}), (Names{"\xc3\xa4.off"}));
}

TEST(NamesOfFiles, AreUnlikeWhateverTheTreeAndTheOrderAre) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (int trial = 0; trial < 300; ++trial) {
    std::set<std::string> files;
    for (int i = 0; i < 8; ++i) {
      std::string file;
      for (auto folders = random() % 4; folders > 0; --folders) file += random() % 2 == 0 ? "a/" : "b/";
      files.insert(file + (random() % 3 == 0 ? "y" : "x"));
    }
    Names order(files.begin(), files.end());
    const Names names = names_of_files(order);
    EXPECT_EQ(std::set(names.begin(), names.end()).size(), files.size());
    std::map<std::string, std::string> name_of;
    for (std::size_t i = 0; i < order.size(); ++i) name_of[order[i]] = names[i];
    std::shuffle(order.begin(), order.end(), random);
    Names moved, expected;
    for (const std::string& file : order) {
      moved.push_back("/some/other/place/" + file);
      expected.push_back(name_of[file]);
    }
    EXPECT_EQ(names_of_files(order), expected);
    EXPECT_EQ(names_of_files(moved), expected);
  }
}

/// An object that is one triangle, moved.
struct Made {
  std::uint32_t file;
  std::string path;
  double x = 0;
  std::string product;
};

Mesh triangle() {
  const std::vector<double> xyz{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::vector<std::uint32_t> corners{0, 1, 2};
  return Mesh::create(std::span<const double>(xyz), corners).value();
}

/// Names as the readers give them: numbered by their order where several are the same.
std::vector<Identity> identities(const std::vector<std::string>& files, const std::vector<Made>& made) {
  Assembly assembly;
  assembly.files = files;
  const Mesh mesh = triangle();
  for (std::size_t i = 0; i < made.size(); ++i) {
    io::Object object{made[i].path + std::to_string(i), made[i].path, made[i].product, mesh, {}};
    object.pose.t[0] = made[i].x;
    assembly.objects.push_back(std::move(object));
    assembly.file_of.push_back(made[i].file);
  }
  return identities_of(assembly, names_of_files(files));
}

void expect_unlike(const std::vector<Identity>& all) {
  std::set<std::string> keys;
  for (const Identity& one : all) EXPECT_TRUE(keys.insert(one.key).second) << one.key;
}

TEST(Identities, OfPartsOfOneNameAreTheirFilesAndFolders) {
  const auto all = identities({"l/p.off", "r/p.off"}, {{0, "bolt"}, {1, "bolt"}});
  expect_unlike(all);
  const auto turned = identities({"/else/r/p.off", "/else/l/p.off"}, {{0, "bolt", 7}, {1, "bolt", 8}});
  EXPECT_EQ(turned[0].key, all[1].key) << "moved, in another place, in another order";
  EXPECT_EQ(turned[1].key, all[0].key);
  // What was alone has not the name of either, once there are two.
  const auto alone = identities({"l/p.off"}, {{0, "bolt"}});
  EXPECT_NE(alone[0].key, all[0].key);
  EXPECT_NE(alone[0].key, all[1].key);
}

TEST(Identities, OfPartsOfOnePathAreTheirPlaces) {
  const auto all = identities({"a.glb"}, {{0, "bolt", 1}, {0, "bolt", 2}, {0, "nut", 1}});
  expect_unlike(all);
  const auto more = identities({"a.glb"}, {{0, "bolt", 3}, {0, "nut", 9}, {0, "bolt", 2}, {0, "bolt", 1}, {0, "pin"}});
  expect_unlike(more);
  EXPECT_EQ(more[3].key, all[0].key);
  EXPECT_EQ(more[2].key, all[1].key);
  EXPECT_EQ(more[1].key, all[2].key) << "the only nut, wherever it is";
}

TEST(Identities, OfTwinsAreTheirOrder) {
  const auto all = identities({"a.glb"}, {{0, "bolt", 1}, {0, "bolt", 2}, {0, "bolt", 1}, {0, "nut", 1}});
  expect_unlike(all);
  // The first of them is known by what the one that is alone is known by, with and without namesakes elsewhere.
  const auto one = identities({"a.glb"}, {{0, "bolt", 1}, {0, "bolt", 2}});
  EXPECT_EQ(one[0].key, all[0].key);
  EXPECT_NE(one[0].key, all[2].key);
  const auto both = identities({"a.glb"}, {{0, "bolt", 1}, {0, "bolt", 1}}),
             alone = identities({"a.glb"}, {{0, "bolt", 1}});
  EXPECT_EQ(alone[0].key, both[0].key);
  EXPECT_NE(alone[0].key, both[1].key);
  EXPECT_EQ(one[1].key, all[1].key);
  // -0 is 0; and a file that is read twice.
  const auto zeros = identities({"a.glb"}, {{0, "bolt", 0.0}, {0, "bolt", -0.0}});
  EXPECT_EQ(zeros[0].placed, zeros[1].placed);
  const auto twice = identities({"a.off", "./a.off"}, {{0, "bolt"}, {1, "bolt"}});
  expect_unlike(twice);
}

TEST(Identities, OfTextsThatRunIntoEachOtherAreUnlike) {
  expect_unlike(identities({"a", "a1:"}, {{0, "1:b"}, {1, "b"}, {0, "b"}, {0, ""}, {1, "1:b"}, {0, "1:b0:"}}));
}

TEST(Identities, OfIfcProductsAreTheirGlobalIds) {
  const std::string wall = "IfcWall_North_2O2Fr$t4X7Zf8NOew3FNr2", renamed = "IfcWall_South_2O2Fr$t4X7Zf8NOew3FNr2",
                    other = "IfcWall_North_1srAI$R4T8ihLXSNHmUSET";
  const auto all = identities({"a.ifc"}, {{0, "house/North", 0, wall}, {0, "house/North", 0, other}});
  expect_unlike(all);
  const auto later = identities({"a.ifc"}, {{0, "house/North", 0, other}, {0, "house/up/South", 3, renamed}});
  EXPECT_EQ(later[1].key, all[0].key);
  EXPECT_EQ(later[0].key, all[1].key);
  // A product of several parts, and a file that repeats a GlobalId.
  const auto several = identities({"a.ifc"}, {{0, "n", 1, wall}, {0, "n", 2, wall}, {0, "n", 3, wall + " (2)"}});
  expect_unlike(several);
}

TEST(IfcGuid, IsTheEndOfTheProduct) {
  const auto guid = [](const std::string& product) {
    const Result<Mesh> mesh = Mesh::create(std::span<const double>(), {});
    const io::Object object{"wall", "house/wall", product, *mesh, {}};
    return std::string(ifc_guid(object));
  };
  EXPECT_EQ(guid("IfcWindow_EG-Fenster-6_1srAI$R4T8ihLXSNHmUSET"), "1srAI$R4T8ihLXSNHmUSET");
  EXPECT_EQ(guid("IfcWindow_EG-Fenster-6_1srAI$R4T8ihLXSNHmUSET (2)"), "1srAI$R4T8ihLXSNHmUSET");
  EXPECT_EQ(guid("IfcSite__1Qvf0xqDT4HXo8jI81mHB$"), "1Qvf0xqDT4HXo8jI81mHB$");
  EXPECT_EQ(guid(""), "");
  EXPECT_EQ(guid("wall"), "");
  EXPECT_EQ(guid("a product of some other kind, long enough"), "");
  EXPECT_EQ(guid(")"), "");
}

}  // namespace
}  // namespace impinge::report
