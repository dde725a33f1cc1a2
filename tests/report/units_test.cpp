// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Lengths and places for BIM: in metres with Z up, whatever the files' unit and axes are and the readers make of them.
#include "report/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <tuple>

#include "bcf_reader.hpp"
#include "models.hpp"
#include "report/conventions.hpp"
#include "tests/cli/meshes.hpp"
#include "tests/cli/program.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;

/// The numbers of a description's line that this pattern finds.
std::vector<double> numbers(const std::string& description, const std::string& pattern) {
  std::smatch found;
  EXPECT_TRUE(std::regex_search(description, found, std::regex(pattern))) << description;
  std::vector<double> values;
  for (std::size_t i = 1; i < found.size(); ++i) values.push_back(number(found[i]));
  return values;
}

class Units : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("two.ifc", ifc_of_two_walls());
    folder.write("two.dae", collada_of_two_walls());
  }
  void run(const std::vector<std::string>& more) {
    const Ended ended = impinge(
        folder,
        joined({"clash", "--bcf", "out.bcf", "--csv", "out.csv", "--json", "out.json", "--volume", "--quiet"}, more));
    ASSERT_EQ(ended.code, 1) << ended.err;
    std::vector<Topic> topics = read_bcf(folder.read("out.bcf"));
    ASSERT_EQ(topics.size(), 1U);
    topic = std::move(topics[0]);
    description = topic.text("Description");
    row = rows_of(folder.read("out.csv")).at(0);
    pair = json::parse(folder.read("out.json")).at("pairs").at(0);
    region = pair.at("regions").at(0);
  }
  /// The shared cube's middle is the middle of all symmetry: the cubes change places by a reflection in that point.
  /// Each has a corner 1 m deep in the other, and their surfaces meet in 6 edges of it.
  void expect_two_walls(const Vec& middle, double edge) const {
    const double near = 1e-6 * edge;
    const auto place = numbers(
        description, R"(Region 1: at \((\S+) (\S+) (\S+)\)(?: m)?, area (\S+?)(?: m²)?, length (\S+)(?: m)?\n)");
    ASSERT_EQ(place.size(), 5U);
    EXPECT_NEAR(place[0], middle.x, 10 * near);
    EXPECT_NEAR(place[1], middle.y, 10 * near);
    EXPECT_NEAR(place[2], middle.z, 10 * near);
    EXPECT_NEAR(place[3], std::sqrt(3) * edge * edge, 1e-5 * edge * edge);  // the vector area (1, 1, 1) of the hexagon
    EXPECT_NEAR(place[4], 6 * edge, 60 * near);
    const auto depths = numbers(description, R"(Depth: A in B (\S+) to (\S+?)(?: m)?; B in A (\S+) to (\S+)(?: m)?\n)");
    ASSERT_EQ(depths.size(), 4U);
    for (const std::size_t least : {0, 2}) {
      EXPECT_LE(depths[least], edge + near);
      EXPECT_GT(depths[least], 0.9 * edge);
      EXPECT_GE(depths[least + 1], edge - near);
      EXPECT_LT(depths[least + 1], 1.1 * edge);
    }
    const double volume = edge * edge * edge;
    const bool is_known = description.find("Nobody said the unit") == std::string::npos;
    // Of metres in metres, or else of cubic metres in the unit that stands behind.
    std::smatch told;
    ASSERT_TRUE(std::regex_search(description, told, std::regex(R"(Volume in common: (\S+)(?: (m³|L|cm³|mm³))?\n)")));
    const std::map<std::string, double> sizes{{"", 1}, {"m³", 1}, {"L", 1e-3}, {"cm³", 1e-6}, {"mm³", 1e-9}};
    EXPECT_NEAR(std::stod(told[1]) * sizes.at(told[2]), volume, 1e-5 * volume);
    EXPECT_EQ(is_known, told[2].matched);
    EXPECT_TRUE(!is_known || std::stod(told[1]) >= 1 || told[2] == "mm³") << told[0];
    EXPECT_NEAR(numbers(topic.text("Title"), R"(, (\S+) (?:mm|\(unit unknown\))$)").at(0), edge * (is_known ? 1000 : 1),
                0.1 * edge * (is_known ? 1000 : 1));
    EXPECT_NEAR(number(row.at("x_m")), middle.x, 10 * near);
    EXPECT_NEAR(number(row.at("y_m")), middle.y, 10 * near);
    EXPECT_NEAR(number(row.at("z_m")), middle.z, 10 * near);
    EXPECT_NEAR(number(row.at("depth_m")), edge, 0.1 * edge);
    EXPECT_NEAR(number(row.at("length_m")), 6 * edge, 60 * near);
    EXPECT_NEAR(number(row.at("area_m2")), place[3], 1e-5 * edge * edge);
    EXPECT_NEAR(number(row.at("volume_m3")), volume, 1e-5 * volume);
    // All that is drawn is on the shared cube.
    std::size_t lines = 0;
    for (const pugi::xml_node& line : topic.view().child("Lines")) {
      ++lines;
      for (const char* end : {"StartPoint", "EndPoint"}) {
        const Vec p = vec(line.child(end));
        for (double Vec::*const axis : {&Vec::x, &Vec::y, &Vec::z})
          EXPECT_LE(std::abs(p.*axis - middle.*axis), 0.5 * edge + 10 * near);
      }
    }
    EXPECT_GE(lines, 6U);
    EXPECT_NE(description.find("in metres with Z up"), std::string::npos);
    // The other columns are what the JSON has.
    EXPECT_EQ(number(row.at("y")), region.at("centroid").at(1).get<double>());
    EXPECT_EQ(number(row.at("length")), region.at("length").get<double>());
    EXPECT_EQ(number(row.at("volume")), pair.at("overlap_volume").get<double>());
    EXPECT_EQ(number(row.at("volume_error")), pair.at("overlap_volume_error").get<double>());
  }
  [[nodiscard]] bool is_guessed() const { return description.find("Nobody said the unit") != std::string::npos; }
  Folder folder;
  Topic topic;
  std::string description;
  Row row;
  json pair, region;
};

