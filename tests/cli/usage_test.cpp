// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Wrong command lines: always exit code 2, one sentence, nothing on standard output.
#include <algorithm>
#include <sstream>

#include "impinge/version.hpp"
#include "meshes.hpp"
#include "program.hpp"
#include "report/text.hpp"

namespace impinge::test {
namespace {

TEST(Usage, WrongCommandLinesAreOneSentence) {
  const Folder folder;
  folder.write("a.off", off(cube(0, 0, 0)));
  const std::vector<std::pair<Words, std::string>> wrong{
      {{}, "subcommand is required"},
      {{"a.off"}, "'a.off' is no command of impinge"},
      {{"check"}, "FILE is required; see impinge check --help"},
      {{"info"}, "FILE is required"},
      {{"--frobnicate"}, "--frobnicate"},
      {{"check", "a.off", "-x"}, "-x"},
      {{"check", "a.off", "--limit", "-1"}, "'-1'"},
      {{"check", "a.off", "--limit", "1e3"}, "'1e3'"},
      {{"check", "a.off", "--limit", "18446744073709551616"}, "--limit"},
      {{"check", "a.off", "--limit"}, "--limit: 1 required N missing"},
      {{"check", "a.off", "--limit", "1", "--limit", "2"}, "--limit: At Most 1 required"},
      {{"check", "a.off", "--limit="}, "'--limit=' is empty"},
      {{"check", "a.off", "--threads", "1025"}, "0 to 1024"},
      {{"check", "a.off", "--threads", "two"}, "'two'"},
      {{"check", "a.off", "--backend", "hybrid", "--device-share", "2"}, "'2'"},
      {{"check", "a.off", "--device-share", "0.5"}, "for --backend hybrid"},
      {{"devices", "--jsn"}, "'--jsn'"},
      {{"devices", "a.off"}, "'a.off'"},
      {{"check", "a.off", "--backend", "cuda"}, "cuda not in {auto,simd,paper,scalar,gpu,raster,hybrid}"},
      {{"check", "a.off", "--triangles"}, "--triangles requires --json"},
      {{"check", "a.off", "--first=maybe"}, "--first"},
      {{"check", "a.off", "--ignore", "a"}, "--ignore: 2 required A B missing"},
      {{"check", "a.off", "--scale", "b.off=2"}, "none of the files"},
      {{"check", "a.off", "--scale", "a.off"}, "FILE=S"},
      {{"check", "a.off", "--scale", "a.off="}, "positive"},
      {{"check", "a.off", "--scale", "a.off=0"}, "positive"},
      {{"check", "a.off", "--scale", "a.off=inf"}, "positive"},
      {{"check", "a.off", "--scale", "a.off=nan"}, "positive"},
      {{"check", "a.off", "--scale", "a.off=1,5"}, "positive"},
      {{"check", "a.off", "--scale", "a.off=2", "--scale", "a.off=3"}, "twice"},
      {{"check", "a.off", "--max-file", "2X"}, "--max-file: x unit not recognized"},
      {{"info", "a.off", "--max-file", "-1"}, "--max-file: Value -1"},
      {{"info", "a.off", "--max-file", "1.5G"}, "--max-file: Value 1.5"},
      {{"info", "a.off", "--max-file", "18446745T"}, "overflow"},
      {{"clash", "a.off", "--stats"}, "see impinge clash --help"},
      {{"clash", "a.off", "--tolerance", "-1"},
       "--tolerance takes auto or a length from 0 up, such as 10 or 10mm, not '-1'"},
      {{"clash", "a.off", "--tolerance", "nan"}, "--tolerance takes auto"},
      {{"clash", "a.off", "--tolerance", "inf"}, "'inf'"},
      {{"clash", "a.off", "--tolerance", "1 mile"}, "'1 mile'; the units are m, cm, mm, in and ft"},
      {{"clash", "a.off", "--tolerance", "0,5"}, "'0,5'"},
      {{"clash", "a.off", "--tolerance", "Auto"}, "'Auto'"},
      {{"clash", "a.off", "--tolerance"}, "--tolerance: 1 required auto|0|D missing"},
      {{"clash", "a.off", "--tolerance", "0", "--tolerance", "1"}, "--tolerance: At Most 1"},
      {{"clash", "a.off", "--clearance", "-1"}, "--clearance takes a length from 0 up"},
      {{"clash", "a.off", "--clearance", "auto"}, "'auto'"},
      {{"clash", "a.off", "--fail-on", "penetrating"},
       "--fail-on: penetrating not in {contact,penetration,inside,clearance,new}"},
      {{"clash", "a.off", "--fail-on", "new"},
       ": --fail-on new needs an earlier run to compare with: add --previous FILE, with its JSON; see impinge clash "
       "--help\n"},
      {{"clash", "a.off", "--group-by", "colour"}, "part|type|test|none, not 'colour'"},
      {{"clash", "a.off", "--group-by", "test"}, "--config FILE"},
      {{"clash"}, ": no file to read is named; see impinge clash --help\n"},
      {{"clash", "a.off", "--fail-on", "inside, contact"}, " contact not in {"},
      {{"clash", "a.off", "--fail-on", ""}, "'--fail-on' is empty"},
      {{"clash", "a.off", "--fail-on"}, "--fail-on: 1 required LIST missing"},
      {{"clash", "a.off", "--fail-on", "clearance"}, "add --clearance C"},
      {{"clash", "a.off", "--fail-on", "clearance", "--clearance", "0"}, "add --clearance C"},
      {{"clash", "a.off", "--depth=maybe"}, "none or a share"},
      {{"clash", "a.off", "--depth", "0"}, "none or a share"},
      {{"clash", "a.off", "--depth", "1.5"}, "none or a share"},
      {{"clash", "a.off", "--ignore", "a", "b"}, "nothing is named 'b'"},
      {{"clash", "a.off", "--json", "a.off"}, "one of the files to read"},
  };
  for (const auto& [words, part] : wrong) {
    SCOPED_TRACE(testing::PrintToString(words));
    EXPECT_THAT(refusal(folder, words), HasSubstr(part));
  }
}

TEST(Usage, VersionAndHelpEndWell) {
  const Folder folder;
  const Ended version = impinge(folder, {"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out, "impinge " IMPINGE_VERSION "\n");
  for (const Words& words :
       {Words{"--help"}, {"-h"}, {"check", "--help"}, {"clash", "--help"}, {"info", "--help"}, {"check", "-h", "x"}})
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

const std::vector<Words> kPages = {{"--help"},           {"check", "--help"},   {"clash", "--help"},
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
    EXPECT_THAT(program, HasSubstr("\n  " + std::string(command) + " ")) << command;
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
    EXPECT_THAT(clash, HasSubstr("\n  " + std::string(option))) << option;
}

}  // namespace
}  // namespace impinge::test
