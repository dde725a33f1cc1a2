// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Exports that have a date in their names.
#include <array>
#include <map>
#include <set>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

struct Block {
  std::string name;  ///< empty: it has none, and is called as its file is; only the first may
  std::array<int, 3> lo;
  int size = 2;
};

std::string blocks(const std::vector<Block>& all) {
  std::vector<std::pair<std::string, Solid>> parts;
  for (const auto& [name, lo, size] : all)
    parts.emplace_back(name, box(lo, {lo[0] + size, lo[1] + size, lo[2] + size}));
  return obj(parts);
}

/// The names of two parts.
std::string parts_of(const json& report, const json& pair) {
  const auto [first, second] = std::minmax({name_in(report, pair, "a"), name_in(report, pair, "b")});
  return first + "/" + second;
}

class Renamed : public testing::Test {
 protected:
  /// A run on these files, which knows the last one, and what it complained of.
  void run(Words files) {
    files.insert(files.begin(), {"clash", "--json", "new.json", "--bcf", "new.bcf", "--regions"});
    if (!report.is_null()) {
      folder.write("last.json", report.dump());
      files.insert(files.end(), {"--previous", "last.json"});
    }
    for (const char* name : {"new.json", "new.bcf"}) std::filesystem::remove(folder.path() / name);
    const Ended ended = impinge(folder, files);
    ASSERT_LE(ended.code, 1) << ended.err;
    said = ended.err;
    report = json::parse(folder.read("new.json"));
  }
  /// All pairs, by their parts' names, of which these persist.
  void expect(const std::set<std::string>& persisting, const std::set<std::string>& fresh) const {
    std::set<std::string> kept, others;
    for (const json& pair : report.at("pairs")) {
      const std::string parts = parts_of(report, pair);
      (pair.at("change") == "persisting" ? kept : others).insert(parts);
    }
    EXPECT_EQ(kept, persisting);
    EXPECT_EQ(others, fresh);
  }
  [[nodiscard]] std::map<std::string, std::string> known_as() const {
    std::map<std::string, std::string> known;
    for (const json& file : report.at("files")) known[file.at("name")] = file.at("known_as");
    return known;
  }
  [[nodiscard]] std::set<std::string> ids() const {
    std::set<std::string> found;
    for (const json& pair : report.at("pairs")) found.insert(pair.at("id").get<std::string>());
    return found;
  }
  Folder folder;
  json report;
  std::string said;
};

using Known = std::map<std::string, std::string>;
const std::vector<Block> kModel{{"plate", {0, 0, 0}, 4}, {"pin", {3, 3, 3}}, {"bolt", {-1, -1, -1}}};

TEST_F(Renamed, EachWeekIsTheSameFile) {
  const std::vector<std::string> weeks{"model_2026-11-15.obj", "model_2026-11-22.obj", "model_2026-11-29.obj"};
  std::set<std::string> first;
  for (std::size_t week = 0; week < weeks.size(); ++week) {
    SCOPED_TRACE(weeks[week]);
    std::filesystem::create_directory(folder.path() / std::to_string(week));
    const std::string file = std::to_string(week) + "/" + weeks[week];
    std::vector<Block> model = kModel;
    if (week == 2) model[1].lo = {3, 3, 2};  // one has moved
    folder.write(file, blocks(model));
    run({file});
    EXPECT_EQ(known_as(), (Known{{weeks[week], weeks[0]}}));
    if (week == 0) {
      EXPECT_EQ(said, "");
      first = ids();
      continue;
    }
    EXPECT_EQ(said, "impinge: " + weeks[week] + " is taken for " + weeks[week - 1] +
                        " of last.json, renamed: its parts are known by the same names as then\n");
    expect({"pin/plate", "bolt/plate"}, {});
    EXPECT_TRUE(report.at("resolved").empty());
    EXPECT_EQ(ids(), first) << "and so the topics of the BCF";
  }
  run({"2/" + weeks[2]});
  EXPECT_EQ(said, "");
  expect({"pin/plate", "bolt/plate"}, {});
  // What has the name of the first week then, beside the last one, is another file, and is from then on.
  for (int again = 0; again < 2; ++again) {
    run({"2/" + weeks[2], "0/" + weeks[0]});
    EXPECT_EQ(said, "");
    EXPECT_EQ(known_as(), (Known{{weeks[2], weeks[0]}, {weeks[0], weeks[0] + " (2)"}}));
    for (const json& pair : report.at("pairs"))
      EXPECT_EQ(pair.at("change") == "persisting", again == 1 || first.contains(pair.at("id").get<std::string>()));
    EXPECT_EQ(report.at("pairs").size(), again == 0 ? report.at("pairs").size() : ids().size());
  }
}

