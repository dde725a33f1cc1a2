// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Named tests and what changed since an earlier run, on boxes whose verdicts follow from their corners.
#include <map>
#include <set>

#include "meshes.hpp"
#include "program.hpp"
#include "scenes/glb.hpp"
#include "scenes/plant.hpp"

namespace impinge::test {
namespace {

/// "pipe1 beam penetrating" of each pair, by test, with a '!' if it fails.
std::map<std::string, std::set<std::string>> pairs_of(const json& report) {
  std::map<std::string, std::set<std::string>> pairs;
  for (const json& test : report.at("tests")) pairs[test.at("name")];
  for (const json& pair : report.at("pairs")) {
    const std::string test = pair.at("test").is_null() ? "" : pair.at("test").get<std::string>();
    pairs[test].insert(name_in(report, pair, "a") + " " + name_in(report, pair, "b") + " " +
                       pair.at("verdict").get<std::string>() + (pair.at("fails").get<bool>() ? "!" : ""));
  }
  return pairs;
}

using Tests = std::map<std::string, std::set<std::string>>;

/// Two pipes 3 apart that lie on a slab, and a beam through both; the beam and the slab are in a folder of their own.
class NamedTests : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder.path() / "c");
    write_off(folder, {{"pipe1", box({0, 0, 0}, {20, 2, 2})},
                       {"pipe2", box({0, 5, 0}, {20, 7, 2})},
                       {"c/beam", box({4, -1, 1}, {6, 8, 3})},
                       {"c/slab", box({-1, -1, -1}, {21, 8, 0})}});
  }
  [[nodiscard]] Ended clash(const std::string& configuration, const Words& more = {}) const {
    folder.write("c/clash.json", configuration);
    return impinge(folder, joined({"clash", "pipe1.off", "pipe2.off", "--config", "c/clash.json"}, more));
  }
  [[nodiscard]] std::string refused(const std::string& configuration) const {
    folder.write("c/clash.json", configuration);
    return refusal(folder, {"clash", "pipe1.off", "pipe2.off", "--config", "c/clash.json"});
  }
  [[nodiscard]] Tests tests(const std::string& configuration) const {
    folder.write("c/clash.json", configuration);
    return pairs_of(document(folder, {"clash", "pipe1.off", "pipe2.off", "--config", "c/clash.json"}, 1));
  }
  Folder folder;
};

TEST_F(NamedTests, ListWhatTheirModesName) {
  EXPECT_EQ(
      tests(R"({"files":["beam.off","slab.off"],"tests":[
              {"name":"hard","a":"*"},
              {"name":"touch","mode":"contact","a":"pipe*","b":["beam","slab"]},
              {"name":"near","mode":"clearance","clearance":3.5,"a":"pipe*"},
              {"name":"far","mode":"clearance","clearance":3,"a":"pipe*"}]})"),
      (Tests{{"hard", {"pipe1 beam penetrating!", "pipe2 beam penetrating!"}},
             {"touch",
              {"pipe1 beam penetrating!", "pipe2 beam penetrating!", "pipe1 slab touching!", "pipe2 slab touching!"}},
             {"near", {"pipe1 pipe2 apart!"}},
             {"far", {}}}));
  EXPECT_EQ(clash(R"({"tests":[{"name":"far","mode":"clearance","clearance":3,"a":"pipe*"}]})").code, 0);
}

TEST_F(NamedTests, HaveTolerancesOfTheirOwn) {
  // A cube of edge 2, 1/8 deep in the pipe. A quarter of its wall is 1/6, and the pipe's is more.
  folder.write(
      "c/tip.off",
      "OFF\n8 12 0\n8 0 1.875\n10 0 1.875\n8 2 1.875\n10 2 1.875\n8 0 3.875\n10 0 3.875\n8 2 3.875\n10 2 3.875\n"
      "3 0 2 3\n3 0 3 1\n3 4 5 7\n3 4 7 6\n3 0 1 5\n3 0 5 4\n3 2 6 7\n3 2 7 3\n3 0 4 6\n3 0 6 2\n3 1 3 7\n3 1 7 5\n");
  const Tests found = tests(R"({"files":["tip.off"],"tests":[{"name":"exact","a":"tip","b":"pipe1","tolerance":0},
                 {"name":"loose","a":"tip","b":"pipe1","tolerance":0.15},
                 {"name":"loose too","a":"tip","b":"pipe1","tolerance":0.15,"mode":"contact"}]})");
  EXPECT_EQ(found,
            (Tests{{"exact", {"pipe1 tip penetrating!"}}, {"loose", {}}, {"loose too", {"pipe1 tip touching!"}}}));
}

