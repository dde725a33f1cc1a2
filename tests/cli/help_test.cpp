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

const std::vector<std::vector<std::string>> kPages = {{"--help"},         {"check", "--help"}, {"clash", "--help"},
                                                      {"view", "--help"}, {"info", "--help"},  {"devices", "--help"}};

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
  folder.write("bracket.stl", stl(cube(0, 0, 0)));
  folder.write("plate.stl", stl(cube(0, 0, 0)));
  folder.write("clash.json", R"({"files":["engine.obj","fixture.stl"],"tests":[{"name":"all","a":"*"}]})");
  impinge(folder, {"clash", "--config", "clash.json", "--json", "last.json"});
  folder.write("page.html", kPageHead + "<!-- impinge: data -->");
  const std::string page_program = "IMPINGE_PAGE=" + (folder.path() / "page.html").string() + " ";
  std::size_t count = 0;
  for (const auto& page : kPages) {
    const Ended help = impinge(folder, page);
    EXPECT_EQ(help.code, 0);
    for (const std::string& line : examples_of(help.out)) {
      const Ended run = shell(folder, page_program + line);
      EXPECT_TRUE(run.code == 0 || run.code == 1) << line << "\n" << run.err;
      EXPECT_EQ(run.err, "") << line;
      ++count;
    }
  }
  EXPECT_EQ(count, 19U);
  EXPECT_EQ(shell(folder, "impinge check robot.ply cell.off --first --quiet && echo free").out, "free\n");
}

TEST(Help, LinesFitTheTerminal) {
  const Folder folder;
  for (const std::size_t width : {40U, 60U, 80U, 200U}) {
    Launch launch;
    launch.environment["COLUMNS"] = std::to_string(width);
    for (const auto& page : kPages) {
      std::istringstream lines(impinge(folder, page, launch).out);
      // Examples and usage stay whole, so that they can be copied.
      for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("  impinge ")) {
          EXPECT_LE(report::columns(line), width) << line;
        }
      }
    }
  }
}

TEST(Help, ListsEveryOption) {
  const Folder folder;
  const std::string page = impinge(folder, {"check", "--help"}).out;
  for (const char* option : {"--json FILE|-", "--triangles", "--first", "--limit N", "--threads N", "--backend NAME",
                             "--ignore A B", "--scale FILE=S", "--max-file BYTES", "--quiet", "--stats", "--help"})
    EXPECT_NE(page.find("  " + std::string(option) + " "), std::string::npos) << option;
  const std::string clash = impinge(folder, {"clash", "--help"}).out;
  for (const char* option : {"--tolerance auto|0|D",
                             "--clearance C",
                             "--depth",
                             "--regions",
                             "--fail-on LIST",
                             "--json FILE|-",
                             "--html FILE",
                             "--page-triangles N",
                             "--csv FILE|-",
                             "--bcf FILE",
                             "--gltf FILE",
                             "--unit UNIT",
                             "--up y|z",
                             "--date DATE",
                             "--bcf-topics N",
                             "--limit N",
                             "--config FILE",
                             "--previous FILE",
                             "--group-by WHAT",
                             "--ignore A B",
                             "--within-products",
                             "--scale FILE=S",
                             "--threads N",
                             "--max-file BYTES",
                             "--quiet",
                             "--help"})
    EXPECT_NE(clash.find("  " + std::string(option) + " "), std::string::npos) << option;
  for (const char* command : {"view", "motion"})
    EXPECT_NE(impinge(folder, {command, "--help"}).out.find("  --up y|z "), std::string::npos) << command;
}

}  // namespace
}  // namespace impinge::test
