// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// impinge impacts: what meets between states, against formulas on whole numbers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

const Solid kPlate = box({-5, -4, -2}, {6, 7, 0});

class Impacts : public testing::Test {
 protected:
  /// A cube whose lower face is at a height, above a plate whose upper one is at 0.
  void write(const std::string& name, int height) const {
    folder.write(name + ".obj", obj({{"plate", kPlate}, {"cube", cube(0, 0, height)}}));
  }
  /// The same as one part.
  void write_joined(const std::string& name, int height) const {
    folder.write(name, ply(as_one({kPlate, cube(0, 0, height)})));
  }
  [[nodiscard]] Ended run(const Words& words) const { return impinge(folder, joined({"impacts"}, words)); }
  [[nodiscard]] json report(const Words& words, int code = 1) const {
    json report = document(folder, joined({"impacts"}, words), code);
    EXPECT_EQ(report.at("earliest").is_null(), code == 0);
    return report;
  }
  Folder folder;
};

/// Falling from `from` to `to`, the lower face is at 0 when t = from / (from - to).
TEST_F(Impacts, ACubeFallsOnAPlateWhenItsHeightIsZero) {
  for (const auto& [from, to] : {std::array{4, -4}, {3, -1}, {1, -2}, {5, -2}, {3, 0}, {0, 3}, {7, 1}}) {
    SCOPED_TRACE(fmt::format("{} to {}", from, to));
    write("from", from), write("to", to);
    const bool meets = to <= 0 || from <= 0;
    const json found = report({"from.obj", "to.obj"}, meets ? 1 : 0);
    EXPECT_EQ(found.at("impacts").empty(), !meets);
    if (!meets) continue;
    const double quotient = static_cast<double>(from) / (from - to);  // rounded once
    const json& toi = found.at("earliest").at("toi");
    EXPECT_EQ(found.at("earliest").at("frame"), 0);
    EXPECT_LE(toi.at(0), quotient);
    EXPECT_GE(toi.at(1), quotient);
    EXPECT_LE(toi.at(1).get<double>(), std::nextafter(toi.at(0).get<double>(), 2));
    for (const json& impact : found.at("impacts")) {
      EXPECT_GE(impact.at("toi").at(0), toi.at(0));
      expect_members(impact, {{"object_a", 0}, {"object_b", 1}});
    }
    const json first = report({"from.obj", "to.obj", "--earliest"});
    ASSERT_EQ(first.at("impacts").size(), 1U);
    EXPECT_EQ(first.at("impacts").at(0).at("toi"), toi);
    EXPECT_EQ(first.at("earliest"), found.at("earliest"));
    EXPECT_NEAR(first.at("impacts").at(0).at("point").at(2), 0, 1e-14);
  }
}

/// With a separation the time is that at which the height is it, but for a thousandth; a length in metres is the same.
TEST_F(Impacts, ACubeComesWithinASeparationWhenItsHeightIsThat) {
  for (const auto& [from, to] : {std::array{4, -4}, {5, 1}, {3, 2}}) {
    write("from", from), write("to", to);
    const int code = to > 1.5 ? 0 : 1;
    const json found = report({"from.obj", "to.obj", "--unit", "mm", "--separation", "1.5"}, code);
    EXPECT_EQ(found.at("settings").at("separation"), 1.5);
    EXPECT_EQ(report({"from.obj", "to.obj", "--unit", "mm", "--separation", "0.0015m"}, code), found);
    EXPECT_EQ(found.at("impacts").empty(), code == 0);
    if (code == 0) continue;
    const double height = from + (to - from) * found.at("earliest").at("toi").at(0).get<double>();
    EXPECT_GT(height, 1.5);
    EXPECT_LT(height, 1.5 * (1 + 0x1p-9));
  }
  EXPECT_THAT(run({"from.obj", "to.obj", "--separation", "2mm"}).err, HasSubstr("--separation 2mm"));
  EXPECT_THAT(run({"from.obj", "to.obj", "--separation", "1.5"}).out, HasSubstr("Nothing comes within 1.5."));
}

using Flat = std::array<int, 2>;

