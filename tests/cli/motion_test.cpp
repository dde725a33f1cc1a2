// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// impinge motion: when parts clash, against polygons; and what it says and writes.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <map>
#include <numbers>
#include <optional>
#include <thread>

#include "flat_overlaps.hpp"
#include "impinge/clash.hpp"
#include "motion_fixture.hpp"
#include "report/motion/mover.hpp"
#include "scenes/mechanism.hpp"

namespace impinge::test {
namespace {

using namespace std::chrono_literals;

constexpr double kSeconds = 4;

void expect_moment(const json& found, const std::optional<double>& expected, double most) {
  ASSERT_EQ(found.is_null(), !expected.has_value());
  if (!expected) return;
  EXPECT_LE(found.at(0), found.at(1));
  EXPECT_LT(found.at(1).get<double>() - found.at(0).get<double>(), kSeconds * 1e-6);
  EXPECT_NEAR(found.at(0), *expected, most);
}

/// The middle of what the two have in common when they meet: a plane at x.
void expect_point(const json& found, const std::array<double, 3>& expected) {
  ASSERT_EQ(found.size(), 3U) << found;
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 1e-5) << k;
}

/// What is nearer than `most` seconds to the true time is right: outlines reach into each other by 0.1 a second and
/// more where they begin to, single precision moves them by 1e-6, and a tolerance excuses itself.
void expect_spans(const json& report, const std::vector<Overlap>& expected, double most) {
  const json& spans = report.at("spans");
  ASSERT_EQ(spans.size(), expected.size()) << report.dump();
  for (std::size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(spans[i].at("a"), expected[i].a);
    EXPECT_EQ(spans[i].at("b"), expected[i].b);
    expect_moment(spans[i].at("from"), expected[i].from, most);
    expect_moment(spans[i].at("to"), expected[i].to, most);
    EXPECT_EQ(spans[i].at("worst"), "penetrating");
    EXPECT_GE(spans[i].at("worst_at"), expected[i].from.value_or(0));
    EXPECT_LE(spans[i].at("worst_at"), expected[i].to.value_or(kSeconds));
  }
}

constexpr double kExactly = 2e-5, kAutomatically = 2e-4;

TEST_F(Motion, TheRockerRunsIntoItsStopWhenThePolygonsDo) {
  const auto parts = scenes::four_bar_linkage(kSeconds);
  write(parts);
  const auto expected = overlaps(parts, kSeconds);
  ASSERT_EQ(expected.size(), 1u);
  expect_spans(report(), expected, kAutomatically);
  expect_spans(report({"--tolerance", "0"}), expected, kExactly);
  expect_spans(report({"--frames", "7"}), expected, kAutomatically);
}

/// Of a pair of gears, computed once for each distance.
const std::vector<Overlap>& overlaps_of_gears(double distance) {
  static std::map<double, std::vector<Overlap>> known;
  const auto [place, is_new] = known.try_emplace(distance);
  if (is_new) place->second = overlaps(scenes::gear_pair(kSeconds, distance), kSeconds);
  return place->second;
}

TEST_F(Motion, GearsClashWhenTheirPolygonsDo) {
  for (const double distance : {7.875, 7.859375, 7.84765625, 7.75}) {
    SCOPED_TRACE(distance);
    write(scenes::gear_pair(kSeconds, distance));
    const auto& expected = overlaps_of_gears(distance);
    // 12 teeth, twice each; at 7.84765625 they clash in the beginning and in the end, and less long apart than a step.
    const std::size_t count = distance > 7.86 ? 0 : distance > 7.85 ? 24 : distance > 7.8 ? 37 : 1;
    EXPECT_EQ(expected.size(), count);
    const auto frames = distance > 7.85 || distance < 7.8 ? "120" : "600";
    expect_spans(report({"--frames", frames, "--tolerance", "0"}, count > 0 ? 1 : 0), expected, 1e-4);
  }
}

/// Of clashes that are over within a step the first of each step is found, with its times.
TEST_F(Motion, ShortClashesAreFoundBetweenSteps) {
  write(scenes::gear_pair(kSeconds, 7.859375));
  const auto& expected = overlaps_of_gears(7.859375);
  for (const Overlap& overlap : expected) ASSERT_LT(*overlap.to - *overlap.from, 0.05);
  const json coarse = report({"--frames", "20", "--tolerance", "0"});
  EXPECT_EQ(coarse.at("animation").at("step"), 0.2);
  std::size_t seen = 0;
  for (const Overlap& overlap : expected)
    for (int frame = 0; frame <= 20; ++frame)
      seen += kSeconds * frame / 20 >= *overlap.from && kSeconds * frame / 20 <= *overlap.to;
  ASSERT_LT(seen, expected.size());
  EXPECT_GT(coarse.at("spans").size(), seen);
  for (const json& span : coarse.at("spans")) {
    // Of several in one step, which may be taken for one, some begin and some end.
    const auto is_near = [&](double time, auto member) {
      return std::ranges::any_of(expected,
                                 [&](const Overlap& overlap) { return std::abs(time - *(overlap.*member)) < 1e-4; });
    };
    EXPECT_TRUE(is_near(span.at("from").at(0), &Overlap::from)) << span;
    EXPECT_TRUE(is_near(span.at("to").at(1), &Overlap::to)) << span;
  }
}

TEST_F(Motion, SaysTheSameOnAnyNumberOfThreads) {
  write(scenes::four_bar_linkage(kSeconds));
  const std::string one = run({"--json", "-", "--depth", "0.01", "--threads", "1"}).out;
  EXPECT_TRUE(json::accept(one));
  EXPECT_EQ(run({"--json", "-", "--depth", "0.01", "--threads", "4"}).out, one);
  EXPECT_EQ(run({"--json", "-", "--depth", "0.01"}).out, one);
}

/// A cube of edge 2 goes through another one: they touch at x = -2, overlap until 2, and are one at 0.
AnimatedGltf passing_cubes() {
  AnimatedGltf file = still_and_moving();
  file.channel(1, "translation", {0, 8}, {-4, 0, 0, 4, 0, 0});
  file.animation("stay away");
  file.channel(1, "translation", {0, 1}, {4, 0, 0, 5, 0, 0});
  file.animation("2");
  file.channel(1, "translation", {0, 1}, {0, 0.5, 0, 0, 1, 0});
  return file;
}

/// The cubes are apart in the beginning and in the end.
TEST_F(Motion, WhatPassesThroughWithinAStepIsFound) {
  write(passing_cubes());
  for (const char* const frames : {"1", "3"}) {  // at 0 and 8; at 0, 2.67, 5.33 and 8
    const json passing = report({"--frames", frames, "--tolerance", "0"});
    ASSERT_EQ(passing.at("spans").size(), 1U);
    const json& span = passing["spans"][0];
    expect_moment(span.at("from"), 2, 2e-5);
    expect_moment(span.at("to"), 6, 2e-5);
    expect_point(span.at("point"), {-1, 0, 0});
    EXPECT_GE(span.at("worst_at"), 2);
    EXPECT_LE(span.at("worst_at"), 6);
  }
  EXPECT_EQ(run({"--frames", "1", "--ignore", "still", "mov*"}).code, 0);
  EXPECT_TRUE(report({"--frames", "1", "--animation", "stay away"}, 0).at("spans").empty());
}

/// Their distance at both ends is a thousandth of their size, less than what the sweeps tell.
TEST_F(Motion, WhatPassesThroughFromNearToNearIsFound) {
  AnimatedGltf file = still_and_moving();
  file.channel(1, "translation", {0, 8}, {-2.001, 0, -1, 2.001, 0, -1});
  write(file);
  const json passing = report({"--frames", "1", "--tolerance", "0"});
  ASSERT_EQ(passing.at("spans").size(), 1U);
  expect_moment(passing["spans"][0].at("from"), 0.002, 2e-5);
  expect_moment(passing["spans"][0].at("to"), 7.998, 2e-5);
  expect_point(passing["spans"][0].at("point"), {-1, 0, -0.5});  // upper half on lower half
}

/// A square tube along z, from -1 to 1 each way, whose walls are so thick.
int square_tube(AnimatedGltf& file, double wall) {
  std::vector<double> corners;
  for (const double half : {1.0, 1 - wall})
    for (const auto& [x, y] : {std::array{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      for (const int z : {-1, 1}) corners.insert(corners.end(), {half * x, half * y, static_cast<double>(z)});
  std::vector<int> triangles;
  const auto add = [&](int a, int b, int c, int d) { triangles.insert(triangles.end(), {a, b, c, a, c, d}); };
  for (int low = 0; low < 8; low += 2) {
    const int next = (low + 2) % 8;
    add(low, next, next + 1, low + 1);          // outside
    add(next + 8, low + 8, low + 9, next + 9);  // inside
    add(low + 1, next + 1, next + 9, low + 9);  // upper end
    add(next, low, low + 8, next + 8);          // lower end
  }
  return file.mesh(corners, triangles);
}

/// A cube of 10 mm goes through both walls of a tube of 100 mm: between them it touches nothing.
TEST_F(Motion, WhatPassesThroughThinWallsWithinAStepIsFound) {
  for (const double wall : {0.003, 0.0001}) {
    AnimatedGltf file;
    const int tube =
        file.node({{"name", "tube"}, {"mesh", square_tube(file, wall / 0.05)}, {"scale", {0.05, 0.05, 0.05}}});
    const int cube = file.node({{"name", "cube"}, {"mesh", 0}, {"scale", {0.005, 0.005, 0.005}}});
    file.roots({tube, cube});
    file.animation("fly");
    file.channel(cube, "translation", {0, 4}, {-0.1, 0, 0, 0.1, 0, 0});
    write(file);
    const json passing = report({"--frames", "1", "--tolerance", "0"});
    ASSERT_EQ(passing.at("spans").size(), 1U) << wall;
    const json& span = passing["spans"][0];
    EXPECT_EQ(span.at("worst"), "penetrating");
    expect_moment(span.at("from"), 0.045 / 0.05, 2e-5);
    expect_moment(span.at("to"), (0.055 + wall) / 0.05, 2e-5);  // of the first wall
    expect_point(span.at("point"), {-0.05, 0, 0});
  }
}

TEST_F(Motion, OptionsSayWhatIsAClash) {
  write(passing_cubes());
  const json passing = report({"--frames", "16", "--tolerance", "0"});
  ASSERT_EQ(passing.at("spans").size(), 1u);
  const json& span = passing["spans"][0];
  expect_moment(span.at("from"), 2, 1e-5);
  expect_moment(span.at("to"), 6, 1e-5);
  expect_point(span.at("point"), {-1, 0, 0});
  // No tolerance excuses it while each reaches more than half of the way to the other's middle; at 3, 4 and 5 they do
  // reach it.
  EXPECT_TRUE(span.at("fails_below").is_null());
  EXPECT_NEAR(span.at("worst_at"), 4, 1);
  EXPECT_EQ(passing.at("settings").at("fail_on"), (json{"penetration", "inside"}));
  EXPECT_EQ(passing.at("objects").at(0).at("moves"), false);
  EXPECT_EQ(passing.at("objects").at(1).at("moves"), true);

  // By contact they clash at the frames 2 and 6 as well, between which and the next ones they part at once.
  const json contact = report({"--frames", "16", "--tolerance", "0", "--fail-on", "contact"});
  expect_moment(contact.at("spans").at(0).at("from"), 2, 1e-5);
  EXPECT_EQ(run({"--fail-on", "inside"}).code, 0);
  EXPECT_EQ(run({"--ignore", "still", "mov*"}).code, 0);
  EXPECT_EQ(run({"--ignore", "still", "moved"}).code, 2);
  // A tolerance excuses so much of the way.
  for (const double tolerance : {0.1, 0.2})
    expect_moment(report({"--tolerance", fmt::format("{}", tolerance)}).at("spans").at(0).at("from"), 2 + tolerance,
                  1e-5);
  // The file is in metres.
  for (const char* const tolerance : {"200", "0.2 m", "20 cm"}) {
    const json in_mm = report({"--tolerance", tolerance, "--unit", "mm"});
    EXPECT_EQ(in_mm.at("unit").at("name"), "mm");
    EXPECT_NEAR(in_mm.at("settings").at("tolerance"), 200, 1e-9);
    expect_moment(in_mm.at("spans").at(0).at("from"), 2.2, 1e-5);
  }
}

TEST_F(Motion, OneOfSeveralAnimationsIsChosen) {
  write(passing_cubes());
  EXPECT_EQ(report().at("animation").at("name"), "pass");
  EXPECT_TRUE(report({"--animation", "stay away"}, 0).at("spans").empty());
  EXPECT_EQ(report({"--animation", "1"}, 0).at("animation").at("name"), "stay away");
  EXPECT_EQ(report({"--animation", "0"}).at("animation").at("name"), "pass");
  const json named = report({"--animation", "2"});
  EXPECT_EQ(named.at("animation").at("name"), "2") << "a name goes before a number";
  EXPECT_TRUE(named.at("spans").at(0).at("from").is_null());
  EXPECT_TRUE(named.at("spans").at(0).at("to").is_null());
  EXPECT_TRUE(named.at("spans").at(0).at("point").is_null());
  EXPECT_THAT(refused({"--animation", "3"}), HasSubstr("has no such animation, but 0 'pass', 1 'stay away', 2 '2'"));
  // As long as before, since a GLB says how long its JSON is.
  std::string file = folder.read("case.glb");
  const std::string name = R"("stay away")";
  ASSERT_THAT(file, HasSubstr(name));
  folder.write("case.glb", file.replace(file.find(name), name.size(), R"("pass"     )"));
  EXPECT_EQ(refused({"--animation", "pass"}),
            "impinge: --animation pass: case.glb has 2 animations of that name; choose one by its number: 0, 1\n");
  EXPECT_TRUE(report({"--animation", "1"}, 0).at("spans").empty());
  EXPECT_EQ(report({"--animation", "0"}).at("spans").size(), 1U);
}

TEST_F(Motion, WrongWordsAreErrors) {
  write(passing_cubes());
  const std::vector<Words> kWrong{{"--frames", "0"},      {"--frames", "1000001"},
                                  {"--frames", "x"},      {"--fail-on", "clearance"},
                                  {"--tolerance", "-1"},  {"case.glb"},
                                  {"--json", "case.glb"}, {"--html", "no/such/folder.html"}};
  for (const auto& words : kWrong) {
    SCOPED_TRACE(testing::PrintToString(words));
    static_cast<void>(refused(words));
  }
  AnimatedGltf still;
  still.roots({still.node({{"mesh", 0}})});
  write(still);
  EXPECT_THAT(refused(), HasSubstr("nothing moves in it"));
}

/// A bar that is stretched while it turns reaches what it would not otherwise.
TEST_F(Motion, StretchedPartsAreMappedAtEachTime) {
  AnimatedGltf file;
  const int bar = file.node({{"name", "bar"}, {"mesh", 0}});
  const int frame = file.node({{"name", "frame"}, {"scale", {3, 1, 1}}, {"children", {bar}}});
  const int post = file.node({{"name", "post"}, {"mesh", 0}, {"translation", {0, 3, 0}}});
  file.roots({frame, post});
  file.animation("stretch");
  file.channel(bar, "scale", {0, 4}, {1, 1, 1, 1, 3, 1});  // its top is at 1 + t / 2: at 2 it meets the post
  write(file);
  const json out = report({"--tolerance", "0", "--frames", "7"});
  ASSERT_EQ(out.at("spans").size(), 1u);
  expect_moment(out["spans"][0].at("from"), 2, 1e-5);
  EXPECT_TRUE(out["spans"][0].at("to").is_null());
  // Turned by a quarter within the frame it is 3 wide and 1 high, as before, but on the way its corners go up to where
  // |(sin u, cos u)| of (1, 1) reaches: the square root of 2, at half time.
  AnimatedGltf other;
  const int square = other.node({{"name", "square"}, {"mesh", 0}});
  other.roots({other.node({{"scale", {3, 1, 1}}, {"children", {square}}}),
               other.node({{"name", "post"}, {"mesh", 0}, {"translation", {0, 2.25, 0}}})});
  other.animation("turn");
  const double half = std::sqrt(0.5);
  other.channel(square, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, half, half});
  write(other);
  // Its top at the angle u is sin u + cos u = sqrt 2 cos (u - 45 degrees), at x = 3 (cos u - sin u): the post reaches
  // from -1 to 1 there. Its lower side is at 1.25.
  const double begin = (std::numbers::pi / 4 - std::acos(1.25 / std::numbers::sqrt2)) / (std::numbers::pi / 2);
  const json turned = report({"--tolerance", "0", "--frames", "50"});
  ASSERT_EQ(turned.at("spans").size(), 1u);
  // The corner comes over the post where 3 (cos u - sin u) is 1; its edges reach it before that, so it is no earlier
  // than the corner's height and no later than when the corner is over it.
  const double over = (std::numbers::pi / 4 - std::asin(1 / (3 * std::numbers::sqrt2))) / (std::numbers::pi / 2);
  const double from = turned["spans"][0].at("from").at(0), to = turned["spans"][0].at("to").at(0);
  EXPECT_GE(from, begin - 1e-5);
  EXPECT_LE(from, over + 1e-5);
  EXPECT_NEAR(from + to, 1, 1e-5) << "it is the same backwards";
}

/// A cube of edge 2 goes through a box of edge 6: it is within it from 4 to 8.
TEST_F(Motion, TellsWhichPartIsTheInnerOne) {
  for (const bool is_small_first : {false, true}) {
    SCOPED_TRACE(is_small_first);
    AnimatedGltf file;
    const json large{{"name", "large"}, {"mesh", 0}, {"scale", {3, 3, 3}}}, small{{"name", "small"}, {"mesh", 0}};
    const int first = file.node(is_small_first ? small : large), second = file.node(is_small_first ? large : small);
    file.roots({first, second});
    file.animation("");
    file.channel(is_small_first ? first : second, "translation", {0, 12}, {-6, 0, 0, 6, 0, 0});
    write(file);
    const json out = report({"--frames", "12", "--tolerance", "0"});
    ASSERT_EQ(out.at("spans").size(), 1u);
    EXPECT_EQ(out["spans"][0].at("worst"), "inside");
    EXPECT_EQ(out["spans"][0].at("inner"), is_small_first ? 0 : 1);
    const std::string table = run({"--frames", "12", "--tolerance", "0"}).out;
    EXPECT_LT(table.find("small"), table.find("large")) << table;
    EXPECT_THAT(table, HasSubstr("an animation without a name of 12"));
    EXPECT_THAT(run({"--frames", "1"}).out, HasSubstr("Looked at 1 step of 12"));
    EXPECT_THAT(run({"--animation", "x"}).err, HasSubstr("but 0 without a name"));
    const json penetrating = report({"--frames", "8", "--fail-on", "penetration"});
    for (const json& span : penetrating.at("spans")) EXPECT_TRUE(span.at("inner").is_null());
  }
}

/// Between equal keys the numbers of a pose are the same, so that nothing has to be looked at again.
TEST_F(Motion, APartThatRestsStandsStillToTheBit) {
  AnimatedGltf file;
  const int part = file.node({{"name", "part"}, {"mesh", 0}});
  file.roots({part, file.node({{"name", "other"}, {"mesh", 0}})});
  file.animation("go and stay");
  file.channel(part, "translation", {0, 1, 2, 3}, {0, 0, 0, 0.1, 0.7, 1.3, 0.1, 0.7, 1.3, 0, 0, 0});
  file.channel(part, "rotation", {0, 1, 2, 3}, {0, 0, 0, 1, 0.1, 0.5, 0.1, 0.85, 0.1, 0.5, 0.1, 0.85, 0, 0, 0, 1});
  write(file);
  const auto model = io::read(folder.path() / "case.glb");
  ASSERT_TRUE(model) << model.error().message;
  const report::Mover mover(*model, model->animations.front());
  const Pose pose = mover.at(1).value()[0].pose;
  for (int i = 1; i <= 100; ++i) {
    const Pose later = mover.at(1 + 0.01 * i).value()[0].pose;
    EXPECT_EQ(later.R, pose.R) << i;
    EXPECT_EQ(later.t, pose.t) << i;
  }
  EXPECT_NE(mover.at(2.5).value()[0].pose.t, pose.t);
}

TEST_F(Motion, TheTableSaysWhatItCannotSee) {
  write(scenes::four_bar_linkage(kSeconds));
  const Ended ended = run({"--frames", "40"});
  EXPECT_EQ(ended.code, 1);
  for (const char* part : {"rocker", "5 parts, 3 of them moving", "Looked at 40 steps of 0.1"})
    EXPECT_THAT(ended.out, HasSubstr(part));
  EXPECT_EQ(run({"--quiet"}).out, "");
}

TEST_F(Motion, AnInterruptLeavesNoFile) {
  write(scenes::gear_pair(kSeconds, 7.75));
  const auto before = folder.names();
  Running running(folder, {IMPINGE_PROGRAM, "motion", "case.glb", "--frames", "1000000", "--json", "out.json"});
  ASSERT_TRUE(running.handles(SIGINT, 20s));
  std::this_thread::sleep_for(300ms);
  running.send(SIGINT);
  const Ended ended = running.wait();
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err, "impinge: interrupted; there is no result\n");
  EXPECT_EQ(folder.names(), before);
}

/// Corners on a page, in single precision about their mesh's middle, and where its poses put them.
class MotionPage : public Motion {
 protected:
  void SetUp() override {
    folder.write("page.html", kPageHead + "<title>t</title>\n<!-- impinge: data -->\n");
    launch.environment["IMPINGE_PAGE"] = (folder.path() / "page.html").string();
  }
  Launch launch;
};

TEST_F(MotionPage, SaysWhichAxisIsUp) {
  write(scenes::gear_pair(kSeconds, 7.75));
  const auto up = [&](Words words) {
    words.insert(words.begin(), {"motion", "case.glb", "--html", "out.html", "--frames", "2", "--quiet"});
    EXPECT_NE(impinge(folder, words, launch).code, 2);
    const std::string page = folder.read("out.html");
    const std::string_view key = "\"up\":\"";
    return page.at(page.find(key) + key.size());
  };
  EXPECT_EQ(up({}), 'y');
  EXPECT_EQ(up({"--up", "z"}), 'z');
  EXPECT_THAT(refused({"--up", "z"}), HasSubstr("--up requires --html"));
}

TEST_F(MotionPage, ItsPosesPutWhatIsDrawnWhereItIs) {
  AnimatedGltf file;
  const int hand = file.node({{"name", "hand"}, {"mesh", 0}, {"translation", {0, 3, 0}}});
  const int arm =
      file.node({{"name", "arm"}, {"mesh", 0}, {"scale", {1, 2, 1}}, {"translation", {9, 0, 0}}, {"children", {hand}}});
  file.roots({arm, file.node({{"name", "still"}, {"mesh", 0}})});
  file.animation("swing");
  const double half = std::sqrt(0.5);
  file.channel(arm, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, half, half});
  file.channel(hand, "rotation", {0, 1}, {0, 0, 0, 1, half, 0, 0, half});
  write(file);
  const Ended ended = impinge(folder, {"motion", "case.glb", "--html", "out.html", "--frames", "4"}, launch);
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  const std::string page = folder.read("out.html");
  const auto block = [&](const std::string& id) {
    const std::string start = "<script type=\"application/json\" id=\"" + id + "\">\n";
    const std::size_t from = page.find(start);
    EXPECT_NE(from, std::string::npos) << id;
    if (from == std::string::npos) return json();
    return json::parse(page.substr(from + start.size(), page.find("</script", from) - from - start.size()));
  };
  const json motion = block("motion"), scene = block("scene");
  ASSERT_TRUE(motion.is_object());
  EXPECT_EQ(motion.at("times"), (json{0, 0.25, 0.5, 0.75, 1}));

  const Result<io::Model> model = io::read(folder.path() / "case.glb");
  ASSERT_TRUE(model);
  const report::Mover mover(*model, model->animations[0]);
  std::vector<std::uint32_t> ids;
  for (const json& object : motion.at("objects")) {
    const auto id = object.at("id").get<std::uint32_t>();
    ids.push_back(id);
    const Mesh& mesh = model->objects[id].mesh;
    const auto poses = object.at("poses").get<std::vector<std::array<double, 12>>>();
    ASSERT_EQ(poses.size(), 5u);
    // What is drawn are the corners about the middle of their box.
    Point lo = mesh.vertices()[0], hi = lo;
    for (const Point& p : mesh.vertices()) {
      lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
      hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
    }
    const Point middle{(lo.x + hi.x) / 2, (lo.y + hi.y) / 2, (lo.z + hi.z) / 2};
    for (std::size_t frame = 0; frame < 5; ++frame) {
      const auto posed = mover.at(0.25 * static_cast<double>(frame));
      ASSERT_TRUE(posed);
      const report::Posed& where = (*posed)[id];
      for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        const Point& p = mesh.vertices()[v];
        const Point& q = where.mesh.vertices()[v];
        for (std::size_t k = 0; k < 3; ++k) {
          const double* const row = &poses[frame][4 * k];
          const double* const r = &where.pose.R[3 * k];
          EXPECT_NEAR(row[0] * (p.x - middle.x) + row[1] * (p.y - middle.y) + row[2] * (p.z - middle.z) + row[3],
                      r[0] * q.x + r[1] * q.y + r[2] * q.z + where.pose.t[k], 1e-9);
        }
      }
    }
  }
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{0, 1})) << "what stands still has no poses";
}

}  // namespace
}  // namespace impinge::test