TEST(VolumeText, HasAUnitOfItsSize) {
  for (const auto& [metres, volume, text] : {std::tuple(std::optional(0.001), 2.5e9, "2.5 m³"),
                                             {0.001, 12'345'678., "12.35 L"},
                                             {0.001, 1000., "1 cm³"},
                                             {0.001, 0.5, "0.5 mm³"},
                                             {1., 0.25, "250 L"},
                                             {1., 0., "0 mm³"},
                                             {0.3048, 2., "2 ft³"},
                                             {0.3048, 0.5, "864 in³"},
                                             {0.0254, 3456., "2 ft³"},
                                             {std::nullopt, 12'345., "1.234e+04"}})
    EXPECT_EQ(report::volume_text(volume, metres, 4), text);
}

TEST_F(Units, OfImportedFilesAreKnown) {
  for (const char* file : {"two.ifc", "two.dae"}) {
    SCOPED_TRACE(file);
    ASSERT_NO_FATAL_FAILURE(run({file}));
    expect_two_walls({5.5, 3.5, 1.5}, 1);
    EXPECT_FALSE(is_guessed());
  }
  // The columns without a unit are those of the JSON: COLLADA is turned to Y up and metres when it is read.
  EXPECT_NEAR(number(row.at("y")), 1.5, 1e-5);
  ASSERT_NO_FATAL_FAILURE(run({"two.ifc"}));
  EXPECT_NEAR(number(row.at("y")), 3500, 1e-2) << "in millimetres, as in the file";
}

TEST_F(Units, OfSeveralFilesAreThoseOfTheFirst) {
  // One wall in millimetres, the other in metres.
  folder.write("left.ifc", ifc_of_walls(std::array<std::size_t, 1>{0}, scenes::kMillimetre, 1000));
  folder.write("right.ifc", ifc_of_walls(std::array<std::size_t, 1>{1}, scenes::kMetre, 1));
  ASSERT_NO_FATAL_FAILURE(run({"left.ifc", "right.ifc"}));
  expect_two_walls({5.5, 3.5, 1.5}, 1);
  EXPECT_FALSE(is_guessed());
}

TEST_F(Units, AndAxesOfSeveralFormatsAreThoseOfTheFirst) {
  for (const auto& [first, second] : {std::pair{"two.ifc", "two.dae"}, std::pair{"two.dae", "two.ifc"}}) {
    SCOPED_TRACE(first);
    EXPECT_EQ(impinge(folder, {"clash", first, second, "--json", "out.json", "--quiet", "--tolerance",
                               std::string(first) == "two.ifc" ? "1e-3" : "1e-6"})
                  .code,
              1);
    // Each wall is there twice.
    EXPECT_EQ(json::parse(folder.read("out.json")).at("counts").at("duplicate"), 2);
  }
}

TEST_F(Units, OfOtherFilesAreAsTheCallSays) {
  folder.write("a.off", off(box({4000, 2000, 0}, {6000, 4000, 2000})));
  folder.write("b.off", off(box({5000, 3000, 1000}, {7000, 5000, 3000})));
  ASSERT_NO_FATAL_FAILURE(run({"a.off", "b.off", "--unit", "mm"}));
  expect_two_walls({5.5, 3.5, 1.5}, 1);
  EXPECT_FALSE(is_guessed());
  ASSERT_NO_FATAL_FAILURE(run({"a.off", "b.off", "--unit", "ft", "--up", "y"}));
  expect_two_walls({5500 * 0.3048, -1500 * 0.3048, 3500 * 0.3048}, 304.8);
}

TEST_F(Units, OfAllFilesAreBroughtToThatOfTheCall) {
  folder.write("cube.off", off(box({5, 3, 1}, {7, 5, 3})));
  for (const auto& [unit, metres] : {std::pair{"m", 1.0}, {"cm", 0.01}, {"ft", 0.3048}}) {
    ASSERT_NO_FATAL_FAILURE(run({"two.ifc", "--unit", unit}));
    expect_two_walls({5.5, 3.5, 1.5}, 1);
    EXPECT_NEAR(number(row.at("y")), 3.5 / metres, 1e-5 / metres) << unit;
    EXPECT_EQ(json::parse(folder.read("out.json")).at("unit"), json({{"name", unit}, {"metres", metres}}));
    EXPECT_EQ(row.at("unit"), unit);
  }
  // What does not say its unit is taken to be in it: the second wall once more.
  const Ended ended = impinge(folder, {"clash", "cube.off", "two.ifc", "--unit", "m", "--json", "out.json"});
  EXPECT_EQ(json::parse(folder.read("out.json")).at("counts").at("duplicate"), 1) << ended.out;
  EXPECT_NE(ended.out.find("depth (m)"), std::string::npos) << ended.out;
  EXPECT_NE(ended.err.find("cube.off does not say its unit and is taken to be in m"), std::string::npos) << ended.err;
  // That, and what was not read, is said in every document.
  folder.write("bad.off", "OFF");
  const std::vector<std::string> words{
      "cube.off", "bad.off", "two.ifc", "--unit",  "m",      "--json",   "out.json",
      "--csv",    "out.csv", "--bcf",   "out.bcf", "--html", "out.html", "--skip-unreadable",
      "--force",  "--quiet"};
  const Ended whole = impinge(folder, joined({"clash"}, words));
  const json answer = json::parse(folder.read("out.json"));
  const std::string skipped = answer.at("missing").at(0), warning = answer.at("warnings").at(0);
  EXPECT_EQ(whole.err, "impinge: " + skipped + "\n");
  EXPECT_TRUE(skipped.starts_with("skipped: bad.off"));
  EXPECT_NE(ended.err.find("impinge: " + warning + "\n"), std::string::npos) << warning;
  const std::vector<Row> rows = rows_of(folder.read("out.csv"));
  ASSERT_GE(rows.size(), 2U);
  const Row &of_file = rows[rows.size() - 2], &of_unit = rows.back();
  EXPECT_EQ(std::tuple(of_file.at("verdict"), of_file.at("a_file"), of_file.at("note")),
            std::tuple("skipped", "bad.off", skipped));
  EXPECT_EQ(std::tuple(of_unit.at("verdict"), of_unit.at("note")), std::tuple("warning", warning));
  for (const Topic& each : read_bcf(folder.read("out.bcf"))) {
    const std::string text = each.text("Description");
    EXPECT_NE(text.find("Not read: " + skipped + "\nWarning: " + warning + "\n"), std::string::npos) << text;
  }
  EXPECT_NE(folder.read("out.html").find(R"("warnings":["cube.off does not say its unit)"), std::string::npos);
  EXPECT_EQ(
      impinge(folder, {"clash", "cube.off", "two.ifc", "--unit", "m", "--scale", "cube.off=1"}).err.find("cube.off"),
      std::string::npos);
}

TEST_F(Units, StandBehindLengths) {
  folder.write("two.json", R"({"tolerance":"2cm","tests":[{"name":"all","a":"*"},
                               {"name":"near","a":"*","mode":"clearance","clearance":"0.5 m","tolerance":"0.5ft"}]})");
  const auto report = [&](const std::vector<std::string>& words) {
    const Ended ended = impinge(folder, joined({"clash", "two.ifc", "--json", "out.json", "--quiet"}, words));
    EXPECT_EQ(ended.code, 1) << ended.err;
    return json::parse(folder.read("out.json"));
  };
  const auto expect_applied = [&](const std::vector<std::string>& words, double tolerance) {
    const json found = report(words);
    EXPECT_DOUBLE_EQ(found.at("settings").at("tolerance").get<double>(), tolerance);
    EXPECT_DOUBLE_EQ(found.at("pairs").at(0).at("tolerance").get<double>(), tolerance);
  };
  // The file is in millimetres.
  expect_applied({"--tolerance", "0.05m"}, 50);
  expect_applied({"--tolerance", "2 in"}, 50.8);
  expect_applied({"--tolerance", "50"}, 50);
  expect_applied({"--tolerance", "0.1", "--unit", "ft"}, 0.1);
  expect_applied({"--tolerance", "6in", "--unit", "ft"}, 0.5);
  EXPECT_DOUBLE_EQ(report({"--clearance", "1ft"}).at("settings").at("clearance").get<double>(), 304.8);
  const json tests = report({"--config", "two.json"}).at("tests");
  EXPECT_DOUBLE_EQ(tests.at(0).at("tolerance").get<double>(), 20);
  EXPECT_DOUBLE_EQ(tests.at(1).at("tolerance").get<double>(), 152.4);
  EXPECT_DOUBLE_EQ(tests.at(1).at("clearance").get<double>(), 500);
  folder.write("a.off", off(box({4, 2, 0}, {6, 4, 2})));
  for (const auto& [word, length] :
       {std::pair{"--tolerance", "10mm"}, {"--clearance", "1 in"}, {"--config", "two.json"}}) {
    const Ended ended = impinge(folder, {"clash", "a.off", word, length});
    EXPECT_EQ(ended.code, 2);
    EXPECT_NE(ended.err.find("no file says the unit of its coordinates; add --unit"), std::string::npos) << ended.err;
  }
  EXPECT_EQ(impinge(folder, {"clash", "a.off", "--tolerance", "10mm", "--unit", "in"}).code, 0);
}

TEST_F(Units, OfAnEarlierRunAreKept) {
  const auto changes = [&](const std::vector<std::string>& words) {
    const Ended ended =
        impinge(folder, joined({"clash", "two.ifc", "--previous", "last.json", "--json", "out.json"}, words));
    const json found = json::parse(folder.read("out.json"));
    return std::tuple(found.at("unit").at("name").get<std::string>(),
                      found.at("pairs").at(0).at("regions").at(0).at("change").get<std::string>(), ended.err);
  };
  impinge(folder, {"clash", "two.ifc", "--unit", "ft", "--regions", "--json", "last.json"});
  EXPECT_EQ(changes({}), std::tuple("ft", "persisting", ""));
  const auto [unit, change, said] = changes({"--unit", "in"});
  EXPECT_EQ(unit, "in");
  EXPECT_EQ(change, "new");
  EXPECT_NE(said.find("last.json is in ft, and this run in in"), std::string::npos) << said;
}

/// A cube with its least corner there.
report::Bounds cube(double at, double edge) { return {{at, at, at}, {at + edge, at + edge, at + edge}}; }

TEST(UnitWarnings, NameFilesThatFitByAUnitAlone) {
  const report::Bounds house = cube(0, 10);
  struct Case {
    report::Bounds box;
    std::optional<double> metres;
    const char* scale;  // that is advised; nothing: none
  };
  for (const Case& each : std::initializer_list<Case>{{cube(2000, 5000), 1, "=0.001 if it is in mm"},
                                                      {cube(0, 10500), {}, "=0.001 brings it to their size"},
                                                      {cube(0, 0.01), 0.001, "=1000 if it is in m"},
                                                      {cube(0, 10 / 25.4), 0.001, "=25.4 if it is in in"},
                                                      {cube(0, 10 / 304.8), 0.001, "=304.8 if it is in ft"},
                                                      {cube(0, 254), 0.0254, "=0.0393701 if it is in mm"},
                                                      {cube(0, 3048), 0.3048, "=0.00328084 if it is in mm"},
                                                      {cube(-40, 90), 1, nullptr},      // the ground around it
                                                      {cube(2000, 5000), {}, nullptr},  // a part, if at all
                                                      {cube(20000, 5000), 1, nullptr},  // too far away in any unit
                                                      {cube(5, 0.01), 1, nullptr},      // a bolt in it
                                                      {cube(0, 5), {}, nullptr}}) {
    const auto warnings = report::unit_warnings(
        {{"part.stl", false, each.box}, {"house.ifc", each.metres.has_value(), house}}, each.metres);
    const bool is_advised =
        warnings.size() == 1 &&
        warnings[0].find(each.scale ? "--scale part.stl" + std::string(each.scale) : "far ") != std::string::npos;
    EXPECT_EQ(is_advised, each.scale != nullptr) << each.box.hi.x << (warnings.empty() ? "" : warnings[0]);
  }
  const auto taken = [&](std::size_t unknown) {
    std::vector<report::FileUnit> files{{"house.ifc", true, house}};
    for (std::size_t i = 0; i < unknown; ++i) files.push_back({std::to_string(i) + ".stl", false, house});
    return report::unit_warnings(files, 1);
  };
  EXPECT_THAT(taken(1),
              testing::ElementsAre(testing::StartsWith("0.stl does not say its unit and is taken to be in m,")));
  EXPECT_THAT(taken(8), testing::ElementsAre(testing::StartsWith(
                            "0.stl, 1.stl, 2.stl, 3.stl, 4.stl and 3 more files do not say their unit and are taken")));
  // Nothing says that a small file is right, and the large one beside it wrong.
  EXPECT_TRUE(
      report::unit_warnings({{"bolt.stl", false, cube(0, 10)}, {"plant.stl", false, cube(0, 5000)}}, 0.001).empty());
  // Of two files that say nothing one is doubted, and of one alone nothing is said.
  EXPECT_EQ(report::unit_warnings({{"a.stl", false, house}, {"b.stl", false, cube(0, 10000)}}, {}).size(), 1U);
  EXPECT_TRUE(report::unit_warnings({{"a.stl", false, house}}, 0.001).empty());
}

TEST_F(Units, ThatNobodySaidAreNotClaimed) {
  folder.write("a.off", off(box({4, 2, 0}, {6, 4, 2})));
  folder.write("b.off", off(box({5, 3, 1}, {7, 5, 3})));
  ASSERT_NO_FATAL_FAILURE(run({"a.off", "b.off"}));
  EXPECT_TRUE(is_guessed());
  for (const char* column : {"depth_m", "distance_m", "area_m2", "length_m", "x_m", "y_m", "z_m"})
    EXPECT_EQ(row.at(column), "") << column;
  EXPECT_EQ(number(row.at("x")), 5.5);
  // A file that is scaled is no longer in its format's unit.
  ASSERT_NO_FATAL_FAILURE(run({"two.dae", "--scale", "two.dae=1000"}));
  EXPECT_TRUE(is_guessed());
  EXPECT_EQ(row.at("x_m"), "");
  EXPECT_NEAR(number(row.at("x")), 5500, 1e-2);
}

// Which axis is up in the coordinates of several files, by their formats. That files are read so is seen in units_test
// and page_test, or by looking at them.

using report::is_y_up;

TEST(UpwardAxis, IsThatOfTheFormat) {
  for (const char* file : {"a.glb", "a.gltf", "a.dae", "a.3ds", "a.3DS", "a.x", "a.fbx"})
    EXPECT_TRUE(is_y_up({file}, {})) << file;
  for (const char* file : {"a.ifc", "a.ifczip", "a.IfcZip", "a.3mf", "a.blend", "a.obj", "a.OBJ", "a.off", "a.ply",
                           "a.stl", "a.amf", "ifc/glb.obj"})
    EXPECT_FALSE(is_y_up({file}, {})) << file;
}

TEST(UpwardAxis, OfSeveralFilesIsThatOfTheFirstWhichHasOne) {
  EXPECT_TRUE(is_y_up({"a.obj", "b.stl", "house.dae"}, {}));
  EXPECT_TRUE(is_y_up({"house.dae", "a.obj"}, {}));
  EXPECT_TRUE(is_y_up({"a.obj", "house.dae", "b.3mf"}, {}));
  EXPECT_FALSE(is_y_up({"a.obj", "b.3mf", "house.dae"}, {}));
  EXPECT_FALSE(is_y_up({"a.obj", "b.stl"}, {}));
}

TEST(UpwardAxis, IsWhatTheCallSays) {
  EXPECT_FALSE(is_y_up({"house.dae"}, false));
  EXPECT_TRUE(is_y_up({"a.stl", "b.3mf"}, true));
}

}  // namespace
}  // namespace impinge::test