TEST_F(Renamed, PartsAreKnownByShapeAndPlaceAndThenByTheirNewNames) {
  folder.write("a.obj", blocks(kModel));
  run({"a.obj"});
  const std::set<std::string> first = ids();
  ASSERT_EQ(first.size(), 2U);
  folder.write("a.obj", blocks({{"x", {0, 0, 0}, 4}, {"y", {3, 3, 3}}, {"z", {-1, -1, -1}}}));
  run({"a.obj"});
  expect({"x/y", "x/z"}, {});
  EXPECT_EQ(ids(), first);
  EXPECT_THAT(said, HasSubstr("3 parts are known again by shape and place alone"));
  // One moves, and keeps its new name; one gets another and moves, and is another.
  folder.write("a.obj", blocks({{"x", {0, 0, 0}, 4}, {"y", {3, 3, 2}}, {"w", {-1, -1, 0}}}));
  run({"a.obj"});
  expect({"x/y"}, {"w/x"});
  EXPECT_TRUE(first.contains(report.at("pairs").at(0).at("id"))) << "by way of two names";
  // What has the first name of another now is not that one.
  folder.write("a.obj", blocks({{"x", {0, 0, 0}, 4}, {"y", {3, 3, 2}}, {"pin", {-1, 3, 3}}}));
  run({"a.obj"});
  expect({"x/y"}, {"pin/x"});
  EXPECT_EQ(ids().size(), 2U);
  // Of two in one place nobody knows which is which.
  folder.write("a.obj", blocks({{"x", {0, 0, 0}, 4}, {"p", {3, 3, 2}}, {"q", {3, 3, 2}}}));
  run({"a.obj"});
  expect({}, {"p/x", "q/x", "p/q"});
}

TEST_F(Renamed, PartsThatAreCalledAsTheirFileAre) {
  write_off(folder, {{"plate_1", box({0, 0, 0}, {4, 4, 4})}, {"pin_1", box({3, 3, 3}, {6, 6, 6})}});
  run({"plate_1.off", "pin_1.off"});
  const std::set<std::string> first = ids();
  for (const char* name : {"plate", "pin"})
    std::filesystem::rename(folder.path() / (name + std::string("_1.off")),
                            folder.path() / (name + std::string("_2.off")));
  run({"plate_2.off", "pin_2.off"});
  EXPECT_EQ(said,
            "impinge: pin_2.off is taken for pin_1.off of last.json, renamed, and 1 other file likewise: its parts are "
            "known by the same names as then\n");
  EXPECT_EQ(ids(), first);
  EXPECT_EQ(report.at("pairs").at(0).at("change"), "persisting");
}

TEST_F(Renamed, OneOfTwoFilesOfWhichAPartHasChanged) {
  folder.write("plates.obj", blocks({kModel[0]}));
  folder.write("pins_1.obj", blocks({kModel[1], kModel[2]}));
  run({"plates.obj", "pins_1.obj"});
  const std::set<std::string> first = ids();
  folder.write("pins_2.obj", blocks({{"pin", {3, 3, 1}}, kModel[2], {"new", {3, -1, 0}}}));
  run({"pins_2.obj", "plates.obj"});
  EXPECT_THAT(said, HasSubstr("pins_2.obj is taken for pins_1.obj of last.json, renamed: "));
  EXPECT_EQ(known_as(), (Known{{"plates.obj", "plates.obj"}, {"pins_2.obj", "pins_1.obj"}}));
  expect({"pin/plate", "bolt/plate"}, {"new/plate"});
  for (const std::string& id : first) EXPECT_TRUE(ids().contains(id));
}

TEST_F(Renamed, FilesThatChangeTheirNamesWithEachOther) {
  const std::string left = blocks({kModel[0], {"pin", {3, 3, 3}}}),
                    right = blocks({{"plate", {20, 0, 0}, 4}, {"pin", {22, 3, 3}}});
  folder.write("a.obj", left), folder.write("b.obj", right);
  run({"a.obj", "b.obj"});
  folder.write("a.obj", right), folder.write("b.obj", left);
  run({"a.obj", "b.obj"});
  EXPECT_EQ(said, "");
  EXPECT_EQ(known_as(), (Known{{"a.obj", "a.obj"}, {"b.obj", "b.obj"}}));
}

TEST_F(Renamed, IsNoneThatIsAnotherFile) {
  // Parts of the same names, but no others: the pairs of the one are resolved, and those of the other are new.
  folder.write("plate.obj", blocks({kModel[0]}));
  folder.write("pins.obj", blocks({{"solid", {3, 3, 3}}, {"frame", {100, 0, 0}}, {"body", {-1, 0, 0}}}));
  folder.write("pipes.obj", blocks({{"solid", {3, 0, 0}}, {"frame", {100, 0, 0}}, {"body", {-1, 3, 0}}}));
  run({"plate.obj", "pins.obj"});
  run({"plate.obj", "pipes.obj"});
  EXPECT_EQ(
      said,
      "impinge: all clashes of pipes.obj are new: last.json has no file of that name, and pins.obj, which it has, "
      "cannot be told for certain to be the same, renamed; if so, give the file the name that it had then\n");
  expect({}, {"plate/solid", "body/plate"});
  EXPECT_EQ(known_as(), (Known{{"plate.obj", "plate.obj"}, {"pipes.obj", "pipes.obj"}}));
  EXPECT_EQ(report.at("resolved").size(), 2U);
}

