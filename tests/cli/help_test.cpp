// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// The help pages: their examples run as they stand, and their lines fit.
#include <gtest/gtest.h>

#include <sstream>

#include "meshes.hpp"
#include "program.hpp"
#include "report/text.hpp"

namespace impinge::test {
namespace {

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
