// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// The document of --json: its shape, and where it goes.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;

class JsonDocument : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("a.off", off(cube(0, 0, 0)));
    folder.write("b.off", off(cube(2, 0, 0)));
  }
  Ended check(std::vector<std::string> more) const {
    return impinge(folder, joined({"check", "a.off", "b.off"}, more));
  }
  Folder folder;
};

TEST_F(JsonDocument, HasExactlyTheKeysOfTheSchema) {
  const json answer = json::parse(check({"--json", "-"}).out);
  EXPECT_EQ(keys(answer), "hash objects pairs stats truncated unit version");
  EXPECT_EQ(answer.at("version"), 1);
  EXPECT_EQ(answer.at("truncated"), false);
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
      "border_move_seconds border_moves bounds_update_seconds bounds_updated box_test_seconds box_tests "
      "broad_seconds cpu_seconds device_predicted_seconds device_seconds device_wait_seconds "
      "element_test_seconds element_tests exact_call_seconds exact_calls exact_seconds hierarchy_seconds "
      "images_drawn images_overlapped images_read "
      "leaf_pair_seconds leaf_pairs measured_seconds narrow_seconds node_seconds nodes_built object_pair_seconds "
      "object_pairs "
      "partition_seconds predicted_seconds results_seconds sorted_triangle_seconds sphere_test_seconds sphere_tests "
      "total_seconds triangle_pairs triangles_sorted");
  for (const auto& item : answer.at("stats").items()) EXPECT_TRUE(item.value().is_number()) << item.key();
}

TEST_F(JsonDocument, IsTheOnlyThingOnStandardOutput) {
  const Ended run = check({"--json", "-", "--stats"});
  EXPECT_EQ(run.err, "");
  const json answer = json::parse(run.out);
  EXPECT_GT(answer.at("stats").at("predicted_seconds"), 0.0);
}

TEST_F(JsonDocument, GoesToAFileBesideTheTable) {
  const Ended run = check({"--json", "out.json"});
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.out.find("1 pair of objects touch"), std::string::npos);
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
  const Ended lost = check({"--json", "lost.json"});
  EXPECT_EQ(lost.code, 2);
  EXPECT_NE(lost.err.find("'lost.json': cannot create files in"), std::string::npos) << lost.err;
  std::filesystem::create_symlink("round.json", folder.path() / "about.json");
  std::filesystem::create_symlink("about.json", folder.path() / "round.json");
  const Ended round = check({"--json", "round.json"});
  EXPECT_EQ(round.code, 2);
  EXPECT_NE(round.err.find("cannot write to 'round.json': Too many levels of symbolic links"), std::string::npos)
      << round.err;
  for (const char* link : {"lost.json", "about.json", "round.json"}) {
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / link)) << link;
  }
}

TEST_F(JsonDocument, NeverReplacesAMeshByMistake) {
  const std::string before = folder.read("b.off");
  // The user forgot the name of the JSON file.
  const Ended forgot = impinge(folder, {"check", "--json", "b.off", "a.off"});
  EXPECT_EQ(forgot.code, 2);
  EXPECT_NE(forgot.err.find("exists and does not end in .json, so it is not replaced"), std::string::npos)
      << forgot.err;
  const Ended input = check({"--json", "./b.off"});
  EXPECT_EQ(input.code, 2);
  EXPECT_NE(input.err.find("one of the files to read"), std::string::npos) << input.err;
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

}  // namespace
}  // namespace impinge::test
