// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// The document of --json: its shape, and where it goes.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

class JsonDocument : public testing::Test {
 protected:
  void SetUp() override { write_off(folder, {{"a", cube(0, 0, 0)}, {"b", cube(2, 0, 0)}}); }
  Ended check(const Words& more) const { return impinge(folder, joined({"check", "a.off", "b.off"}, more)); }
  std::string refused(const Words& more) const { return refusal(folder, joined({"check", "a.off", "b.off"}, more)); }
  Folder folder;
};

TEST_F(JsonDocument, HasExactlyTheKeysOfTheSchema) {
  const json answer = document(folder, {"check", "a.off", "b.off"}, 1);
  EXPECT_EQ(keys(answer), "hash objects pairs stats truncated unit version");
  expect_members(answer, {{"version", 1}, {"truncated", false}});
  const std::string hash = answer.at("hash");
  EXPECT_EQ(hash.size(), 16U);
  EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
  ASSERT_EQ(answer.at("objects").size(), 2U);
  json object = json::parse(R"({"id":1,"name":"b","product":"","file":"b.off","triangles":12,"incomplete":null,
    "properties":{}})");
  object["path"] = answer.at("objects").at(1).at("path");
  EXPECT_EQ(answer.at("objects").at(1), object);
  EXPECT_TRUE(answer.at("objects").at(1).at("path").is_string());
  EXPECT_EQ(answer.at("pairs"),
            (json::array({{{"a", 0}, {"b", 1}, {"crossing", 0}, {"touching", 46}, {"coplanar", 16}}})));
  EXPECT_EQ(
      keys(answer.at("stats")),
      "border_move_seconds border_moves bounds_update_seconds bounds_updated box_test_seconds box_tests broad_seconds "
      "cpu_seconds device_predicted_seconds device_seconds device_wait_seconds element_test_seconds element_tests "
      "exact_call_seconds exact_calls exact_seconds hierarchy_seconds images_drawn images_overlapped images_read "
      "leaf_pair_seconds leaf_pairs measured_seconds narrow_seconds node_seconds nodes_built object_pair_seconds "
      "object_pairs partition_seconds predicted_seconds results_seconds sorted_triangle_seconds sphere_test_seconds "
      "sphere_tests total_seconds triangle_pairs triangles_sorted");
  for (const auto& item : answer.at("stats").items()) EXPECT_TRUE(item.value().is_number()) << item.key();
}

TEST_F(JsonDocument, IsTheOnlyThingOnStandardOutput) {
  EXPECT_GT(document(folder, {"check", "a.off", "b.off", "--stats"}, 1).at("stats").at("predicted_seconds"), 0.0);
}

TEST_F(JsonDocument, GoesToAFileBesideTheTable) {
  const Ended run = check({"--json", "out.json"});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.out, HasSubstr("1 pair of objects touch"));
  EXPECT_EQ(json::parse(folder.read("out.json")).at("pairs").size(), 1U);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.off", "b.off", "out.json"}));
}

TEST_F(JsonDocument, QuietSilencesTheTableNotTheDocument) {
  const Ended run = check({"--json", "out.json", "--quiet"});
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "");
  EXPECT_TRUE(json::accept(folder.read("out.json")));
  EXPECT_TRUE(json::accept(check({"--json", "-", "--quiet"}).out));
}

