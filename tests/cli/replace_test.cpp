// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Which JSON files --json replaces: earlier documents, and of reports only those that nobody wrote into, or whose
// remarks the run takes over.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "meshes.hpp"
#include "program.hpp"
#include "report/comparison/remarks.hpp"

namespace impinge::test {
namespace {

using Ordered = nlohmann::ordered_json;

class Replaced : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("a.off", off(box({0, 0, 0}, {2, 2, 2})));
    folder.write("b.off", off(box({1, 1, 1}, {3, 3, 3})));
    report = Ordered::parse(run("clash", {"--json", "-", "--regions"}).out);
  }
  Ended run(const std::string& command, std::vector<std::string> more) const {
    more.insert(more.begin(), {command, "a.off", "b.off"});
    return impinge(folder, more);
  }
  void expect_kept(const std::string& command, const std::vector<std::string>& more, const std::string& reason) const {
    const std::string before = folder.read("r.json");
    std::vector<std::string> words{"--json", "r.json"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = run(command, words);
    EXPECT_EQ(ended.code, 2) << before.substr(0, 80);
    EXPECT_NE(ended.err.find(reason), std::string::npos) << ended.err;
    EXPECT_EQ(folder.read("r.json"), before);
  }
  void expect_replaced(const std::string& command, const std::vector<std::string>& more = {}) const {
    const std::string before = folder.read("r.json");
    std::vector<std::string> words{"--json", "r.json"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = run(command, words);
    EXPECT_LT(ended.code, 2) << ended.err;
    EXPECT_NE(folder.read("r.json"), before);
  }
  Folder folder;
  Ordered report;
};

TEST_F(Replaced, SomebodysJsonIsNot) {
  const std::string config = R"({"tests":[{"name":"all","a":"*"}]})";
  for (const std::string& foreign :
       {std::string(R"({"name":"my package"})"), config, std::string("[]"), std::string("{}"),
        std::string(R"({"version":1})"), std::string(R"({"version":1,"objects":[{"id":0,"title":"a"}]})"),
        std::string(R"({"version":1,"settings":{"tab":2}})"), std::string(R"({"version":1,"files":["a"]})"),
        std::string(R"({"version":2,"settings":{"tolerance":"auto"}})")})
    for (const char* command : {"clash", "check", "info"}) {
      folder.write("r.json", foreign);
      expect_kept(command, {}, "'r.json' exists and holds no JSON of impinge, so it is not replaced");
    }
  folder.write("r.json", config);
  expect_kept("clash", {"--config", "r.json"}, "one of the files to read");
  folder.write("r.json", R"({"name":"my package"})");
  expect_kept("clash", {"--previous", "r.json"}, "no report of an earlier run");
}

TEST_F(Replaced, EarlierDocumentsAreInAnyLayout) {
  for (const char* command : {"clash", "check", "info"}) {
    const std::string document = run(command, {"--json", "-"}).out;
    for (const std::string& text :
         {document + " ", "\n" + document, Ordered::parse(document).dump() + " ", Ordered::parse(document).dump(4),
          Ordered::parse(document).dump(1, '\t'), "\xEF\xBB\xBF" + document})
      for (const char* by : {"clash", "check", "info"}) {
        folder.write("r.json", text);
        expect_replaced(by);
      }
  }
}

TEST_F(Replaced, WhatSomebodyWroteIsKept) {
  const std::string lost = "'r.json' holds a status or comment that somebody wrote";
  for (const char* where : {"/pairs/0", "/pairs/0/regions/0"})
    for (const char* key : {"status", "comment"})
      for (const int indent : {-1, 2}) {
        Ordered mine = report;
        mine[Ordered::json_pointer(where)][key] = "\xC3\xA4 \"b\"";
        folder.write("r.json", mine.dump(indent));
        expect_kept("clash", {}, lost);
        expect_kept("clash", {}, "--previous r.json takes it over, or let --json name another file");
        expect_kept("check", {}, lost);
        expect_kept("info", {}, lost);
        expect_replaced("clash", {"--previous", "r.json"});
        EXPECT_EQ(Ordered::parse(folder.read("r.json"))[Ordered::json_pointer(where)][key], "\xC3\xA4 \"b\"");
      }
  // What is not there any more was written nevertheless.
  Ordered mine = report;
  mine["pairs"][0]["comment"] = "later";
  folder.write("r.json", mine.dump());
  folder.write("b.off", off(box({5, 5, 5}, {6, 6, 6})));
  expect_replaced("clash", {"--previous", "r.json"});
  EXPECT_TRUE(Ordered::parse(folder.read("r.json"))["pairs"].empty());
  expect_kept("clash", {}, lost);
  // Scripts may sort the keys.
  folder.write("r.json", nlohmann::json::parse(folder.read("r.json")).dump());
  expect_kept("clash", {}, "is not replaced");
  expect_replaced("clash", {"--previous", "./r.json"});
}

TEST_F(Replaced, ARunMayBeRepeatedUntilSomebodyWrites) {
  Ordered mine = report;
  mine["pairs"][0]["status"] = "open";
  folder.write("last.json", mine.dump());
  folder.write("r.json", report.dump(2));
  expect_replaced("clash", {"--previous", "last.json"});
  Ordered theirs = Ordered::parse(folder.read("r.json"));
  ASSERT_EQ(theirs["pairs"][0]["status"], "open");
  folder.write("r.json", folder.read("r.json") + "\n");
  expect_replaced("clash", {"--previous", "last.json"});  // it has nothing that last.json has not
  theirs["pairs"][0]["comment"] = "new";
  folder.write("r.json", theirs.dump());
  expect_kept("clash", {"--previous", "last.json"}, "so it is not replaced; --previous r.json takes it over");
  theirs["pairs"][0]["comment"] = nullptr;
  theirs["pairs"][0]["regions"][0]["status"] = "open";
  folder.write("r.json", theirs.dump());
  expect_kept("clash", {"--previous", "last.json"}, "is not replaced");
}

/// Whether the text, cut into pieces of this size, has a remark.
bool has_remark(std::string_view text, std::size_t size) {
  report::RemarkSearch search;
  for (; !text.empty(); text.remove_prefix(std::min(size, text.size())))
    if (search.look(text.substr(0, size))) return true;
  return false;
}

TEST(RemarkSearch, FindsThemInAnyPieces) {
  const std::vector<std::pair<std::string, bool>> texts{
      {R"({"status":null,"comment":null})", false},
      {R"({"status":"","comment" : ""})", false},
      {R"({"status":"a"})", true},
      {"{\"a\":1,\"comment\"\n :\t\r\n \"a\"}", true},
      {R"({"status":"\"\""})", true},
      {R"({"comment":5})", true},
      {R"({"name":"status","comments":"a","stat":"b","status ":"c"})", false},
      {R"({"name":"\"status\":\"a\"","b":"\\","c":"\\\"comment\":\"a"})", false},
      {R"({"\"status":"a","x\\status":"b"})", false},
      {R"({"list":["status","a","comment"],"":"","status":null,"z":"a"})", false},
      {R"({"b":"\\","status":"a"})", true},
      {R"({"b":"","status":null,"comment":"a"})", true},
      {R"({"\u0063omment":"a"})", true},
      {R"({"\u0073\u0074\u0061\u0074\u0075\u0073":"a"})", true},
      {R"({"c\u006F\u006dment":"a"})", true},
      {R"({"comment":"\u0061"})", true},
      {R"({"\u0063omment":""})", false},
      {R"({"\u0043omment":"a","\\u0063omment":"a","\u0022status":"a","status\u0000":"a"})", false},
      {R"({"\u0163omment":"a","\ud83d\udd29":"a","status\u0020":"a"})", false}};
  for (const auto& [text, expected] : texts)
    for (std::size_t size = 1; size <= text.size(); ++size) EXPECT_EQ(has_remark(text, size), expected) << text << size;
}

}  // namespace
}  // namespace impinge::test
