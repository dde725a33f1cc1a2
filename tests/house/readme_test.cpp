// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
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

/// What links into a page can lead to: what has an id, and its headings, whose anchors are in lower case with hyphens
/// for blanks and no other punctuation.
std::set<std::string> anchors_of(const std::string& text) {
  std::set<std::string> anchors;
  const std::regex id(R"re(<a id="([^"]*)">)re");
  for (std::sregex_iterator it(text.begin(), text.end(), id), end; it != end; ++it) anchors.insert((*it)[1]);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t level = line.find_first_not_of('#');
    if (level == 0 || level == std::string::npos || line[level] != ' ') continue;
    std::string anchor;
    for (const char c : line.substr(level + 1)) {
      if (c == ' ') anchor += '-';
      if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    anchors.insert(anchor);
  }
  return anchors;
}

TEST(Readme, LinksLeadSomewhere) {
  std::vector<std::filesystem::path> pages{"README.md", "CHANGELOG.md", "CONTRIBUTING.md", "src/README.md"};
  for (const auto& entry : std::filesystem::directory_iterator(kSource / "docs"))
    if (entry.path().extension() == ".md") pages.push_back("docs" / entry.path().filename());
  EXPECT_GT(pages.size(), 14U);
  const std::regex link(R"(\]\(([^)#:]*)(?:#([^)]*))?\))");
  int sections = 0;
  for (const auto& page : pages) {
    const std::string text = text_of(kSource / page);
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
      const bool is_here = (*it)[1].length() == 0;
      const auto target = kSource / (is_here ? page : page.parent_path() / (*it)[1].str());
      EXPECT_TRUE(std::filesystem::exists(target)) << page << " leads to " << (*it)[1];
      if (!(*it)[2].matched || target.extension() != ".md") continue;
      ++sections;
      EXPECT_TRUE(anchors_of(text_of(target)).contains((*it)[2])) << page << " leads to " << (*it)[0];
    }
  }
  EXPECT_GT(sections, 5);  // the reader of headings works
}

/// The numbers of the contract's clauses that a text cites, as in "contract 3.2", "contract 1.1 and 2.3", "contract 3".
std::vector<std::string> citations(const std::string& text) {
  static const std::regex citation(R"(\b[Cc]ontract((?:,? (?:and |to )?\d+(?:\.\d+)?)+))"), number(R"(\d+(\.\d+)?)");
  std::vector<std::string> found;
  if (text.find("ontract ") == std::string::npos) return found;  // most files, and regular expressions are slow
  for (std::sregex_iterator it(text.begin(), text.end(), citation), end; it != end; ++it) {
    const std::string numbers = (*it)[1];
    for (std::sregex_iterator at(numbers.begin(), numbers.end(), number); at != end; ++at) found.push_back(at->str());
  }
  return found;
}

TEST(Contract, CitationsAreReadFromAText) {
  const std::string text =
      "/// Contract 3.2 applies.\n(contract 1.1, 2.3 and 4.1), contract 9; contracts 5.1, contract: 6 of 7, contract "
      "2.1 to 2.4";
  EXPECT_EQ(citations(text), (std::vector<std::string>{"3.2", "1.1", "2.3", "4.1", "9", "2.1", "2.4"}));
}

TEST(Contract, ClausesAreNumberedInOrderAndEachCitationLeadsToOne) {
  const std::string contract = text_of(kSource / "docs/contract.md");
  const std::regex head(R"((?:^|\n)(?:## (\d+)\. |\*\*(\d+)\.(\d+)\b))");
  std::set<std::string> clauses;
  int section = 0, clause = 0;
  for (std::sregex_iterator it(contract.begin(), contract.end(), head), end; it != end; ++it) {
    if ((*it)[1].matched) {
      EXPECT_EQ(std::stoi((*it)[1]), ++section);
      clause = 0;
    } else {
      EXPECT_EQ(std::stoi((*it)[2]), section);
      EXPECT_EQ(std::stoi((*it)[3]), ++clause) << "in section " << section;
      clauses.insert(std::to_string(section) + '.' + std::to_string(clause));
    }
  }
  EXPECT_GT(clauses.size(), 10U);

  const std::set<std::string> kinds{".hpp", ".cpp", ".h", ".glsl", ".comp", ".sh", ".py", ".md"};
  int cited = 0;
  for (const char* folder :
       {".", "include", "src", "io", "report", "cli", "page", "python", "tests", "bench", "docs", "examples"}) {
    const bool is_root = *folder == '.';
    for (auto it = std::filesystem::recursive_directory_iterator(kSource / folder); it != end(it); ++it) {
      if (is_root) it.disable_recursion_pending();
      if (!kinds.contains(it->path().extension()) || it->path().filename() == "readme_test.cpp") continue;
      for (const std::string& clause_cited : citations(text_of(it->path()))) {
        ++cited;
        EXPECT_TRUE(clauses.contains(clause_cited)) << it->path() << " cites contract " << clause_cited;
      }
    }
  }
  EXPECT_GT(cited, 30);  // the reader of citations works
}

TEST(Version, IsTheSameInTheHeaderAndTheChangelog) {
  const std::string version = IMPINGE_VERSION;
  EXPECT_EQ(version, std::to_string(IMPINGE_VERSION_MAJOR) + '.' + std::to_string(IMPINGE_VERSION_MINOR) + '.' +
                         std::to_string(IMPINGE_VERSION_PATCH));
  EXPECT_NE(text_of(kSource / "CHANGELOG.md").find("## [" + version + "]"), std::string::npos);
}

}  // namespace