TEST_F(JsonDocument, ReplacesAnEarlierOneAndKeepsItsModeAndLinks) {
  folder.write("real.json", R"({"version":1,"objects":[],"pairs":[]})");
  ::chmod((folder.path() / "real.json").c_str(), 0640);
  std::filesystem::create_symlink("real.json", folder.path() / "link.json");
  EXPECT_EQ(check({"--json", "link.json"}).code, 1);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.json"));
  EXPECT_TRUE(json::parse(folder.read("real.json")).contains("pairs"));
  struct stat about {};
  ASSERT_EQ(::stat((folder.path() / "real.json").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 07777U, 0640U);
}

TEST_F(JsonDocument, GoesWhereALinkPointsThoughNothingIsThere) {
  std::filesystem::create_directory(folder.path() / "sub");
  std::filesystem::create_symlink("second.json", folder.path() / "first.json");
  std::filesystem::create_symlink("sub/new.json", folder.path() / "second.json");
  EXPECT_EQ(check({"--json", "first.json"}).code, 1);
  EXPECT_EQ(std::filesystem::read_symlink(folder.path() / "first.json"), "second.json");
  EXPECT_EQ(std::filesystem::read_symlink(folder.path() / "second.json"), "sub/new.json");
  EXPECT_TRUE(json::parse(folder.read("sub/new.json")).contains("pairs"));
  // Absolute ones too.
  std::filesystem::create_symlink(folder.path() / "sub" / "other.json", folder.path() / "third.json");
  EXPECT_EQ(check({"--json", "third.json"}).code, 1);
  EXPECT_TRUE(json::accept(folder.read("sub/other.json")));
  std::filesystem::create_symlink("missing/new.json", folder.path() / "lost.json");
  EXPECT_THAT(refused({"--json", "lost.json"}), HasSubstr("'lost.json': cannot create files in"));
  std::filesystem::create_symlink("round.json", folder.path() / "about.json");
  std::filesystem::create_symlink("about.json", folder.path() / "round.json");
  EXPECT_THAT(refused({"--json", "round.json"}),
              HasSubstr("cannot write to 'round.json': Too many levels of symbolic links"));
  for (const char* link : {"lost.json", "about.json", "round.json"})
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / link)) << link;
}

TEST_F(JsonDocument, NeverReplacesAMeshByMistake) {
  const std::string before = folder.read("b.off");
  // The user forgot the name of the JSON file.
  EXPECT_THAT(refusal(folder, {"check", "--json", "b.off", "a.off"}),
              HasSubstr("exists and does not end in .json, so it is not replaced"));
  EXPECT_THAT(refused({"--json", "./b.off"}), HasSubstr("one of the files to read"));
  EXPECT_EQ(impinge(folder, {"check", "--json=", "b.off", "a.off"}).code, 2);
  EXPECT_EQ(impinge(folder, {"info", "a.off", "--json", "b.off"}).code, 2);
  EXPECT_EQ(folder.read("b.off"), before);
}

TEST_F(JsonDocument, AnErrorLeavesTheOldOneAlone) {
  const std::string old = R"({"version":1,"objects":[],"pairs":[]})";
  folder.write("out.json", old);
  EXPECT_EQ(check({"missing.off", "--json", "out.json"}).code, 2);
  EXPECT_EQ(folder.read("out.json"), old);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.off", "b.off", "out.json"}));
}