int side(const Flat& a, const Flat& b, const Flat& c) {
  const int s = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  return (s > 0) - (s < 0);
}
bool is_on(const Flat& p, const Flat& a, const Flat& b) {
  return side(a, b, p) == 0 && std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) &&
         std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
}
/// Of what two features have in the plane of height 0: nothing, a point, a segment or a triangle.
bool meet(const std::vector<Flat>& p, const std::vector<Flat>& q) {
  if (p.empty() || q.empty()) return false;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Flat &a = p.front(), &b = p.back(), &c = q[i], &d = q[(i + 1) % q.size()];
    if (is_on(a, c, d) || is_on(b, c, d) || is_on(c, a, b) || is_on(d, a, b)) return true;
    if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
  }
  return q.size() == 3 && side(q[0], q[1], p[0]) == side(q[1], q[2], p[0]) &&
         side(q[0], q[1], p[0]) == side(q[2], q[0], p[0]);
}

using Found = std::tuple<std::string, std::set<int>, std::set<int>>;

/// The features that meet when the cube stands on the plate: all that they have in common is in one plane.
std::set<Found> meeting_at_rest(const Solid& a, const Solid& b) {
  const auto flat = [](const Solid& solid, const std::set<int>& vertices) {
    std::vector<Flat> points;
    for (const int v : vertices) {
      const auto& [x, y, z] = solid.vertices[static_cast<std::size_t>(v)];
      if (z == 0) points.push_back({x, y});
    }
    return points;
  };
  const auto features = [](const Solid& solid, std::size_t corners) {
    std::set<std::set<int>> all;
    for (const auto& [i, j, k] : solid.triangles) {
      if (corners == 3) all.insert({i, j, k});
      if (corners == 2) all.insert({{i, j}, {j, k}, {k, i}});
      if (corners == 1) all.insert({{i}, {j}, {k}});
    }
    return all;
  };
  std::set<Found> found;
  const auto add = [&](const char* name, std::size_t of_a, std::size_t of_b) {
    for (const auto& f : features(a, of_a))
      for (const auto& g : features(b, of_b))
        if (of_a == 3 ? meet(flat(b, g), flat(a, f)) : meet(flat(a, f), flat(b, g))) found.emplace(name, f, g);
  };
  add("vertex_face", 1, 3), add("face_vertex", 3, 1), add("edge_edge", 2, 2);
  return found;
}

TEST_F(Impacts, EveryPairOfFeaturesThatMeetsIsListedInJsonAndCsv) {
  // A corner of each is within the other's face, and diagonals are on one line.
  const Solid plate = box({-1, -1, -2}, {1, 1, 0});
  for (const auto& [name, height] : {std::pair{"from.obj", 3}, {"to.obj", 0}})
    folder.write(name, obj({{"plate", plate}, {"cube", cube(0, 0, height)}}));
  const std::set<Found> expected = meeting_at_rest(plate, cube(0, 0, 0));
  ASSERT_GT(expected.size(), 10U);
  const json all = report({"from.obj", "to.obj", "--csv", "all.csv"});
  std::set<Found> found;
  for (const json& impact : all.at("impacts")) {
    EXPECT_EQ(impact.at("toi"), (json{1.0, 1.0}));
    found.emplace(impact.at("feature"), impact.at("a_vertices").get<std::set<int>>(),
                  impact.at("b_vertices").get<std::set<int>>());
  }
  EXPECT_EQ(found, expected);
  EXPECT_EQ(all.at("impacts").size(), expected.size());
  expect_members(all, {{"truncated", false}, {"files", {"from.obj", "to.obj"}}});
  std::string csv =
      "frame,toi_lo,toi_hi,feature,object_a,object_b,a,b,a_vertices,b_vertices,x,y,z,normal_x,normal_y,normal_z,"
      "from_file,to_file\r\n";
  for (const json& impact : all.at("impacts")) {
    const auto spaced = [&](const char* key) {
      return fmt::format("{}", fmt::join(impact.at(key).get<std::vector<int>>(), " "));
    };
    const auto point = [&](const char* key) {
      return fmt::format("{}", fmt::join(impact.at(key).get<std::vector<double>>(), ","));
    };
    csv += fmt::format("0,1,1,{},plate,cube,{},{},{},{},{},{},from.obj,to.obj\r\n",
                       impact.at("feature").get<std::string>(), impact.at("a").get<int>(), impact.at("b").get<int>(),
                       spaced("a_vertices"), spaced("b_vertices"), point("point"), point("normal"));
  }
  EXPECT_EQ(folder.read("all.csv"), csv);

  for (const std::size_t limit : {std::size_t{0}, std::size_t{1}, std::size_t{7}, expected.size()}) {
    const json some = report({"from.obj", "to.obj", "--limit", std::to_string(limit)});
    expect_members(some, {{"truncated", limit < expected.size()}, {"earliest", all.at("earliest")}});
    EXPECT_EQ(some.at("impacts"),
              json(std::vector<json>(all.at("impacts").begin(), all.at("impacts").begin() + static_cast<long>(limit))));
  }
  EXPECT_THAT(run({"from.obj", "to.obj", "--limit", "0"}).out,
              StartsWith("The first impact is at 1 of the step from from.obj to to.obj.\n"
                         "Cut short by --limit 0: there are more.\n"));
}