TEST_F(Renamed, WhatTakesTheFirstNameOfARenamedFileIsNotIt) {
  folder.write("plate.obj", blocks({kModel[0]}));
  folder.write("pins.obj", blocks({kModel[1], kModel[2]}));
  folder.write("pins_2.obj", blocks({kModel[1], kModel[2]}));
  run({"plate.obj", "pins.obj"});
  run({"plate.obj", "pins_2.obj"});
  expect({"pin/plate", "bolt/plate"}, {});
  folder.write("pins.obj", blocks({{"pin", {3, 0, 0}}, {"bolt", {-1, 3, 0}}}));
  run({"plate.obj", "pins.obj"});
  expect({}, {"pin/plate", "bolt/plate"});
  EXPECT_EQ(known_as(), (Known{{"plate.obj", "plate.obj"}, {"pins.obj", "pins.obj (2)"}}));
}

TEST_F(Renamed, IsNoneThatHasTheNameOfAPart) {
  for (const bool stays : {true, false}) {
    SCOPED_TRACE(stays);
    report = json();
    folder.write("bolt.obj", blocks(kModel));
    run({"bolt.obj"});
    folder.write("pin.obj", blocks(stays ? kModel : std::vector<Block>{kModel[0], kModel[1]}));
    run({"pin.obj"});
    expect({}, stays ? std::set<std::string>{"pin/plate", "bolt/plate"} : std::set<std::string>{"pin/plate"});
    EXPECT_EQ(report.at("resolved").size(), 2U);
  }
}

TEST_F(Renamed, WhatHasItsFirstNameLaterIsNotThePartThatHasNone) {
  const Block nameless{"", {0, 0, 0}, 4}, pin{"pin", {3, 3, 3}}, named{"x_1", {4, 4, 4}};
  for (const bool stays : {true, false}) {
    SCOPED_TRACE(stays);
    report = json();
    folder.write("x_1.obj", blocks({nameless, pin}));
    run({"x_1.obj"});
    const std::set<std::string> first = ids();
    folder.write("x_2.obj", blocks({nameless, pin}));
    run({"x_2.obj"});
    EXPECT_EQ(known_as(), (Known{{"x_2.obj", "x_1.obj"}}));
    EXPECT_EQ(ids(), first);
    folder.write("x_2.obj", blocks(stays ? std::vector<Block>{nameless, pin, named} : std::vector<Block>{pin, named}));
    run({"x_2.obj"});
    std::size_t kept = 0;
    for (const json& pair : report.at("pairs")) {
      const bool is_of_nameless = parts_of(report, pair) == "pin/x_2";
      EXPECT_EQ(pair.at("change"), is_of_nameless ? "persisting" : "new") << parts_of(report, pair);
      EXPECT_EQ(first.contains(pair.at("id").get<std::string>()), is_of_nameless);
      kept += is_of_nameless ? 1 : 0;
    }
    EXPECT_EQ(kept, stays ? 1U : 0U);
    EXPECT_EQ(report.at("resolved").size(), stays ? 0U : 1U);
    // With the first name it would be taken for the other.
    std::filesystem::rename(folder.path() / "x_2.obj", folder.path() / "x_1.obj");
    run({"x_1.obj"});
    EXPECT_EQ(known_as(), (Known{{"x_1.obj", "x_1.obj (2)"}}));
    for (const json& pair : report.at("pairs")) EXPECT_EQ(pair.at("change"), "new");
  }
}

TEST_F(Renamed, PartsOfWhichTheNamesAreNoUtf8) {
  const std::vector<Block> latin_1{{"T\xfcr", {0, 0, 0}, 4}, {"St\xfctze", {3, 3, 3}}, {"W\xe4nd", {-1, -1, -1}}};
  folder.write("t\xfcren_1.obj", blocks(latin_1)), folder.write("t\xfcren_2.obj", blocks(latin_1));
  folder.write("pin.obj", blocks({{"pin", {3, -1, -1}}}));
  for (const bool alone : {true, false}) {
    SCOPED_TRACE(alone);
    report = json();
    Words files{"t\xfcren_1.obj"};
    if (!alone) files.emplace_back("pin.obj");
    run(files);
    const std::set<std::string> first = ids();
    files[0] = "t\xfcren_2.obj";
    run(files);
    EXPECT_THAT(said, HasSubstr(" of last.json, renamed: its parts are known by the same names as then"));
    EXPECT_EQ(ids(), first);
    for (const json& pair : report.at("pairs")) EXPECT_EQ(pair.at("change"), "persisting");
  }
}