TEST_F(JsonDocument, ReplacesBytesThatAreNotUtf8AndEscapesTheRest) {
  const std::string name = "\x1b[31m\"q\"\n\xff\xc3\xa4\xed\xa0\x80";
  folder.write(name + ".off", off(cube(0, 2, 0)));
  const Ended run = check({name + ".off", "--json", "-"});
  EXPECT_EQ(run.code, 1) << run.err;
  EXPECT_EQ(run.out.find('\x1b'), std::string::npos);
  const json answer = json::parse(run.out);
  // One U+FFFD for each byte that is part of no character; the surrogate has three.
  EXPECT_EQ(answer.at("objects").at(2).at("name"),
            "\x1b[31m\"q\"\n\xEF\xBF\xBD\xc3\xa4\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST_F(JsonDocument, StreamsAMillionPairs) {
  const int triangles = 1000;
  folder.write("p.off", off_fan(triangles, 0));
  folder.write("q.off", off_fan(triangles, 0.5));
  const Ended run = impinge(folder, {"check", "p.off", "q.off", "--json", "out.json", "--triangles", "--quiet"});
  EXPECT_EQ(run.code, 1) << run.err;
  int entries = 0;
  const auto count = [&](int depth, json::parse_event_t event, json&) {
    // Objects and arrays of the document: depth 4 is one entry of "triangles".
    if (event == json::parse_event_t::array_end && depth == 4) ++entries;
    return event != json::parse_event_t::array_end || depth != 4;
  };
  const json answer = json::parse(folder.read("out.json"), count);
  // All triangles have the origin in common.
  EXPECT_EQ(entries, triangles * triangles);
  const json& pair = answer.at("pairs").at(0);
  EXPECT_EQ(pair.at("crossing").get<int>() + pair.at("touching").get<int>() + pair.at("coplanar").get<int>(),
            triangles * triangles);
}

// The document of `impinge clash --json`.

class ClashDocument : public testing::Test {
 protected:
  void SetUp() override {
    write_off(folder, {{"a", box({0, 0, 0}, {2, 2, 2})},
                       {"b", box({1, 1, 1}, {3, 3, 3})},  // penetrates a
                       {"big", box({20, 0, 0}, {26, 6, 6})},
                       {"small", box({22, 2, 2}, {24, 4, 4})},   // inside big
                       {"sheet", sheet({29, 0}, {33, 3}, 1)}});  // 3 from big
  }
  [[nodiscard]] json clash(const Words& more) const {
    return document(folder, joined({"clash", "a.off", "b.off", "big.off", "small.off", "sheet.off"}, more), 1);
  }
  Folder folder;
};

TEST_F(ClashDocument, HasExactlyTheKeysOfTheSchema) {
  const json answer = clash({});
  EXPECT_EQ(keys(answer), "counts decisions files groups objects pairs resolved settings tests types unit version");
  expect_members(answer, json::parse(R"({"version":1,"tests":[],"resolved":[],"groups":null,"settings":
    {"tolerance":"auto","clearance":0,"depth_precision":0.05,"regions":false,"volumes":false,
    "fail_on":["penetration","inside"],"ignore":[],"between":null,"within_products":false,"scale":[],"config":null,
    "previous":null,"decisions":null}})"));
  EXPECT_EQ(answer.at("types").at(4), (json{{"name", "sheet"}, {"parts", 1}}));
  EXPECT_EQ(answer.at("objects").at(4).at("type"), 4);
  ASSERT_EQ(answer.at("objects").size(), 5U);
  for (const json& object : answer.at("objects"))
    EXPECT_EQ(
        keys(object),
        "area class closed file first_open_edge first_self_crossing first_unclear_edge id incomplete inner_radius key "
        "known_as name open_edges path pieces placed product properties self_crossings triangles turned type "
        "unclear_edges volume");
  // Triangles are counted as `check` counts them.
  const json count = document(folder, {"check", "a.off", "b.off", "--backend", "paper"}, 1).at("pairs").at(0);
  json first = answer.at("pairs").at(0);
  EXPECT_TRUE(std::regex_match(first.at("id").get<std::string>(),
                               std::regex("[0-9a-f]{8}-[0-9a-f]{4}-5[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}")));
  EXPECT_NE(first.at("id"), answer.at("pairs").at(1).at("id"));
  first.erase("id");
  EXPECT_EQ(keys(first.at("overlap_depth")), "a_in_b b_in_a");
  EXPECT_TRUE(first.at("fails_below").is_null());  // a corner of each is the middle of the other
  EXPECT_NEAR(first.at("tolerance").get<double>(), 0x1p-20 * 4 * std::sqrt(3), 0x1p-30);  // of two cubes of 2
  first.erase("overlap_depth"), first.erase("fails_below"), first.erase("tolerance");
  json expected = json::parse(R"({"test":null,"change":null,"status":null,"comment":null,"assignee":null,"due":null,
    "was":null,"a":0,"b":1,"verdict":"penetrating","inner":null,"note":null,"incomplete":null,"axes":null,"fails":true})");
  for (const char* const key : {"crossing", "touching", "coplanar"}) expected[key] = count.at(key);
  EXPECT_EQ(first, expected);
  expect_members(answer.at("pairs").at(1), {{"verdict", "inside"}, {"inner", 3}});
  EXPECT_EQ(answer.at("pairs").size(), 2U);
  json counts = answer.at("counts");
  EXPECT_GE(counts.at("candidates"), 2);
  counts.erase("candidates");
  EXPECT_EQ(counts, json::parse(R"({"duplicate":0,"inside":1,"penetrating":1,"crossing":0,"touching":0,"apart":0,
    "fail":2})"));
}

TEST_F(ClashDocument, TellsOfEachPartWhatItIs) {
  const json objects = clash({}).at("objects");
  const json& solid = objects.at(2);
  expect_members(solid, {{"name", "big"}, {"class", "solid"}, {"open_edges", 0}, {"first_open_edge", nullptr}});
  EXPECT_NEAR(solid.at("volume"), 216, 1e-9);
  EXPECT_NEAR(solid.at("area"), 216, 1e-9);
  EXPECT_NEAR(solid.at("inner_radius"), 3, 0.15);
  const json& surface = objects.at(4);
  expect_members(surface, json::parse(R"({"class":"surface","closed":false,"open_edges":4,"self_crossings":0,
    "volume":null,"inner_radius":null})"));
  EXPECT_NEAR(surface.at("area"), 12, 1e-9);
  // Which edge is the first is open; it is a side of the rectangle.
  json edge = surface.at("first_open_edge");
  ASSERT_EQ(edge.size(), 2U);
  EXPECT_TRUE((edge[0][0] == edge[1][0]) != (edge[0][1] == edge[1][1])) << edge;
  for (const json& end : edge) {
    EXPECT_TRUE(end[0] == 29.0 || end[0] == 33.0) << edge;
    EXPECT_TRUE(end[1] == 0.0 || end[1] == 3.0) << edge;
    EXPECT_EQ(end[2], 1.0) << edge;
  }
}

