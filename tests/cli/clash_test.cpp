// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What `impinge clash` prints and ends with, on boxes whose verdicts follow from their corners.
#include "impinge/clash.hpp"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;

/// One pair of each verdict, far from the others; the parts of each lie in the order of their names.
class Clash : public testing::Test {
 protected:
  void SetUp() override {
    write("a", box({0, 0, 0}, {2, 2, 2})), write("b", box({1, 1, 1}, {3, 3, 3}));            // penetrating, 1 deep
    write("c", box({3, 1, 1}, {5, 3, 3}));                                                   // touches b
    write("big", box({20, 0, 0}, {26, 6, 6})), write("small", box({22, 2, 2}, {24, 4, 4}));  // inside
    write("d", box({40, 0, 0}, {42, 2, 2})), write("d2", box({40, 0, 0}, {42, 2, 2}));       // duplicate
    write("e", box({60, 0, 0}, {62, 2, 2})), write("sheet", sheet({59, -1}, {63, 3}, 1));    // crossing
    write("f", box({80, 0, 0}, {82, 2, 2})), write("g", box({85, 4, 0}, {87, 6, 2}));        // apart: 3, 2, 0
  }
  void write(const std::string& name, const Solid& solid) {
    folder.write(name + ".off", off(solid));
    files.push_back(name + ".off");
  }
  [[nodiscard]] Ended clash(const std::vector<std::string>& more, const Launch& launch = {}) const {
    return impinge(folder, joined(joined({"clash"}, files), more), launch);
  }
  Folder folder;
  std::vector<std::string> files;
};

/// The lines up to the next empty one.
std::string first_block(const std::string& text) { return text.substr(0, text.find("\n\n") + 1); }

TEST_F(Clash, PrintsARankedTableTheSurfacesAndASummary) {
  const Ended run = clash({"--tolerance", "0.001", "--depth", "none"});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(first_block(run.out),
            "verdict      part   part\n"
            "duplicate    d      d2\n"
            "inside       small  big\n"
            "penetrating  a      b\n"
            "crossing     e      sheet\n"
            "touching     b      c\n");
  EXPECT_NE(run.out.find("\n\nsheet is a surface: 4 open edges, first at ("), std::string::npos) << run.out;
  EXPECT_NE(
      run.out.find(
          "\n\n11 parts, 10 solids, 0 cracked solids, 1 surface; 1 duplicate, 1 inside, 1 penetrating, 1 crossing, "
          "1 touching; tolerance 0.001.\n"
          "4 pairs fail (penetration, inside).\n"
          "122 triangles; read in "),
      std::string::npos)
      << run.out;
}

TEST_F(Clash, ClearanceListsWhatIsNearWithItsDistance) {
  // The distance is the square root of 13.
  const Ended run = clash({"--clearance", "3.61", "--tolerance", "0", "--depth", "none"});
  EXPECT_EQ(first_block(run.out),
            "verdict      part   part   distance  note\n"
            "duplicate    d      d2            -  -\n"
            "inside       small  big           2  -\n"
            "penetrating  a      b             -  -\n"
            "crossing     e      sheet         -  tolerance raised\n"
            "touching     b      c             -  -\n"
            "apart        a      c             1  -\n"
            "apart        f      g         3.606  -\n");
  EXPECT_NE(run.out.find("1 touching, 2 nearer than 3.61; no tolerance.\n"), std::string::npos) << run.out;
  EXPECT_EQ(clash({"--clearance", "3.6"}).out.find("apart        f"), std::string::npos);
}

TEST_F(Clash, DepthAndRegionsHaveColumns) {
  const Ended run = clash({"--depth", "0.01", "--regions"});
  std::istringstream lines(run.out);
  std::map<std::string, std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line) && !line.empty();) {
    std::istringstream words(line);
    std::string verdict;
    words >> verdict;
    for (std::string word; words >> word;) rows[verdict].push_back(word);
  }
  EXPECT_EQ(rows["verdict"], (std::vector<std::string>{"part", "part", "depth", "regions"}));
  ASSERT_EQ(rows["penetrating"].size(), 4U) << run.out;
  EXPECT_NEAR(std::stod(rows["penetrating"][2]), 1.0, 0.011);  // a corner of each is the middle of the other
  EXPECT_EQ(rows["penetrating"][3], "1");
  ASSERT_EQ(rows["inside"].size(), 4U) << run.out;
  EXPECT_NEAR(std::stod(rows["inside"][2]), 3.0, 0.15);  // the middle of the big one is in the small one
  EXPECT_EQ(rows["inside"][3], "0");
  // What only touches has no depth.
  EXPECT_EQ(rows["touching"], (std::vector<std::string>{"b", "c", "-", "1"})) << run.out;
  ASSERT_EQ(rows["crossing"].size(), 4U) << run.out;
  EXPECT_NEAR(std::stod(rows["crossing"][2]), 1.0, 0.011);  // the sheet goes through the middle
  EXPECT_EQ(first_block(clash({"--depth", "none"}).out).find("depth"), std::string::npos);
}