TEST_F(NamedTests, LeaveOutWhatTheRulesName) {
  const auto rules = [&](const std::string& more) {
    return tests(R"({"files":["beam.off","slab.off"],"mode":"contact","tests":[{"name":"t","a":"*")" + more + "}]}")
        .at("t");
  };
  const std::set<std::string> beam{"pipe1 beam penetrating!", "pipe2 beam penetrating!"},
      slab{"pipe1 slab touching!", "pipe2 slab touching!"};
  EXPECT_EQ(rules(R"(,"ignore":{"pairs":[["slab","pipe*"]]})"), beam);
  EXPECT_EQ(rules(R"(,"ignore":{"within":[["beam","pipe?"]]})"), slab);
  EXPECT_EQ(rules(R"(,"b":{"except":"beam"})"),
            (std::set<std::string>{"pipe1 beam penetrating!", "pipe2 beam penetrating!", "pipe1 slab touching!",
                                   "pipe2 slab touching!"}));
  EXPECT_EQ(rules(R"(,"may_touch":[["slab","pipe1"]],"ignore":{"pairs":[["beam","*"]]})"),
            (std::set<std::string>{"pipe1 slab touching", "pipe2 slab touching!"}));
  EXPECT_EQ(rules(R"(,"may_touch":true,"ignore":{"same_file":true})"),
            (std::set<std::string>{"pipe1 beam penetrating!", "pipe2 beam penetrating!", "pipe1 slab touching",
                                   "pipe2 slab touching"}));
}

TEST_F(NamedTests, KnowFilesAndParents) {
  folder.write("two.gltf", gltf({{"left", {0, 0, 0}}, {"right", {1, 1, 1}}}));
  folder.write("other.gltf", gltf({{"left", {1, 0, 0}}}));
  const auto count = [&](const std::string& ignore, const std::string& group) {
    folder.write("p.json", R"({"files":["two.gltf","other.gltf"],"tests":[{"name":"t","a":)" + group +
                               R"(,"ignore":{)" + ignore + "}}]}");
    return document(folder, {"clash", "--config", "p.json"}, 1).at("pairs").size();
  };
  EXPECT_EQ(count("", R"({"file":"*.gltf"})"), 3U);
  EXPECT_EQ(count(R"("same_file":true)", R"({"file":["two.gltf","other.gltf"]})"), 2U);
  EXPECT_EQ(count("", R"({"file":"two.gltf"})"), 1U);
  EXPECT_EQ(count("", R"({"file":"two.gltf","name":"left*"},"b":{"file":"other.gltf"})"), 1U);
}

TEST_F(NamedTests, SayWhatTheyCannotFind) {
  const std::vector<std::pair<std::string, std::string>> mistakes{
      {R"({"tests":[{"name":"n","a":"pip"}]})", "/tests/0/a: nothing is named 'pip'; the nearest name is 'pipe1'"},
      {R"({"tests":[{"name":"n","a":{"file":"pipe3.off"}}]})",
       "/tests/0/a/file: there is no file 'c/pipe3.off'; the nearest name is 'pipe1.off'"},
      {R"({"files":["gone.off"],"tests":[{"name":"n","a":"*"}]})",
       "/files/0: there is no file 'c/gone.off'; the nearest name is 'pipe1.off'"},
      {R"({"tests":[{"name":"n","a":{"file":"*.stl"}}]})", "/tests/0/a/file: no file that is read is '*.stl'"},
      {R"({"tests":[{"name":"n","a":{"name":"pipe*","file":"beam.off"}}]})", "/tests/0/a: no part is in this group"},
      {R"({"groups":{"pipes":"pipe*"},"tests":[{"name":"n","a":{"group":"pipe"}}]})",
       "/tests/0/a/group: no group of this configuration is 'pipe'; the nearest is 'pipes'"},
      {R"({"groups":{"a":{"group":"b"},"b":{"group":"a"}},"tests":[{"name":"n","a":{"group":"a"}}]})",
       "/groups/b/group: the group 'a' is made of itself"},
      {R"({"tests":[{"name":"n","a":"*"}],"groups":{"unused":"pipe1","other":["pipe2","pip"]}})",
       "/groups/other/1: nothing is named 'pip'; the nearest name is 'pipe1'"},
      {R"({"tests":[{"name":"n","a":"*"}],"groups":{"unused":{"name":"pipe*","except":"*"}}})",
       "/groups/unused: no part is in this group"},
      {R"({"tests":[{"name":"n","a":"*"}],"groups":{"a":{"group":"a"}}})",
       "/groups/a/group: the group 'a' is made of itself"},
      {R"({"tests":[{"name":"n","a":"pipe1"}]})",
       "/tests/0/a: only one part is named here, and no part is tested against itself"},
      {R"({"tests":[{"name":"n","a":"*","ignore":{"pairs":[["pipe1","x"]]}}]})",
       "/tests/0/ignore/pairs/0/1: nothing is named 'x'; the nearest name is 'pipe1'"},
  };
  for (const auto& [configuration, said] : mistakes)
    EXPECT_EQ(refused(configuration), "impinge: c/clash.json:1: " + said + "\n") << configuration;
  EXPECT_EQ(impinge(folder, {"clash", "--config", "none.json"}).err,
            "impinge: none.json cannot be read: No such file or directory\n");
  folder.write("own.json", R"({"tests":[{"name":"n","a":"*"}]})");
  EXPECT_EQ(impinge(folder, {"clash", "--config", "own.json", "pipe1.off", "pipe2.off", "--json", "own.json"}).code, 2);
  EXPECT_EQ(folder.read("own.json"), R"({"tests":[{"name":"n","a":"*"}]})");
  EXPECT_EQ(impinge(folder, {"clash", "--config", "own.json"}).err,
            "impinge: no file to read is named, neither in own.json nor after it\n");
  EXPECT_THAT(impinge(folder, {"clash", "--config", "own.json", "pipe1.off", "--fail-on", "contact"}).err,
              HasSubstr("takes new alone"));
}