TEST_F(ClashDocument, HoldsTheMeasuresThatAreAskedFor) {
  const json answer =
      clash({"--depth", "0.01", "--clearance", "3.5", "--regions", "--tolerance", "0.25", "--fail-on", "clearance"});
  expect_members(answer.at("settings"), json::parse(R"({"tolerance":0.25,"clearance":3.5,"fail_on":["clearance"]})"));
  ASSERT_EQ(answer.at("pairs").size(), 3U);

  const json& penetrating = answer.at("pairs").at(0);
  expect_members(penetrating, {{"fails", false}, {"distance", nullptr}, {"nearest", nullptr}});
  const json& depth = penetrating.at("overlap_depth");
  for (const char* side : {"a_in_b", "b_in_a"}) {
    EXPECT_LE(depth.at(side).at(0), 1.0);
    EXPECT_GE(depth.at(side).at(1), 1.0);
    EXPECT_LE(depth.at(side).at(1).get<double>() - depth.at(side).at(0).get<double>(), 0.011);
  }
  ASSERT_EQ(penetrating.at("regions").size(), 1U);
  const json& region = penetrating.at("regions").at(0);
  EXPECT_EQ(keys(region), "area box centroid change id length lines normal pairs triangles_a triangles_b");
  EXPECT_EQ(region.at("box"), (json{{1.0, 1.0, 1.0}, {2.0, 2.0, 2.0}}));
  EXPECT_EQ(region.at("centroid").size(), 3U);
  EXPECT_EQ(region.at("normal").size(), 3U);
  EXPECT_GT(region.at("pairs"), 0);
  for (const json& line : region.at("lines"))
    for (const json& point : line) EXPECT_EQ(point.size(), 3U);
  for (const char* side : {"triangles_a", "triangles_b"}) {
    EXPECT_FALSE(region.at(side).empty());
    EXPECT_TRUE(std::is_sorted(region.at(side).begin(), region.at(side).end()));
  }

  const json& inside = answer.at("pairs").at(1);
  EXPECT_TRUE(inside.at("regions").empty());
  EXPECT_GE(inside.at("overlap_depth").at("b_in_a").at(1), 2.0);

  const json& apart = answer.at("pairs").at(2);
  expect_members(apart, {{"verdict", "apart"}, {"fails", true}, {"overlap_depth", nullptr}});
  const double error = apart.at("distance_error");
  EXPECT_GE(error, 0);
  EXPECT_LE(error, 1e-12);
  EXPECT_NEAR(apart.at("distance"), 3.0, error);
  const json& nearest = apart.at("nearest");
  EXPECT_EQ(nearest.at(0).at(0), 26.0);
  EXPECT_EQ(nearest.at(1).at(0), 29.0);
}

TEST_F(ClashDocument, EchoesSettingsWithOddNames) {
  const std::string name = "\x1b\"q\"\n\xff";
  folder.write(name + ".off", off(box({0, 0, 8}, {2, 2, 9})));
  const Words words{"clash", "a.off",   name + ".off", "--ignore",         name,
                    "a",     "--scale", "a.off=0.5",   "--within-products"};
  const json answer = document(folder, words, 0);
  EXPECT_EQ(impinge(folder, joined(words, {"--json", "-"})).out.find('\x1b'), std::string::npos);
  const std::string shown = "\x1b\"q\"\n\xEF\xBF\xBD";
  expect_members(answer.at("settings"), {{"ignore", json::array({json::array({shown, "a"})})},
                                         {"scale", json::array({json::array({"a.off", 0.5})})},
                                         {"within_products", true}});
  EXPECT_EQ(answer.at("objects").at(1).at("name"), shown);
  EXPECT_TRUE(answer.at("pairs").empty());
}

}  // namespace
}  // namespace impinge::test
