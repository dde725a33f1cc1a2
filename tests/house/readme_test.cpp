// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "impinge/version.hpp"

namespace {

const std::filesystem::path kSource = IMPINGE_SOURCE_DIR;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  EXPECT_TRUE(stream) << file;
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The README's blocks in a language, without the fences.
std::vector<std::string> blocks(const std::string& text, const std::string& language) {
  std::vector<std::string> found;
  const std::string fence = "```" + language + "\n";
  for (std::size_t at = text.find(fence); at != std::string::npos; at = text.find(fence, at)) {
    at += fence.size();
    const std::size_t end = text.find("```", at);
    if (end == std::string::npos) break;
    found.push_back(text.substr(at, end - at));
    at = end;
  }
  return found;
}

TEST(Readme, ShowsTheExampleThatIsCompiledAndRun) {
  std::string example = text_of(kSource / "examples/two_cubes.cpp");
  const std::size_t first_include = example.find("#include");
  ASSERT_NE(first_include, std::string::npos);
  example.erase(0, first_include);  // the licence lines
  const auto shown = blocks(text_of(kSource / "README.md"), "cpp");
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_EQ(shown[0], example);
}

TEST(Readme, LinksLeadSomewhere) {
  for (const auto* page : {"README.md", "docs/README.md", "docs/contract.md", "CHANGELOG.md"}) {
    const std::string text = text_of(kSource / page);
    const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
      const auto target = (kSource / page).parent_path() / (*it)[1].str();
      EXPECT_TRUE(std::filesystem::exists(target)) << page << " leads to " << (*it)[1];
    }
  }
}

TEST(Version, IsTheSameInTheHeaderTheBuildAndTheChangelog) {
  const std::string version = IMPINGE_VERSION;
  EXPECT_EQ(version, std::to_string(IMPINGE_VERSION_MAJOR) + '.' + std::to_string(IMPINGE_VERSION_MINOR) + '.' +
                         std::to_string(IMPINGE_VERSION_PATCH));
  EXPECT_NE(text_of(kSource / "CMakeLists.txt").find("project(impinge VERSION " + version + ' '), std::string::npos);
  EXPECT_NE(text_of(kSource / "CHANGELOG.md").find("## [" + version + "]"), std::string::npos);
}

}  // namespace