TEST_F(Impacts, ASequenceSaysInWhichStep) {
  // At 0 when t = 3/4 of the step from the third state.
  const std::array heights{9, 6, 3, -1, -1};
  for (std::size_t i = 0; i < heights.size(); ++i) write_joined(fmt::format("frame_{:04}.ply", i + 8), heights[i]);
  const Words names{"frame_0008.ply", "frame_0009.ply", "frame_0010.ply", "frame_0011.ply", "frame_0012.ply"};
  for (const bool by_pattern : {true, false}) {
    Words words = by_pattern ? Words{"frame_####.ply"} : names;
    words.push_back("--self");
    const json all = report(words);
    EXPECT_EQ(all.at("earliest"), (json{{"frame", 2}, {"toi", {0.75, 0.75}}}));
    EXPECT_EQ(all.at("files"), json(names));
    // In the last step nothing moves, and what meets does so from its beginning.
    std::set<int> frames;
    for (const json& impact : all.at("impacts")) {
      frames.insert(impact.at("frame").get<int>());
      if (impact.at("frame") == 3) {
        EXPECT_EQ(impact.at("toi"), (json{0.0, 0.0}));
      }
    }
    EXPECT_EQ(frames, (std::set{2, 3}));
    words.push_back("--earliest");
    EXPECT_EQ(report(words).at("earliest"), all.at("earliest"));
  }
  const Ended text = run({"frame_####.ply", "--self", "--earliest"});
  EXPECT_EQ(text.code, 1);
  EXPECT_THAT(text.out, HasSubstr("The first impact is at 0.75 of the step from frame_0010.ply to frame_0011.ply.\n"));
  EXPECT_EQ(run({"frame_0008.ply", "frame_0009.ply", "--self"}).code, 0);
  // A folder may have # in its name.
  const auto other = folder.path() / "run #2";
  std::filesystem::create_directory(other);
  for (const std::string& name : names) std::filesystem::copy_file(folder.path() / name, other / name);
  EXPECT_EQ(report({"run #2/frame_####.ply", "--self"}).at("earliest"), (json{{"frame", 2}, {"toi", {0.75, 0.75}}}));
  EXPECT_EQ(run({"run #2/frame_0008.ply", "run #2/frame_0009.ply", "--self"}).code, 0);
  EXPECT_THAT(run({"run #2/none.ply", "--self"}).err, HasSubstr("run #2/none.ply is one state"));
}

TEST_F(Impacts, SelfIsBesideThePairsOfParts) {
  // The cube falls through a sheet that is part of it, and stays above the plate.
  const auto state = [&](int height) {
    return obj({{"plate", kPlate}, {"both", as_one({sheet({-1, -1}, {4, 4}, 6), cube(0, 0, height)})}});
  };
  folder.write("from.obj", state(8)), folder.write("to.obj", state(4));
  EXPECT_EQ(run({"from.obj", "to.obj"}).code, 0);
  const json self = report({"from.obj", "to.obj", "--self"});
  EXPECT_EQ(self.at("earliest").at("toi"), (json{0.5, 0.5}));
  for (const json& impact : self.at("impacts")) EXPECT_EQ(impact.at("object_a"), 1);
}