TEST_F(Clash, VolumesAreMissingForAReason) {
  const Ended run = clash({"--volume"});
  const std::string reason =
      "\n1 pair without a volume, though they overlap: one of the parts is not solid in all its pieces.\n";
  EXPECT_NE(run.out.find(reason), std::string::npos) << run.out;  // of the sheet
  EXPECT_EQ(clash({}).out.find("without a volume"), std::string::npos);
  EXPECT_EQ(impinge(folder, {"clash", "a.off", "b.off", "--volume"}).out.find("without a volume"), std::string::npos);
}

/// The post's middle line in the plate is 1 away from the post's faces and from the plate's.
TEST_F(Clash, ADepthThatIsWideIsToldFromTheLeastToTheMost) {
  folder.write("plate.off", off(box({-5, -5, 0}, {5, 5, 2})));
  folder.write("post.off", off(box({-1, -1, -5}, {1, 1, 5})));
  const auto told = [&](const std::string& tolerance) {
    const Ended run = impinge(folder, {"clash", "plate.off", "post.off", "--tolerance", tolerance});
    const std::string row = run.out.substr(0, run.out.find("\n\n"));
    return row.substr(row.find_last_of(' ') + 1);
  };
  EXPECT_NEAR(std::stod(told("0.5")), 1, 0.05);
  EXPECT_EQ(told("0.5").find(".."), std::string::npos);
  int wide = 0;
  for (const char* tolerance : {"1.2", "1.5", "2", "3", "5"}) {  // the search ends where none is within the interval
    const std::string text = told(tolerance);
    const std::size_t dots = text.find("..");
    wide += dots == std::string::npos ? 0 : 1;
    EXPECT_LE(std::stod(text), dots == std::string::npos ? 1.2 : 1.0001) << text;
    EXPECT_GE(std::stod(dots == std::string::npos ? text : text.substr(dots + 2)), 0.9999) << text;
  }
  EXPECT_GT(wide, 0);
}

TEST_F(Clash, LimitShortensTheTableAlone) {
  const Ended run = clash({"--limit", "2", "--json", "out.json", "--depth", "none"});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(first_block(run.out),
            "verdict    part   part\n"
            "duplicate  d      d2\n"
            "inside     small  big\n"
            "(2 of 5 pairs, by --limit; --json has them all.)\n");
  EXPECT_EQ(json::parse(folder.read("out.json")).at("pairs").size(), 5U);
  EXPECT_EQ(clash({"--limit", "0"}).out.substr(0, 8), "(0 of 5 ");
  EXPECT_EQ(clash({"--limit", "5"}).out.find("by --limit"), std::string::npos);
}

TEST_F(Clash, ExitCodeIsWhatFailOnNames) {
  struct Scene {
    std::vector<std::string> files;
    std::set<std::string> words;  ///< that make it fail
  };
  const std::vector<Scene> scenes{{{"a.off", "b.off"}, {"penetration", "contact"}},
                                  {{"d.off", "d2.off"}, {"penetration", "contact"}},
                                  {{"e.off", "sheet.off"}, {"penetration", "contact"}},
                                  {{"big.off", "small.off"}, {"inside", "contact"}},
                                  {{"b.off", "c.off"}, {"contact"}},
                                  {{"f.off", "g.off"}, {"clearance"}},
                                  {{"a.off", "g.off"}, {}}};
  for (const Scene& scene : scenes) {
    const auto code = [&](std::vector<std::string> more) {
      return impinge(folder, joined(joined({"clash", "--quiet", "--clearance", "4"}, scene.files), more)).code;
    };
    const std::string which = scene.files[0] + " " + scene.files[1];
    for (const char* word : {"contact", "penetration", "inside", "clearance"})
      EXPECT_EQ(code({"--fail-on", word}), scene.words.contains(word) ? 1 : 0) << which << " " << word;
    const bool by_default = scene.words.contains("penetration") || scene.words.contains("inside");
    EXPECT_EQ(code({}), by_default ? 1 : 0) << which;
    EXPECT_EQ(code({"--fail-on", "penetration,inside"}), by_default ? 1 : 0) << which;
    EXPECT_EQ(code({"--fail-on", "clearance,contact"}), scene.words.empty() ? 0 : 1) << which;
    EXPECT_EQ(code({"--fail-on", "clearance", "--fail-on", "contact"}), scene.words.empty() ? 0 : 1) << which;
  }
}

TEST_F(Clash, MarksWhatFailsIfTheVerdictsAloneDoNotTell) {
  EXPECT_EQ(first_block(clash({"--fail-on", "inside", "--depth", "none"}).out),
            "verdict      part   part   fails\n"
            "duplicate    d      d2     -\n"
            "inside       small  big    yes\n"
            "penetrating  a      b      -\n"
            "crossing     e      sheet  -\n"
            "touching     b      c      -\n");
  for (const char* words : {"contact", "clearance,contact", "penetration,inside"})
    EXPECT_EQ(clash({"--fail-on", words, "--clearance", "0.001"}).out.find("fails"), std::string::npos) << words;
}

