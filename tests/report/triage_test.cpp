// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What the files for other tools say of tests, changes and decisions.
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bcf_reader.hpp"
#include "models.hpp"
#include "tests/cli/meshes.hpp"
#include "tests/cli/program.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;

/// The JSON of a binary glTF.
json gltf_of(const std::string& bytes) {
  std::uint32_t length = 0;
  std::memcpy(&length, &bytes.at(12), 4);
  return json::parse(bytes.substr(20, length));
}

/// A plate with three pins, of which one goes and one comes.
class TriageFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("plate.off", off(box({0, 0, 0}, {40, 10, 2})));
    pin("p1", 2), pin("p2", 12), pin("p3", 22);
    folder.write("clash.json", R"({"tests":[{"name":"pins & \"plate\"","a":"plate","b":"p*"}]})");
  }
  void pin(const std::string& name, int x) const { folder.write(name + ".off", off(box({x, 3, 1}, {x + 2, 5, 6}))); }
  json run(const std::vector<std::string>& pins, std::vector<std::string> more) const {
    std::vector<std::string> words{"clash",   "--config", "clash.json", "plate.off", "--json",  "out.json", "--csv",
                                   "out.csv", "--bcf",    "out.bcf",    "--gltf",    "out.glb", "--quiet"};
    for (const std::string& name : pins) words.push_back(name + ".off");
    words.insert(words.end(), more.begin(), more.end());
    Launch launch;
    launch.environment["SOURCE_DATE_EPOCH"] = "0";
    const Ended ended = impinge(folder, words, launch);
    EXPECT_EQ(ended.code, 1) << ended.err;
    return json::parse(folder.read("out.json"));
  }
  static json& pair_of(json& report, const std::string& name) {
    for (json& pair : report.at("pairs"))
      for (const char* side : {"a", "b"})
        if (name_in(report, pair, side) == name) return pair;
    throw std::runtime_error("no pair of " + name);
  }
  json again(std::vector<std::string> more) const {
    more.insert(more.end(), {"--previous", "last.json", "--decisions", "decisions.json"});
    return run({"p2", "p3", "p4"}, more);
  }
  /// The second run, in which p1 has gone and p4 has come, with a decision about p2.
  json second() const {
    json first = run({"p1", "p2", "p3"}, {});
    folder.write("last.json", first.dump());
    const json decision{
        {"status", "in \"review\"\n<b>"}, {"comment", "two\nlines & \x1b[2J"}, {"assignee", "Ann <a@b.c>"}};
    folder.write("decisions.json", json{{pair_of(first, "p2").at("id"), decision}}.dump());
    pin("p4", 32);
    return again({});
  }
  Folder folder;
};

TEST_F(TriageFiles, CsvHasTestChangeStatusAndComment) {
  json report = second();
  const std::vector<Row> rows = rows_of(folder.read("out.csv"));
  ASSERT_EQ(rows.size(), 4U);
  std::map<std::string, Row> by_id;
  for (const Row& row : rows) {
    EXPECT_EQ(row.at("test"), "pins & \"plate\"");
    by_id[row.at("id")] = row;
  }
  const Row& kept = by_id.at(pair_of(report, "p2").at("id"));
  EXPECT_EQ(kept.at("change"), "persisting");
  EXPECT_EQ(kept.at("was"), "penetrating");
  EXPECT_EQ(kept.at("new_regions"), "0");
  EXPECT_EQ(kept.at("status"), "in \"review\"\\n<b>");
  EXPECT_EQ(kept.at("comment"), "two\\nlines & \\x1b[2J");
  EXPECT_EQ(kept.at("assignee"), "Ann <a@b.c>");
  const Row& fresh = by_id.at(pair_of(report, "p4").at("id"));
  EXPECT_EQ(fresh.at("change"), "new");
  EXPECT_EQ(fresh.at("was"), "");
  EXPECT_EQ(fresh.at("new_regions"), "1");
  EXPECT_EQ(fresh.at("status"), "");
  const Row& gone = rows.back();
  EXPECT_EQ(gone.at("change"), "resolved");
  EXPECT_EQ(gone.at("id"), report.at("resolved").at(0).at("id"));
  EXPECT_EQ(gone.at("rank"), "");
  EXPECT_EQ(gone.at("fails"), "false");
  EXPECT_EQ(gone.at("verdict"), "penetrating");
  EXPECT_EQ(gone.at("a"), "plate");
  EXPECT_EQ(gone.at("b_file"), "p1.off");
  EXPECT_EQ(gone.at("x"), "3");
  EXPECT_EQ(gone.at("region"), "");
}