TEST_F(NamedTests, TakeClashSetsOfIfcClash) {
  folder.write(
      "sets.json",
      R"([{"name":"all","mode":"collision","allow_touching":true,"tolerance":0.01,"clearance":0,"check_all":true,
    "a":[{"file":"pipe1.off"},{"file":"pipe2.off","selector":"pipe?","mode":"i"}],
    "b":[{"file":"c/beam.off"},{"file":"c/slab.off","mode":"a"}]}])");
  EXPECT_EQ(pairs_of(document(folder, {"clash", "--config", "sets.json"}, 1)).at("all"),
            (std::set<std::string>{"pipe1 beam penetrating!", "pipe2 beam penetrating!", "pipe1 slab touching!",
                                   "pipe2 slab touching!"}));
}

TEST_F(NamedTests, AreSummedUpAndGrouped) {
  const std::string configuration = R"({"files":["beam.off","slab.off"],"tests":[{"name":"hard","a":"*"},
                  {"name":"rest","mode":"contact","a":"slab","b":"pipe*","may_touch":true}]})";
  const std::string out = clash(configuration, {"--depth", "none"}).out;
  EXPECT_THAT(out, StartsWith("verdict      part   part  fails  test\n"
                              "penetrating  pipe1  beam  yes    hard\n"
                              "penetrating  pipe2  beam  yes    hard\n"
                              "touching     pipe1  slab  -      rest\n"
                              "touching     pipe2  slab  -      rest\n\n"));
  EXPECT_THAT(out, HasSubstr("hard: penetration of 4 parts against each other, tolerance auto: 2 penetrating; 2 fail.\n"
                             "rest: contact of 1 part against 2 parts, tolerance auto: 2 touching; none fails.\n"
                             "2 pairs fail (by the mode of each test).\n"));
  EXPECT_THAT(clash(configuration, {"--group-by", "part", "--limit", "3"}).out,
              StartsWith("worst        pairs  fail  part\n"
                         "penetrating      2     1  pipe1\n"
                         "penetrating      2     2  beam\n"
                         "penetrating      2     1  pipe2\n(3 of 4 groups"));
  const json groups = json::parse(clash(configuration, {"--group-by", "test", "--json", "-"}).out).at("groups");
  EXPECT_EQ(groups, json::parse(R"({"by":"test","list":[{"a":0,"b":null,"fail":2,"pairs":[0,2]},
                                                        {"a":1,"b":null,"fail":0,"pairs":[1,3]}]})"));
}

