// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What `impinge clash` prints and ends with, on boxes whose verdicts follow from their corners.
#include "impinge/clash.hpp"

#include <map>
#include <set>
#include <sstream>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

/// One pair of each verdict, far from the others; the parts of each lie in the order of their names.
class Clash : public testing::Test {
 protected:
  void SetUp() override {
    write_off(folder, {{"a", box({0, 0, 0}, {2, 2, 2})},
                       {"b", box({1, 1, 1}, {3, 3, 3})},  // penetrating, 1 deep
                       {"c", box({3, 1, 1}, {5, 3, 3})},  // touches b
                       {"big", box({20, 0, 0}, {26, 6, 6})},
                       {"small", box({22, 2, 2}, {24, 4, 4})},  // inside
                       {"d", box({40, 0, 0}, {42, 2, 2})},
                       {"d2", box({40, 0, 0}, {42, 2, 2})},  // duplicate
                       {"e", box({60, 0, 0}, {62, 2, 2})},
                       {"sheet", sheet({59, -1}, {63, 3}, 1)},  // crossing
                       {"f", box({80, 0, 0}, {82, 2, 2})},
                       {"g", box({85, 4, 0}, {87, 6, 2})}});  // apart: 3, 2, 0
  }
  [[nodiscard]] Ended clash(const Words& more) const {
    return impinge(folder, joined({"clash", "a.off", "b.off", "c.off", "big.off", "small.off", "d.off", "d2.off",
                                   "e.off", "sheet.off", "f.off", "g.off"},
                                  more));
  }
  Folder folder;
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
  EXPECT_THAT(run.out, HasSubstr("\n\nsheet is a surface: 4 open edges, first at ("));
  EXPECT_THAT(
      run.out,
      HasSubstr(
          "\n\n11 parts, 10 solids, 0 cracked solids, 1 surface; 1 duplicate, 1 inside, 1 penetrating, 1 crossing, "
          "1 touching; tolerance 0.001.\n"
          "4 pairs fail (penetration, inside).\n"
          "122 triangles; read in "));
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
  EXPECT_THAT(run.out, HasSubstr("1 touching, 2 nearer than 3.61; no tolerance.\n"));
  EXPECT_THAT(clash({"--clearance", "3.6"}).out, Not(HasSubstr("apart        f")));
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
  EXPECT_THAT(first_block(clash({"--depth", "none"}).out), Not(HasSubstr("depth")));
}

TEST_F(Clash, VolumesAreMissingForAReason) {
  const Ended run = clash({"--volume"});
  const std::string reason =
      "\n1 pair without a volume, though they overlap: one of the parts is not solid in all its pieces.\n";
  EXPECT_THAT(run.out, HasSubstr(reason));  // of the sheet
  EXPECT_THAT(clash({}).out, Not(HasSubstr("without a volume")));
  EXPECT_THAT(impinge(folder, {"clash", "a.off", "b.off", "--volume"}).out, Not(HasSubstr("without a volume")));
}

/// The post's middle line in the plate is 1 away from the post's faces and from the plate's.
TEST_F(Clash, ADepthThatIsWideIsToldFromTheLeastToTheMost) {
  write_off(folder, {{"plate", box({-5, -5, 0}, {5, 5, 2})}, {"post", box({-1, -1, -5}, {1, 1, 5})}});
  const auto told = [&](const std::string& tolerance) {
    const Ended run = impinge(folder, {"clash", "plate.off", "post.off", "--tolerance", tolerance});
    const std::string row = run.out.substr(0, run.out.find("\n\n"));
    return row.substr(row.find_last_of(' ') + 1);
  };
  EXPECT_NEAR(std::stod(told("0.5")), 1, 0.05);
  EXPECT_THAT(told("0.5"), Not(HasSubstr("..")));
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
  EXPECT_THAT(clash({"--limit", "0"}).out, StartsWith("(0 of 5 "));
  EXPECT_THAT(clash({"--limit", "5"}).out, Not(HasSubstr("by --limit")));
}