TEST_F(TriageFiles, CsvOfARunWithoutTriageLeavesItsCellsEmpty) {
  EXPECT_EQ(impinge(folder, {"clash", "plate.off", "p1.off", "--csv", "out.csv"}).code, 1);
  const std::vector<Row> rows = rows_of(folder.read("out.csv"));
  ASSERT_EQ(rows.size(), 1U);
  for (const char* column : {"test", "change", "was", "new_regions", "region", "status", "comment", "assignee"})
    EXPECT_EQ(rows[0].at(column), "") << column;
}

TEST_F(TriageFiles, BcfHasStatusLabelsAndComments) {
  json report = second();
  std::map<std::string, Topic> topics;
  std::set<std::string> guids;
  for (Topic& topic : read_bcf(folder.read("out.bcf"))) {
    EXPECT_TRUE(guids.insert(topic.guid).second);
    for (const pugi::xml_node& node : topic.markup.document_element().children())
      if (std::string(node.name()) != "Topic" && std::string(node.name()) != "Header") {
        EXPECT_TRUE(guids.insert(node.attribute("Guid").value()).second) << node.name();
      }
    topics[topic.guid] = std::move(topic);
  }
  ASSERT_EQ(topics.size(), 3U);
  const Topic& kept = topics.at(pair_of(report, "p2").at("id"));
  EXPECT_EQ(std::string(kept.topic().attribute("TopicStatus").value()), "in \"review\"\\n<b>");
  EXPECT_EQ(texts(kept.topic(), "AssignedTo"), std::vector<std::string>{"Ann <a@b.c>"});
  EXPECT_EQ(texts(kept.topic(), "Labels"), (std::vector<std::string>{"penetrating", "pins & \"plate\"", "persisting"}));
  const std::string description = kept.text("Description");
  EXPECT_NE(description.find("\nTest: pins & \"plate\"\nSince the earlier run: persisting\n"), std::string::npos)
      << description;
  std::vector<std::string> said;
  for (const pugi::xml_node& comment : kept.markup.document_element().children("Comment")) {
    said.emplace_back(comment.child("Comment").text().get());
    EXPECT_EQ(std::string(comment.child("Date").text().get()), "1970-01-01T00:00:00Z");
    EXPECT_EQ(std::string(comment.child("Author").text().get()), "impinge");
    EXPECT_EQ(std::string(comment.child("Viewpoint").attribute("Guid").value()), kept.view().attribute("Guid").value());
  }
  EXPECT_EQ(said, std::vector<std::string>{"two\nlines & \\x1b[2J"});
  const Topic& fresh = topics.at(pair_of(report, "p4").at("id"));
  EXPECT_EQ(std::string(fresh.topic().attribute("TopicStatus").value()), "Open");
  EXPECT_EQ(texts(fresh.topic(), "Labels"), (std::vector<std::string>{"penetrating", "pins & \"plate\"", "new"}));
  EXPECT_FALSE(fresh.markup.document_element().child("Comment"));
}

TEST_F(TriageFiles, AreTheSameBytesEachTime) {
  second();
  std::map<std::string, std::string> first;
  for (const char* name : {"out.csv", "out.bcf", "out.glb"}) first[name] = folder.read(name);
  again({"--threads", "1"});
  for (const auto& [name, bytes] : first) EXPECT_TRUE(folder.read(name) == bytes) << name;
  again({"--date", "2024-05-31"});
  for (const Topic& topic : read_bcf(folder.read("out.bcf")))
    for (const pugi::xml_node& comment : topic.markup.document_element().children("Comment"))
      EXPECT_EQ(std::string(comment.child("Date").text().get()), "2024-05-31T00:00:00Z");
}