TEST(Plant, HasJustWhatWasPlantedInANamedTest) {
  const scenes::Plant plant = scenes::plant(200, {.seed = 3, .turned = 0});
  const Folder folder;
  folder.write("plant.glb", scenes::glb_bytes(plant.scene, plant.names));
  folder.write("clash.json",
               R"({"files":["plant.glb"],"tests":[{"name":"all","mode":"clearance","clearance":20,"a":"*"},
                                                               {"name":"hard","a":{"name":"*"}}]})");
  std::set<std::string> all, hard;
  for (const scenes::PlantPair& pair : plant.pairs) {
    const std::string text =
        plant.names[pair.first] + " " + plant.names[pair.second] + " " + std::string(name(pair.verdict)) + "!";
    // In single precision a distance at the limit may fall on either side.
    if (pair.verdict != Verdict::apart || pair.distance.hi < 19.9) all.insert(text);
    if (pair.verdict <= Verdict::crossing) hard.insert(text);
  }
  const Tests found = pairs_of(document(folder, {"clash", "--quiet", "--config", "clash.json"}, 1));
  EXPECT_EQ(found.at("hard"), hard);
  for (const std::string& pair : all) EXPECT_TRUE(found.at("all").contains(pair)) << pair;
  for (const std::string& pair : found.at("all")) EXPECT_TRUE(pair.ends_with(" apart!") || all.contains(pair)) << pair;
}

/// A bar along x through prongs that are one part.
class Previous : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("bar.off", off(box({-5, 0, 0}, {35, 2, 2})));
    prongs({0, 20});
  }
  void prongs(const std::vector<int>& places) const {
    std::vector<Solid> solids;
    for (const int x : places) solids.push_back(box({x, -4, -4}, {x + 2, 6, 6}));
    folder.write("prongs.off", off(as_one(solids)));
  }
  json run(const Words& more, int code) const {
    return document(folder, joined({"clash", "bar.off", "prongs.off"}, more), code);
  }
  /// The region whose centroid has this x.
  static json& region_at(json& report, double x) {
    for (json& region : report.at("pairs").at(0).at("regions"))
      if (std::abs(region.at("centroid").at(0).get<double>() - x) < 0.5) return region;
    ADD_FAILURE() << "no region at " << x;
    static json none = json::object();
    return none;
  }
  Folder folder;
};

TEST_F(Previous, RegionsPersistAppearAndAreResolved) {
  json first = run({"--regions"}, 1);
  ASSERT_EQ(first.at("pairs").at(0).at("regions").size(), 2U);
  EXPECT_TRUE(first.at("pairs").at(0).at("change").is_null());
  const std::string near = region_at(first, 1).at("id"), far = region_at(first, 21).at("id");
  EXPECT_NE(near, far);
  first.at("pairs").at(0)["status"] = "open";  // which nothing reads
  folder.write("1.json", first.dump(2));

  prongs({1, 10});  // one moves a little, one is gone, one is new
  json second = run({"--previous", "1.json", "--fail-on", "new"}, 1);
  const json& pair = second.at("pairs").at(0);
  expect_members(pair, {{"change", "persisting"},
                        {"was", "penetrating"},
                        {"status", nullptr},
                        {"id", first.at("pairs").at(0).at("id")}});
  expect_members(region_at(second, 2), {{"change", "persisting"}, {"id", near}});
  EXPECT_EQ(region_at(second, 11).at("change"), "new");
  EXPECT_NE(region_at(second, 11).at("id"), far);
  ASSERT_EQ(second.at("resolved").size(), 1U);
  expect_members(second.at("resolved").at(0),
                 {{"region", far}, {"id", pair.at("id")}, {"centroid", region_at(first, 21).at("centroid")}});
  EXPECT_EQ(second.at("resolved").at(0).at("a").at("name"), "bar");
  folder.write("2.json", second.dump());

  json third = run({"--previous", "2.json", "--fail-on", "new,penetration"}, 0);
  EXPECT_EQ(region_at(third, 2).at("id"), near);
  EXPECT_EQ(region_at(third, 11).at("change"), "persisting");
  EXPECT_TRUE(third.at("resolved").empty()) << "it was listed once";
  EXPECT_EQ(third.at("pairs").at(0).at("fails"), false);
  folder.write("3.json", third.dump());

  prongs({1, 10, 20});  // what was gone comes back
  json fourth = run({"--previous", "3.json", "--fail-on", "new"}, 1);
  EXPECT_EQ(region_at(fourth, 21).at("change"), "new");
  EXPECT_TRUE(fourth.at("resolved").empty());
}

TEST_F(Previous, PairsAreResolvedAndComeBack) {
  json first = run({"--regions"}, 1);
  folder.write("1.json", first.dump());
  folder.write("plain.json", run({}, 1).dump());  // without regions
  folder.write("prongs.off", off(box({100, 0, 0}, {102, 2, 2})));
  const json gone = run({"--previous", "1.json", "--fail-on", "new"}, 0);
  ASSERT_EQ(gone.at("resolved").size(), 1U);
  expect_members(gone.at("resolved").at(0), {{"verdict", "penetrating"}, {"region", nullptr}});
  folder.write("2.json", gone.dump());
  EXPECT_TRUE(run({"--previous", "2.json"}, 0).at("resolved").empty()) << "it was listed once";
  EXPECT_EQ(run({"--previous", "plain.json"}, 0).at("resolved").size(), 1U);
  prongs({0, 20});
  json back = run({"--previous", "2.json", "--fail-on", "new"}, 1);
  EXPECT_EQ(back.at("pairs").at(0).at("change"), "new");
  EXPECT_TRUE(back.at("resolved").empty());
  // An earlier run that looked for no regions says nothing about them.
  run({"--previous", "plain.json", "--fail-on", "new"}, 0);
}

