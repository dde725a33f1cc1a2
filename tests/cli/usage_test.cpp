// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Wrong command lines: always exit code 2, one sentence, nothing on standard output.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "impinge/version.hpp"
#include "meshes.hpp"
#include "program.hpp"
#include "report/text.hpp"

namespace impinge::test {
namespace {

struct Wrong {
  std::vector<std::string> words;
  std::string part;  ///< of the sentence
};

class WrongUsage : public testing::TestWithParam<Wrong> {};

TEST_P(WrongUsage, IsOneSentence) {
  const Folder folder;
  folder.write("a.off", off(cube(0, 0, 0)));
  const Ended run = impinge(folder, GetParam().words);
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err.rfind("impinge: ", 0), 0U) << run.err;
  EXPECT_NE(run.err.find(GetParam().part), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

INSTANTIATE_TEST_SUITE_P(
    Usage, WrongUsage,
    testing::Values(Wrong{{}, "subcommand is required"}, Wrong{{"a.off"}, "'a.off' is no command of impinge"},
                    Wrong{{"check"}, "FILE is required; see impinge check --help"}, Wrong{{"info"}, "FILE is required"},
                    Wrong{{"--frobnicate"}, "--frobnicate"}, Wrong{{"check", "a.off", "-x"}, "-x"},
                    Wrong{{"check", "a.off", "--limit", "-1"}, "'-1'"},
                    Wrong{{"check", "a.off", "--limit", "1e3"}, "'1e3'"},
                    Wrong{{"check", "a.off", "--limit", "18446744073709551616"}, "--limit"},
                    Wrong{{"check", "a.off", "--limit"}, "--limit: 1 required N missing"},
                    Wrong{{"check", "a.off", "--limit", "1", "--limit", "2"}, "--limit: At Most 1 required"},
                    Wrong{{"check", "a.off", "--limit="}, "'--limit=' is empty"},
                    Wrong{{"check", "a.off", "--threads", "1025"}, "0 to 1024"},
                    Wrong{{"check", "a.off", "--threads", "two"}, "'two'"},
                    Wrong{{"check", "a.off", "--backend", "hybrid", "--device-share", "2"}, "'2'"},
                    Wrong{{"check", "a.off", "--device-share", "0.5"}, "for --backend hybrid"},
                    Wrong{{"devices", "--jsn"}, "'--jsn'"}, Wrong{{"devices", "a.off"}, "'a.off'"},
                    Wrong{{"check", "a.off", "--backend", "cuda"},
                          "cuda not in {auto,simd,paper,scalar,gpu,raster,hybrid}"},
                    Wrong{{"check", "a.off", "--triangles"}, "--triangles requires --json"},
                    Wrong{{"check", "a.off", "--first=maybe"}, "--first"},
                    Wrong{{"check", "a.off", "--ignore", "a"}, "--ignore: 2 required A B missing"},
                    Wrong{{"check", "a.off", "--scale", "b.off=2"}, "none of the files"},
                    Wrong{{"check", "a.off", "--scale", "a.off"}, "FILE=S"},
                    Wrong{{"check", "a.off", "--scale", "a.off="}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=0"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=inf"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=nan"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=1,5"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=2", "--scale", "a.off=3"}, "twice"},
                    Wrong{{"check", "a.off", "--max-file", "2X"}, "--max-file: x unit not recognized"},
                    Wrong{{"info", "a.off", "--max-file", "-1"}, "--max-file: Value -1"},
                    Wrong{{"info", "a.off", "--max-file", "1.5G"}, "--max-file: Value 1.5"},
                    Wrong{{"info", "a.off", "--max-file", "18446745T"}, "overflow"}));

INSTANTIATE_TEST_SUITE_P(
    Clash, WrongUsage,
    testing::Values(Wrong{{"clash", "a.off", "--stats"}, "see impinge clash --help"},
                    Wrong{{"clash", "a.off", "--tolerance", "-1"},
                          "--tolerance takes auto or a length from 0 up, such as 10 or 10mm, not '-1'"},
                    Wrong{{"clash", "a.off", "--tolerance", "nan"}, "--tolerance takes auto"},
                    Wrong{{"clash", "a.off", "--tolerance", "inf"}, "'inf'"},
                    Wrong{{"clash", "a.off", "--tolerance", "1 mile"}, "'1 mile'; the units are m, cm, mm, in and ft"},
                    Wrong{{"clash", "a.off", "--tolerance", "0,5"}, "'0,5'"},
                    Wrong{{"clash", "a.off", "--tolerance", "Auto"}, "'Auto'"},
                    Wrong{{"clash", "a.off", "--tolerance"}, "--tolerance: 1 required auto|0|D missing"},
                    Wrong{{"clash", "a.off", "--tolerance", "0", "--tolerance", "1"}, "--tolerance: At Most 1"},
                    Wrong{{"clash", "a.off", "--clearance", "-1"}, "--clearance takes a length from 0 up"},
                    Wrong{{"clash", "a.off", "--clearance", "auto"}, "'auto'"},
                    Wrong{{"clash", "a.off", "--fail-on", "penetrating"},
                          "--fail-on: penetrating not in {contact,penetration,inside,clearance,new}"},
                    Wrong{{"clash", "a.off", "--fail-on", "new"}, "add --previous FILE"},
                    Wrong{{"clash", "a.off", "--group-by", "colour"}, "part|type|test|none, not 'colour'"},
                    Wrong{{"clash", "a.off", "--group-by", "test"}, "--config FILE"},
                    Wrong{{"clash"}, "no file to read is named"},
                    Wrong{{"clash", "a.off", "--fail-on", "inside, contact"}, " contact not in {"},
                    Wrong{{"clash", "a.off", "--fail-on", ""}, "'--fail-on' is empty"},
                    Wrong{{"clash", "a.off", "--fail-on"}, "--fail-on: 1 required LIST missing"},
                    Wrong{{"clash", "a.off", "--fail-on", "clearance"}, "add --clearance C"},
                    Wrong{{"clash", "a.off", "--fail-on", "clearance", "--clearance", "0"}, "add --clearance C"},
                    Wrong{{"clash", "a.off", "--depth=maybe"}, "none or a share"},
                    Wrong{{"clash", "a.off", "--depth", "0"}, "none or a share"},
                    Wrong{{"clash", "a.off", "--depth", "1.5"}, "none or a share"},
                    Wrong{{"clash", "a.off", "--ignore", "a", "b"}, "nothing is named 'b'"},
                    Wrong{{"clash", "a.off", "--json", "a.off"}, "one of the files to read"}));

TEST(Usage, VersionAndHelpEndWell) {
  const Folder folder;
  const Ended version = impinge(folder, {"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out, "impinge " IMPINGE_VERSION "\n");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--help"},
                                                {"-h"},
                                                {"check", "--help"},
                                                {"clash", "--help"},
                                                {"info", "--help"},
                                                {"check", "-h", "x"}})
    EXPECT_EQ(impinge(folder, words).code, 0);
}

TEST(Usage, WordsAfterTheMarkAreFiles) {
  const Folder folder;
  folder.write("--quiet.off", off(cube(0, 0, 0)));
  const Ended run = impinge(folder, {"check", "--", "--quiet.off"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out, "");
}

// The help pages: their examples run as they stand, and their lines fit.

const std::vector<std::vector<std::string>> kPages = {{"--help"},           {"check", "--help"},   {"clash", "--help"},
                                                      {"motion", "--help"}, {"impacts", "--help"}, {"view", "--help"},
                                                      {"info", "--help"},   {"devices", "--help"}};

/// The lines that begin with the program's name between "Examples:" and the next empty line.
std::vector<std::string> examples_of(const std::string& page) {
  std::vector<std::string> examples;
  std::istringstream lines(page.substr(std::min(page.find("Examples:\n"), page.size())));
  for (std::string line; std::getline(lines, line) && !line.empty();)
    if (line.starts_with("  impinge ")) examples.push_back(line.substr(2));
  return examples;
}

TEST(Help, ExamplesRun) {
  const Folder folder;
  folder.write("engine.obj", obj(cube(0, 0, 0)));
  folder.write("fixture.stl", stl(cube(2, 0, 0)));
  folder.write("robot.ply", ply(cube(0, 0, 0)));
  folder.write("cell.off", off(cube(9, 0, 0)));
  folder.write("bracket.stl", stl(cube(40, 0, 0)));
  folder.write("plate.stl", stl(cube(0, 0, 0)));
  folder.write("clash.json", R"({"files":["engine.obj","fixture.stl"],"tests":[{"name":"all","a":"*"}]})");
  for (const char* state : {"before", "after", "frame_0001", "frame_0002"})
    folder.write(state + std::string(".ply"), ply(cube(0, 0, 0)));
  for (const char* state : {"step0.obj", "step1.obj"})
    folder.write(state, "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no b\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf 4 5 6\n");
  impinge(folder, {"clash", "--config", "clash.json", "--json", "last.json"});
  folder.write("page.html", kPageHead + "<!-- impinge: data -->");
  const std::string page_program = "IMPINGE_PAGE=" + (folder.path() / "page.html").string() + " ";
  std::size_t count = 0;
  for (const auto& page : kPages) {
    const Ended help = impinge(folder, page);
    EXPECT_EQ(help.code, 0);
    for (const std::string& line : examples_of(help.out)) {
      if (line.starts_with("impinge motion")) continue;  // its tests run such lines
      const Ended run = shell(folder, page_program + line);
      EXPECT_TRUE(run.code == 0 || run.code == 1) << line << "\n" << run.err;
      EXPECT_EQ(run.err, "") << line;
      ++count;
    }
  }
  EXPECT_EQ(count, 24U);
  EXPECT_EQ(shell(folder, "impinge check robot.ply cell.off --first --quiet && echo free").out, "free\n");
}

TEST(Help, LinesFitEightyColumns) {
  const Folder folder;
  for (const auto& page : kPages) {
    std::istringstream lines(impinge(folder, page).out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(report::columns(line), 80U) << line;
  }
}

TEST(Help, ExplainsEveryOptionAndCommand) {
  const Folder folder;
  const std::string program = impinge(folder, {"--help"}).out;
  for (const char* command : {"check", "clash", "motion", "impacts", "view", "info", "devices"}) {
    EXPECT_NE(program.find("\n  " + std::string(command) + " "), std::string::npos) << command;
    // Every option of the page has a line of its own that begins with it, or ends there and is explained below.
    std::istringstream lines(impinge(folder, {command, "--help"}).out);
    std::size_t options = 0;
    for (std::string line; !line.starts_with("  -h") && std::getline(lines, line);) {
      if (!line.starts_with("  -")) continue;
      ++options;
      const bool is_beside = line.size() > 25 && line[24] == ' ' && line[25] != ' ';
      EXPECT_TRUE(is_beside || (std::getline(lines, line) && line.starts_with(std::string(25, ' ')))) << line;
    }
    EXPECT_GT(options, 0U) << command;
  }
  const std::string clash = impinge(folder, {"clash", "--help"}).out;
  for (const char* option : {"--tolerance auto|0|D", "--json FILE|-", "--ignore A B", "--scale FILE=S", "--limit N",
                             "--up y|z", "--unit m|cm|mm|in|ft", "--group-by part|type|test|none", "-h,--help"})
    EXPECT_NE(clash.find("\n  " + std::string(option)), std::string::npos) << option;
}

}  // namespace
}  // namespace impinge::test