TEST_F(Clash, SaysThatNothingTouchesOrIsNear) {
  const Ended far = impinge(folder, {"clash", "a.off", "g.off"});
  EXPECT_EQ(far.code, 0);
  EXPECT_EQ(far.out.substr(0, far.out.rfind("24 triangles")),
            "2 parts, 2 solids, 0 cracked solids, 0 surfaces; nothing touches; tolerance auto.\n"
            "No pair fails (penetration, inside).\n");
  const Ended clear = impinge(folder, {"clash", "a.off", "g.off", "--clearance", "0.5"});
  EXPECT_NE(clear.out.find("; nothing is nearer than 0.5; "), std::string::npos) << clear.out;
  const Ended one = impinge(folder, {"clash", "a.off"});
  EXPECT_EQ(one.code, 0);
  EXPECT_NE(one.out.find("There is only one part"), std::string::npos);
}

TEST_F(Clash, IgnoredPairsAndGroupsAreLeftOut) {
  EXPECT_EQ(impinge(folder, {"clash", "a.off", "b.off", "c.off", "--ignore", "a", "b"}).code, 0);
  const Ended group = impinge(folder, {"clash", "d.off", "d2.off", "a.off", "b.off", "--ignore", "d*", "d*"});
  EXPECT_EQ(group.code, 1);
  EXPECT_NE(group.out.find("penetrating  a"), std::string::npos) << group.out;
  EXPECT_EQ(group.out.find("duplicate"), std::string::npos) << group.out;
}

/// Two blocks of 2000 and less that overlap by 1 or are 1 apart.
class Tolerance : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("block.off", off(box({0, 0, 0}, {2000, 2000, 2000})));
    folder.write("in.off", off(box({1999, 500, 500}, {3999, 1500, 1500})));
    folder.write("off.off", off(box({2001, 500, 500}, {4001, 1500, 1500})));
  }
  [[nodiscard]] Ended clash(const std::string& a, const std::string& b, const std::string& tolerance) const {
    return impinge(folder, {"clash", a, b, "--tolerance", tolerance, "--fail-on", "penetration"});
  }
  Folder folder;
};

TEST_F(Tolerance, ExcusesWhatOverlapsByNoMore) {
  const Ended excused = clash("block.off", "in.off", "2");
  EXPECT_EQ(excused.code, 0);
  const Ended document = impinge(folder, {"clash", "block.off", "in.off", "--tolerance", "2", "--json", "-"});
  const json pair = json::parse(document.out).at("pairs").at(0);
  EXPECT_EQ(pair.at("verdict"), "touching");
  EXPECT_EQ(pair.at("tolerance"), 2.0);
  EXPECT_EQ(pair.at("note"), sentence(Note::overlap_within_tolerance));
  EXPECT_EQ(first_block(excused.out),
            "verdict   part   part  depth  note\n"
            "touching  block  in        1  overlap within tolerance\n");
  for (const char* tolerance : {"0", "0.9", "auto"}) {
    const Ended run = clash("block.off", "in.off", tolerance);
    EXPECT_EQ(run.code, 1) << tolerance;
    EXPECT_EQ(first_block(run.out),
              "verdict      part   part  depth\n"
              "penetrating  block  in        1\n")
        << tolerance;
  }
}

TEST_F(Tolerance, TakesASmallGapForContact) {
  EXPECT_EQ(first_block(clash("block.off", "off.off", "2").out),
            "verdict   part   part  note\n"
            "touching  block  off   gap within tolerance\n");
  EXPECT_NE(clash("block.off", "off.off", "0").out.find("nothing touches"), std::string::npos);
}

TEST_F(Tolerance, IsNamedWhereItLeavesOutWhatIsShallow) {
  std::vector<std::string> words{"clash", "block.off", "deep.off"};
  folder.write("deep.off", off(box({1900, 500, 500}, {3900, 1500, 1500})));
  for (int i = 0; i < 6; ++i) {
    words.push_back("pin" + std::to_string(i) + ".off");
    folder.write(words.back(), off(box({100 * i, 0, 1999}, {100 * i + 50, 50, 2099})));
  }
  const std::string line = "6 of 7 failing pairs are shallower than 1.1; --tolerance 1.1 leaves 1.\n";
  const Ended run = impinge(folder, words);
  EXPECT_NE(run.out.find("\n7 pairs fail (penetration, inside).\n" + line), std::string::npos) << run.out;
  EXPECT_NE(impinge(folder, joined(words, {"--tolerance", "1.1"})).out.find("\n1 pair fails ("), std::string::npos);
  // Of what touches a tolerance excuses nothing.
  EXPECT_EQ(impinge(folder, joined(words, {"--fail-on", "contact"})).out.find("shallower"), std::string::npos);
}

}  // namespace
}  // namespace impinge::test
