// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What people decided about pairs, read from a file of theirs.
#include "report/decisions.hpp"

#include <map>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

/// Two pipes through a beam.
class DecisionsFile : public testing::Test {
 protected:
  void SetUp() override {
    write_off(folder, {{"pipe1", box({0, 0, 0}, {20, 2, 2})},
                       {"pipe2", box({0, 5, 0}, {20, 7, 2})},
                       {"beam", box({4, -1, 1}, {6, 8, 3})}});
  }
  Ended run(const std::string& decisions) const {
    folder.write("d.json", decisions);
    Ended ended =
        impinge(folder, {"clash", "pipe1.off", "pipe2.off", "beam.off", "--decisions", "d.json", "--json", "out.json"});
    EXPECT_EQ(folder.read("d.json"), decisions);
    return ended;
  }
  /// The statuses of both pairs, by the name of the pipe.
  std::map<std::string, std::string> statuses(const std::string& decisions) const {
    EXPECT_EQ(run(decisions).code, 1);
    std::map<std::string, std::string> found;
    const json report = json::parse(folder.read("out.json"));
    for (const json& pair : report.at("pairs"))
      found[name_in(report, pair, "a")] = pair.at("status").is_null() ? "none" : pair.at("status").get<std::string>();
    return found;
  }
  Folder folder;
};

using Statuses = std::map<std::string, std::string>;

TEST_F(DecisionsFile, OfIdsCountBeforeThoseOfNamesAndOfTheseTheFirst) {
  EXPECT_EQ(statuses("{}"), (Statuses{{"pipe1", "none"}, {"pipe2", "none"}}));
  const json report = json::parse(folder.read("out.json"));
  const std::string id = report.at("pairs").at(0).at("id"), pipe = "pipe1";
  ASSERT_EQ(name_in(report, report.at("pairs").at(0), "a"), pipe);
  EXPECT_EQ(statuses(R"({"pipe* | beam":{"status":"names"},")" + id + R"(":{"status":"id","comment":"c"}})"),
            (Statuses{{"pipe1", "id"}, {"pipe2", "names"}}));
  EXPECT_EQ(json::parse(folder.read("out.json")).at("pairs").at(0).at("comment"), "c");
  EXPECT_EQ(json::parse(folder.read("out.json")).at("settings").at("decisions"), "d.json");
  // Keys are in no alphabetical order, and parts in either.
  EXPECT_EQ(statuses(R"({"beam | pipe2":{"status":"first"},"* | *":{"status":"second"}})"),
            (Statuses{{"pipe1", "second"}, {"pipe2", "first"}}));
  EXPECT_EQ(statuses(R"({"pipe? | b*":{"status":"all"},"beam | pipe2":{"status":"late"}})"),
            (Statuses{{"pipe1", "all"}, {"pipe2", "all"}}));
  EXPECT_EQ(statuses(R"({"pipe1 | pipe2":{"status":"x"},"beam | beam":{"status":"x"}})"),
            (Statuses{{"pipe1", "none"}, {"pipe2", "none"}}));
}

TEST_F(DecisionsFile, KeysThatMatchNoPairAreNamed) {
  const std::string id = "01234567-89ab-5cde-8f01-23456789abcd";
  const std::string text = R"({"$schema":"decisions.schema.json","pipe* | beam":{},"pipe* | wall":{"status":"ok"},")" +
                           id + R"(":{"comment":"gone","assignee":"Ann"}})";
  const Ended ended = run(text);
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.err, "impinge: d.json: no pair of this run is '" + id +
                           "'; if that clash is solved, delete the key\n"
                           "impinge: d.json: no pair of this run is 'pipe* | wall'; if that clash is solved, delete "
                           "the key\n");
  json all = json::parse(text);
  all.erase("$schema");
  EXPECT_EQ(json::parse(folder.read("out.json")).at("decisions"), all) << "and none is lost in the report";
}

TEST_F(DecisionsFile, MistakesAreToldWithTheirPlaces) {
  for (const auto& [text, said] : std::vector<std::pair<std::string, std::string>>{
           {"", "d.json:1: column 1: "},
           {"[]", "d.json:1: this is no list of decisions"},
           {"{\n\"a | b\":7}", "d.json:2: /a | b: a decision should stand here"},
           {R"({"a | b":{"state":"x"}})", "d.json:1: /a | b/state: there is no 'state' here; did you mean 'status'?"},
           {R"({"a | b":{"due":"14.6.2024"}})", "d.json:1: /a | b/due: a day is such as 2024-06-14, not '14.6.2024'"},
           {R"({"a/c | b":{"status":null}})", "d.json:1: /a~1c | b/status: a text in quotes should stand here"},
           {R"({"a | b":{},"a | b":{}})", "d.json:1: column 19: /a | b: this key stands here twice"},
           {R"({"pipe*":{}})", "d.json:1: /pipe*: this is neither the id of a pair"}})
    EXPECT_THAT(sentence_of(run(text)), StartsWith("impinge: " + said)) << text;
  const std::string good = R"({"$schema":"s","a | b":{"status":"x","comment":"y"}})";
  EXPECT_EQ(run(good).code, 1);
  EXPECT_EQ(refusal(folder, {"clash", "beam.off", "--decisions", "none.json"}),
            "impinge: none.json cannot be read: No such file or directory\n");
}

}  // namespace
}  // namespace impinge::test