TEST_F(Renamed, FilesOfWhichTheNamesAreNoUtf8AreNotRenamed) {
  write_off(folder, {{"\xff", box({0, 0, 0}, {4, 4, 4})},
                     {"\xfe", box({3, 3, 3}, {6, 6, 6})},
                     {"plate", box({-1, -1, 1}, {5, 5, 5})}});
  run({"\xff.off", "\xfe.off", "plate.off"});
  ASSERT_EQ(report.at("pairs").size(), 3U);
  const std::set<std::string> first = ids();
  EXPECT_EQ(first.size(), 3U);
  for (int again = 0; again < 2; ++again) {
    run({"\xfe.off", "plate.off", "\xff.off"});
    EXPECT_EQ(said, "");
    EXPECT_EQ(known_as(), (Known{{"\\xff.off", "\\xff.off"}, {"\\xfe.off", "\\xfe.off"}, {"plate.off", "plate.off"}}));
    EXPECT_EQ(ids(), first);
    for (const json& pair : report.at("pairs")) EXPECT_EQ(pair.at("change"), "persisting");
  }
}

TEST_F(Renamed, IsNoneIfAnotherFileIsAsMuchLikeIt) {
  const std::vector<Block> frame{{"frame", {50, 0, 0}}};
  const auto with = [&](const Block& block) { return blocks({frame[0], block}); };
  const std::string first = with({"pin", {3, 3, 3}}), second = with({"pin", {-1, -1, -1}});
  folder.write("plate.obj", blocks({kModel[0]}));
  folder.write("c.obj", second);
  for (const bool moved_on : {true, false}) {
    SCOPED_TRACE(moved_on);
    report = json();
    folder.write("a.obj", first);
    folder.write("b.obj", second);
    run({"plate.obj", "a.obj", "b.obj"});
    // c is what b was, or a copy of it.
    if (moved_on) folder.write("b.obj", first);
    run({"plate.obj", "b.obj", "c.obj"});
    EXPECT_EQ(known_as(), (Known{{"plate.obj", "plate.obj"}, {"b.obj", "b.obj"}, {"c.obj", "c.obj"}}));
    for (const json& pair : report.at("pairs"))
      if (report.at("objects").at(pair.at("b").get<std::size_t>()).at("file") == "c.obj") {
        EXPECT_EQ(pair.at("change"), "new");
      }
  }
}

TEST_F(Renamed, SeveralAtOnceAreToldApartByTheirParts) {
  const std::vector<Block> left{{"plate", {0, 0, 0}, 4}, {"pin", {3, 3, 3}}},
      right{{"plate", {20, 0, 0}, 4}, {"pin", {22, 3, 3}}};
  folder.write("north_1.obj", blocks(left)), folder.write("south_1.obj", blocks(right));
  run({"north_1.obj", "south_1.obj"});
  const auto sides = [&] {
    std::map<std::string, std::string> found;  // by the pairs' ids
    for (const json& pair : report.at("pairs"))
      found[pair.at("id")] = pair.at("regions").at(0).at("centroid").at(0) < 10 ? "left" : "right";
    return found;
  };
  const auto first = sides();
  // Their names say the opposite, and one is added.
  folder.write("south_2.obj", blocks(left)), folder.write("north_2.obj", blocks(right));
  folder.write("west_2.obj", blocks({{"pin", {60, 0, 0}}}));
  run({"west_2.obj", "north_2.obj", "south_2.obj"});
  EXPECT_EQ(known_as(),
            (Known{{"west_2.obj", "west_2.obj"}, {"north_2.obj", "south_1.obj"}, {"south_2.obj", "north_1.obj"}}));
  EXPECT_EQ(sides(), first);
  // Two that are alike: nobody knows which is which.
  folder.write("x.obj", blocks(left)), folder.write("y.obj", blocks(left));
  run({"x.obj", "y.obj"});
  EXPECT_THAT(said, HasSubstr("all clashes of x.obj and 1 other are new: "));
  for (const json& pair : report.at("pairs")) EXPECT_EQ(pair.at("change"), "new");
}

TEST_F(Renamed, OfAReportThatSaysNothingOfFiles) {
  folder.write("model_1.obj", blocks(kModel)), folder.write("model_2.obj", blocks(kModel));
  run({"model_1.obj"});
  report.erase("files");
  run({"model_2.obj"});
  expect({"pin/plate", "bolt/plate"}, {});
}

}  // namespace
}  // namespace impinge::test
