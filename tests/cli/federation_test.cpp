// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// IFC files of four trades in three units and two schemas, whose clashes were planted.
#include "scenes/federation.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "program.hpp"

namespace impinge::test {
namespace {

using Pair = std::pair<std::string, std::string>;

class FederatedProject : public testing::Test {
 protected:
  void SetUp() override {
    for (const scenes::IfcFile& file : federation.files) {
      folder.write(file.name, file.text);
      files.push_back(file.name);
    }
  }
  [[nodiscard]] json clash(const Words& more) const {
    return document(folder, joined({"clash", "--quiet", "--threads", "2"}, more), 1);
  }
  static Pair names_of(const json& report, const json& pair) {
    return std::minmax({name_in(report, pair, "a"), name_in(report, pair, "b")});
  }

  /// A room without a clash and one of each kind, a file of each trade.
  const scenes::Federation federation =
      scenes::federation({.storeys = 2, .rooms = 4, .files = {1, 1, 1, 1}, .national_grid = true});
  Folder folder;
  Words files;
};

TEST_F(FederatedProject, ClashesAsPlannedInWhateverOrderOfFiles) {
  for (const double metres : {0.001, 0.3048}) {  // in the unit of the first file, of architecture or ventilation
    SCOPED_TRACE(metres);
    if (metres > 0.1) std::rotate(files.begin(), files.begin() + 2, files.end());
    const json report = clash(files);
    EXPECT_EQ(report.at("objects").size(), federation.parts);
    std::map<Pair, std::string> found, planned;
    std::map<Pair, json> pairs;
    for (const json& pair : report.at("pairs")) {
      found[names_of(report, pair)] = pair.at("verdict");
      pairs[names_of(report, pair)] = pair;
    }
    for (const auto& pair : federation.pairs) planned[{pair.a, pair.b}] = name(pair.verdict);
    ASSERT_EQ(found, planned);
    for (const auto& [a, b, verdict, depth, fails_below] : federation.pairs) {
      SCOPED_TRACE(a + ", " + b);
      const json& pair = pairs.at({a, b});
      EXPECT_EQ(pair.at("fails"), fails_below > 0);
      if (fails_below == 0) continue;
      double lo = 0, hi = 0;
      for (const char* side : {"a_in_b", "b_in_a"}) {
        lo = std::max(lo, pair.at("overlap_depth").at(side).at(0).get<double>() * metres);
        hi = std::max(hi, pair.at("overlap_depth").at(side).at(1).get<double>() * metres);
      }
      // Vertices are off by 2^-25 of a part's half size. Of duplicates inner points are all that is known.
      constexpr double kRounding = 1e-6;
      EXPECT_LE(lo, depth + kRounding);
      EXPECT_GE(hi, verdict == Verdict::duplicate ? 0.95 * depth : depth - kRounding);
      EXPECT_LE(hi - lo, 0.06 * depth) << "the precision that --depth has by default";
    }
    for (const json& object : report.at("objects")) {
      const std::string name = object.at("name"), storey = object.at("properties").at("storey");
      EXPECT_EQ(storey, "Level " + name.substr(name.find_last_of(' ') + 1, 1)) << name;
      const std::string kind = object.at("properties").at("class");
      for (const auto& [start, of_it] : {std::pair("Basic Wall", "IfcWall"),
                                         {"Duct ", "IfcFlow"},
                                         {"Door", "IfcDoor"},
                                         {"Slab", "IfcSlab"},
                                         {"Tr\u00e4ger", "IfcBeam"},
                                         {"Conduit", "IfcCableCarrier"}})
        EXPECT_TRUE(!name.starts_with(start) || kind.starts_with(of_it)) << name << " " << kind;
    }
  }
}

TEST_F(FederatedProject, FailsInFewerPairsAtLargerTolerances) {
  const std::array<double, 12> ladder{0.0001, 0.001, 0.0035, 0.005, 0.01, 0.02, 0.04, 0.08, 0.12, 0.2, 0.3, 0.5};
  json tests = json::array();
  for (const double metres : ladder)
    tests.push_back({{"name", std::to_string(tests.size())}, {"a", "*"}, {"tolerance", std::to_string(metres) + " m"}});
  folder.write("ladder.json", json{{"tests", tests}}.dump());
  const json report = clash(joined({"--config", "ladder.json"}, files));
  std::map<std::string, std::size_t> failing, expected;
  for (const json& pair : report.at("pairs")) failing[pair.at("test")] += pair.at("fails").get<bool>();
  for (std::size_t i = 0; i < ladder.size(); ++i)
    expected[std::to_string(i)] =
        std::ranges::count_if(federation.pairs, [&](const auto& pair) { return ladder[i] < pair.fails_below; });
  EXPECT_EQ(failing, expected);
}

}  // namespace
}  // namespace impinge::test