TEST_F(Previous, OrderOfFilesChangesNothing) {
  const json first = run({"--regions"}, 1);
  folder.write("1.json", first.dump());
  const json turned = document(folder, {"clash", "prongs.off", "bar.off", "--previous", "1.json"}, 1);
  expect_members(turned.at("pairs").at(0), {{"id", first.at("pairs").at(0).at("id")}, {"change", "persisting"}});
  for (const json& region : turned.at("pairs").at(0).at("regions")) EXPECT_EQ(region.at("change"), "persisting");
  EXPECT_TRUE(turned.at("resolved").empty());
}

TEST_F(Previous, WhatDidNotFailThenIsNew) {
  folder.write("prongs.off", off(box({0, 2, 0}, {2, 4, 2})));
  folder.write("1.json", run({"--regions"}, 0).dump());
  folder.write("prongs.off", off(box({0, 1, 0}, {2, 4, 2})));
  const json worse = run({"--previous", "1.json", "--fail-on", "new"}, 1);
  expect_members(worse.at("pairs").at(0), {{"change", "new"}, {"was", "touching"}});
  // To whom contact was a failure, it has been known.
  folder.write("prongs.off", off(box({0, 2, 0}, {2, 4, 2})));
  run({"--previous", "1.json", "--fail-on", "new,contact"}, 0);
}

TEST_F(Previous, MayBeReplacedByTheNewReport) {
  run({}, 1);
  EXPECT_EQ(impinge(folder, {"clash", "bar.off", "prongs.off", "--json", "r.json"}).code, 1);
  const Ended again = impinge(folder, {"clash", "bar.off", "prongs.off", "--json", "r.json", "--previous", "r.json"});
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.out, HasSubstr("Since r.json: 0 new, 0 with a new region, 1 persisting, 0 resolved.\n"));
}

TEST_F(Previous, ThatIsNoReportIsAnError) {
  json good = run({"--regions"}, 1);
  const auto error = [&](const std::string& text) {
    folder.write("old.json", text);
    return refusal(folder, {"clash", "bar.off", "prongs.off", "--previous", "old.json"});
  };
  const auto changed = [&](auto change) {
    json bad = good;
    change(bad);
    return error(bad.dump());
  };
  EXPECT_THAT(error(good.dump().substr(0, 500)), HasSubstr("old.json:1:"));
  EXPECT_THAT(changed([](json& j) { j["version"] = json::array(); }),
              HasSubstr("/version: a number should stand here"));
  EXPECT_THAT(changed([](json& j) { j["version"] = 2; }), HasSubstr("another version"));
  EXPECT_THAT(changed([](json& j) { j["pairs"][0]["a"] = 9; }), HasSubstr("not among the \"objects\""));
  EXPECT_THAT(changed([](json& j) { j["pairs"][0]["a"] = -1e300; }), HasSubstr("a whole number"));
  EXPECT_THAT(changed([](json& j) { j["pairs"].push_back(j["pairs"][0]); }), HasSubstr("same \"id\""));
  EXPECT_THAT(changed([](json& j) { j["objects"].push_back(j["objects"][0]); }), HasSubstr("same \"id\""));
  EXPECT_THAT(changed([](json& j) { j["pairs"][0]["verdict"] = "bad"; }), HasSubstr("no verdict 'bad'"));
  EXPECT_THAT(changed([](json& j) { j["pairs"][0]["regions"][0].erase("centroid"); }), HasSubstr("no \"centroid\""));
  for (const char* bracket : {"[", "{\"x\":"}) {
    std::string deep = R"({"version":1,"pairs":[],"resolved":)";
    for (int i = 0; i < 200'000; ++i) deep += bracket;
    EXPECT_THAT(error(deep), HasSubstr("old.json:1:"));
  }
  folder.write("old.json", good.dump());
  EXPECT_THAT(impinge(folder, {"clash", "bar.off", "prongs.off", "--previous", "old.json", "--max-file", "1K"}).err,
              HasSubstr("larger than"));
}

}  // namespace
}  // namespace impinge::test