TEST_F(Clash, ExitCodeIsWhatFailOnNames) {
  struct Scene {
    Words files;
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
    const auto code = [&](Words more) {
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
    EXPECT_THAT(clash({"--fail-on", words, "--clearance", "0.001"}).out, Not(HasSubstr("fails"))) << words;
}

TEST_F(Clash, SaysThatNothingTouchesOrIsNear) {
  const Ended far = impinge(folder, {"clash", "a.off", "g.off"});
  EXPECT_EQ(far.code, 0);
  EXPECT_THAT(far.out, StartsWith("2 parts, 2 solids, 0 cracked solids, 0 surfaces; nothing touches; tolerance auto.\n"
                                  "No pair fails (penetration, inside).\n24 triangles"));
  EXPECT_THAT(impinge(folder, {"clash", "a.off", "g.off", "--clearance", "0.5"}).out,
              HasSubstr("; nothing is nearer than 0.5; "));
  const Ended one = impinge(folder, {"clash", "a.off"});
  EXPECT_EQ(one.code, 0);
  EXPECT_THAT(one.out, HasSubstr("There is only one part"));
}

TEST_F(Clash, IgnoredPairsAndGroupsAreLeftOut) {
  EXPECT_EQ(impinge(folder, {"clash", "a.off", "b.off", "c.off", "--ignore", "a", "b"}).code, 0);
  const Ended group = impinge(folder, {"clash", "d.off", "d2.off", "a.off", "b.off", "--ignore", "d*", "d*"});
  EXPECT_EQ(group.code, 1);
  EXPECT_THAT(group.out, HasSubstr("penetrating  a"));
  EXPECT_THAT(group.out, Not(HasSubstr("duplicate")));
}

/// Two blocks of 2000 and less that overlap by 1 or are 1 apart.
class Tolerance : public testing::Test {
 protected:
  void SetUp() override {
    write_off(folder, {{"block", box({0, 0, 0}, {2000, 2000, 2000})},
                       {"in", box({1999, 500, 500}, {3999, 1500, 1500})},
                       {"off", box({2001, 500, 500}, {4001, 1500, 1500})}});
  }
  [[nodiscard]] Ended clash(const std::string& a, const std::string& b, const std::string& tolerance) const {
    return impinge(folder, {"clash", a, b, "--tolerance", tolerance, "--fail-on", "penetration"});
  }
  Folder folder;
};

TEST_F(Tolerance, ExcusesWhatOverlapsByNoMore) {
  const Ended excused = clash("block.off", "in.off", "2");
  EXPECT_EQ(excused.code, 0);
  const json pair = document(folder, {"clash", "block.off", "in.off", "--tolerance", "2"}, 0).at("pairs").at(0);
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
  EXPECT_THAT(clash("block.off", "off.off", "0").out, HasSubstr("nothing touches"));
}

TEST_F(Tolerance, IsNamedWhereItLeavesOutWhatIsShallow) {
  Words words{"clash", "block.off", "deep.off"};
  folder.write("deep.off", off(box({1900, 500, 500}, {3900, 1500, 1500})));
  for (int i = 0; i < 6; ++i) {
    words.push_back("pin" + std::to_string(i) + ".off");
    folder.write(words.back(), off(box({100 * i, 0, 1999}, {100 * i + 50, 50, 2099})));
  }
  const std::string line = "6 of 7 failing pairs are shallower than 1.1; --tolerance 1.1 leaves 1.\n";
  EXPECT_THAT(impinge(folder, words).out, HasSubstr("\n7 pairs fail (penetration, inside).\n" + line));
  EXPECT_THAT(impinge(folder, joined(words, {"--tolerance", "1.1"})).out, HasSubstr("\n1 pair fails ("));
  // Of what touches a tolerance excuses nothing.
  EXPECT_THAT(impinge(folder, joined(words, {"--fail-on", "contact"})).out, Not(HasSubstr("shallower")));
}

}  // namespace
}  // namespace impinge::test