TEST_F(Impacts, WrongStatesAreOneSentence) {
  write("from", 3), write("to", 0);
  write_joined("frame_1.ply", 9), write_joined("frame_2.ply", 6), write_joined("frame_4.ply", 3);
  write_joined("frame_10.ply", 3);
  folder.write("solo.ply", ply(cube(0, 0, 0)));
  folder.write("nan.ply", [] {
    std::string text = ply(cube(0, 0, 0));
    return text.replace(text.find("\n0 0 0\n"), 7, "\nnan 0 0\n");
  }());
  folder.write("other.obj", obj({{"plate", kPlate}, {"cube", sheet({0, 0}, {2, 2}, 1)}}));
  folder.write("turned.obj", [] {
    Solid solid = cube(0, 0, 3);
    std::swap(solid.triangles[4][0], solid.triangles[4][1]);
    return obj({{"plate", kPlate}, {"cube", solid}});
  }());
  folder.write("reversed.obj", obj({{"cube", cube(0, 0, 3)}, {"plate", kPlate}}));
  // Its lower face is beyond 2^300, about 2e90.
  folder.write("far.obj", [] {
    std::string text = obj({{"plate", kPlate}, {"cube", cube(0, 0, 1234567)}});
    for (std::size_t i = 0; (i = text.find(" 1234567", i)) != std::string::npos;) text.replace(i, 8, " 1e100");
    return text;
  }());
  std::filesystem::create_directory(folder.path() / "run_1");
  const std::vector<std::pair<Words, std::string>> wrong{
      {{"from.obj", "reversed.obj"}, "part 'plate' stands where 'cube' is in the other"},
      {{"run_1"}, "run_1 is a folder; name the files in it, as run_1/frame_####.ply"},
      {{"from.obj", "run_1"}, "run_1 is a folder"},
      {{"frame_#.ply", "frame_1.ply"}, "frame_#.ply stands for a sequence, which is given alone"},
      {{"from.obj"}, "from.obj is one state, and nothing moves in it"},
      {{"from.obj", "other.obj"},
       "from.obj and other.obj are not two states of the same parts: part 'cube' has 12 and 2 "
       "triangles"},
      {{"from.obj", "turned.obj"}, "triangle 4 of part 'cube' has other vertices"},
      {{"from.obj", "solo.ply"}, "they have 2 and 1 parts"},
      {{"solo.ply", "solo.ply"}, "solo.ply has one part alone, and no part is tested against itself without --self"},
      {{"solo.ply", "nan.ply", "--self"}, "nan.ply"},
      {{"from.obj", "none.obj"}, "none.obj"},
      {{"frame_#.ply", "--self"}, "frame_3.ply is missing: after frame_2.ply comes frame_4.ply"},
      {{"frame_1.ply", "frame_2.ply", "frame_4.ply"}, "frame_4.ply does not follow frame_2.ply"},
      {{"frame_1.ply", "frame_10.ply", "frame_2.ply"}, "frame_#.ply stands for all of them"},
      {{"frame_##.ply"}, "frame_##.ply: there is one file of that name"},
      {{"state_###.ply"}, "there is no file of that name"},
      {{"frame_#_#.ply"}, "one number"},
      {{"from.obj", "far.obj"}, "from.obj to far.obj: 'cube' is out of range"},
      {{"far.obj", "to.obj"}, "far.obj to to.obj: 'cube', at the start of its motion, is out of range"},
      {{"from.obj", "to.obj", "--limit", "x"}, "'x'"},
      {{"from.obj", "to.obj", "--json", "from.obj"}, "one of the files to read"},
      {{"from.obj", "to.obj", "--json", "x", "--csv", "x"}, "cannot both go to x"},
      {{}, "FILE is required"},
  };
  for (const auto& [words, part] : wrong) {
    EXPECT_THAT(refusal(folder, joined({"impacts"}, words)), HasSubstr(part));
  }
  // A folder's name is no sequence, and names without numbers are in the order that is given.
  EXPECT_EQ(run({"frame_1.ply", "frame_2.ply", "--self"}).code, 0);
  EXPECT_EQ(run({"from.obj", "to.obj", "from.obj", "--quiet"}).code, 1);
}

}  // namespace
}  // namespace impinge::test