TEST_F(TriageFiles, GltfHasTheJsonsWords) {
  json report = second();
  std::size_t pairs = 0, regions = 0;
  const json document = gltf_of(folder.read("out.glb"));
  for (const json& node : document.at("nodes")) {
    if (!node.contains("extras") || !node.at("extras").contains("verdict")) continue;
    ++pairs;
    const json& extras = node.at("extras");
    for (const json& pair : report.at("pairs")) {
      if (pair.at("id") != extras.at("id")) continue;
      for (const char* key : {"test", "change", "status", "comment", "assignee", "was"})
        EXPECT_EQ(extras.at(key), pair.at(key)) << key;
      for (std::size_t i = 0; i < pair.at("regions").size(); ++i, ++regions) {
        const json& child = document.at("nodes").at(node.at("children").at(i).get<std::size_t>());
        for (const char* key : {"id", "change"})
          EXPECT_EQ(child.at("extras").at(key), pair.at("regions").at(i).at(key)) << key;
      }
    }
  }
  EXPECT_EQ(pairs, 3U);
  EXPECT_EQ(regions, 3U);
}

TEST_F(TriageFiles, FollowIfcProductsByGlobalIdAndElseByShapeAndPlace) {
  const auto replaced = [](std::string text, const std::vector<std::pair<std::string, std::string>>& words) {
    for (const auto& [from, to] : words) text.replace(text.find(from), from.size(), to);
    return text;
  };
  std::string decisions = "{}";
  const auto next = [&](const std::string& text) {
    folder.write("two.ifc", text);
    folder.write("decisions.json", decisions);
    const Ended run = impinge(folder, {"clash", "two.ifc", "--previous", "last.json", "--json", "last.json",
                                       "--decisions", "decisions.json", "--quiet"});
    EXPECT_EQ(run.code, 1) << run.err;
    return json::parse(folder.read("last.json")).at("pairs").at(0);
  };
  const std::string first = ifc_of_two_walls();
  folder.write("two.ifc", first);
  ASSERT_EQ(impinge(folder, {"clash", "two.ifc", "--json", "last.json", "--regions", "--quiet"}).code, 1);
  const std::string id = json::parse(folder.read("last.json")).at("pairs").at(0).at("id");
  decisions = json{{id, {{"status", "agreed"}}}}.dump();
  const std::string left = "1srAI$R4T8ihLXSNHmUSET", right = "2O2Fr$t4X7Zf8NOew3FNr2";
  const std::string other_left = "3$$$$$$$$$$$$$$$$$$$$A", other_right = "3$$$$$$$$$$$$$$$$$$$$B";
  const std::string renamed = replaced(first, {{"'left'", "'A'"}, {"'right'", "'B'"}, {"(5000.,", "(5001.,"}});
  const std::string anew = replaced(renamed, {{left, other_left}, {right, other_right}, {"'A'", "'C'"}});
  for (const auto& text : {renamed, anew, replaced(anew, {{"(5001.,", "(5002.,"}})}) {
    const json pair = next(text);
    EXPECT_EQ(pair.at("change"), "persisting");
    EXPECT_EQ(pair.at("id"), id);
    EXPECT_EQ(pair.at("status"), "agreed");
  }
  // Another GlobalId in another place is another product.
  const json other = next(replaced(anew, {{"(5001.,", "(5003.,"}, {other_left, "3$$$$$$$$$$$$$$$$$$$$C"}}));
  EXPECT_EQ(other.at("change"), "new");
  EXPECT_TRUE(other.at("status").is_null());
}

TEST_F(TriageFiles, TopicsOfFilesOfOneNameAreTopicsOfTheirOwn) {
  for (const char* side : {"l", "r"}) {
    std::filesystem::create_directory(folder.path() / side);
    const int x = *side == 'l' ? 2 : 12;
    folder.write(std::string(side) + "/pin.off", off(box({x, 3, 1}, {x + 2, 5, 6})));
  }
  EXPECT_EQ(impinge(folder, {"clash", "l/pin.off", "r/pin.off", "plate.off", "--bcf", "out.bcf", "--quiet"}).code, 1);
  std::set<std::string> ids, systems;
  for (const Topic& topic : read_bcf(folder.read("out.bcf"))) {
    ids.insert(topic.guid);
    systems.insert(
        topic.view().child("Components").child("Selection").child("Component").child("OriginatingSystem").text().get());
  }
  EXPECT_EQ(ids.size(), 2U);
  EXPECT_EQ(systems, (std::set<std::string>{"l/pin.off", "r/pin.off"}));
}

}  // namespace
}  // namespace impinge::test
