// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// JSON texts from files: what is refused, and where a mistake is said to be.
#include "report/json_file.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>

namespace impinge::report {
namespace {

using nlohmann::json;

const std::vector<std::string>& texts() {
  static const std::vector<std::string> all{
      R"({"version":1,"pairs":[{"a":0,"b":1,"centroid":[1.5,-2e3,0.25E-2],"status":null,"ok":true}],"x":{}})",
      R"([[],[[]],{"a":{"b":[null,false,true]}},"",0,-0,1e308,1e-400,123456789012345678901234567890])",
      "{\"\\u00e9\":\"\\ud83d\\ude00 \\n\\t\\\"\\\\\\/\\b\\f\\r\\u0000\",\"\xC3\xA9\":\"\xF0\x9F\x98\x80\"}",
      " \n\t\r[ 1 , 2 , { \"k\" : \"v\" , \"l\" : [ ] } ] \n"};
  return all;
}

bool has_twin_keys(const std::string& text) {
  bool twins = false;
  std::vector<std::set<std::string>> open;
  const json::parser_callback_t look = [&](int, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::object_start) open.emplace_back();
    if (event == json::parse_event_t::key) twins |= !open.back().insert(parsed.get<std::string>()).second;
    if (event == json::parse_event_t::object_end) open.pop_back();
    return true;
  };
  const json parsed = json::parse(text, look, false);
  EXPECT_FALSE(parsed.is_discarded());
  return twins;
}

void compare_text(const std::string& text) {
  SCOPED_TRACE(text);
  const Result<json> read = parse_json("t", text);
  EXPECT_EQ(static_cast<bool>(read), json::accept(text) && !has_twin_keys(text)) << (read ? "" : read.error().message);
}

TEST(JsonFile, RefusesWhatIsNoJson) {
  for (const std::string& text : texts()) compare_text(text);
  compare_text("\xEF\xBB\xBF[1]");
  std::vector<std::string> bad{"", " ", "[1 2]", R"({"a":1 "b":2})", "\"\x01\"", "\"\xff\"", "\"\xED\xA0\x80\""};
  std::istringstream words(R"([ ] { [1,] {"a":1,} {"a"} {a:1} 01 1. .5 +1 - 1e 1e999 -1e999 tru nulll " "\x" "\u12"
                              "\ud800" "\ud800\u0041" "\udc00" [1][2] NaN Infinity 'a' [1]// ["a",])");
  for (std::string word; words >> word;) bad.push_back(word);
  for (const std::string& text : bad) {
    compare_text(text);
    EXPECT_FALSE(parse_json("t", text)) << text;
  }
}

TEST(JsonFile, RefusesWhatIsBrokenAndKeysThatStandTwice) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const std::string letters = "{}[]\",:\\ue0123456789-+.tfnalsr \n\x01\xC3\x80";
  for (int i = 0; i < 20000 && !HasFailure(); ++i) {
    std::string text = texts()[random() % texts().size()];
    for (auto edits = 1 + random() % 3; edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      if (random() % 3 == 0)
        text.erase(at, 1 + random() % 4);
      else if (random() % 2 == 0)
        text[at] = letters[random() % letters.size()];
      else
        text.insert(at, 1, letters[random() % letters.size()]);
      if (text.empty()) text = "0";
    }
    compare_text(text);
  }
}

TEST(JsonFile, RefusesWhatIsNestedTooDeep) {
  for (const char* bracket : {"[", "{\"a\":"}) {
    std::string deep;
    for (int i = 0; i < 1'000'000; ++i) deep += bracket;
    const Result<json> read = parse_json("t", deep);
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().message.find("deeper than 64"), std::string::npos);
  }
  EXPECT_TRUE(parse_json("t", std::string(64, '[') + std::string(64, ']')));
}

TEST(JsonFile, SaysWhereAMistakeIs) {
  const std::string text = "{\n \"a\": [1\n,\n  {\"b/c\":\n  \"d\"},\n\"e\"]}";
  const std::vector<std::pair<std::string, int>> places{{"", 1},     {"/a", 2},        {"/a/0", 2},
                                                        {"/a/1", 4}, {"/a/1/b~1c", 4}, {"/a/2", 6}};
  for (const auto& [pointer, line] : places)
    EXPECT_EQ(json_error("some.json", text, pointer, "what").message,
              "some.json:" + std::to_string(line) + ": " + (pointer.empty() ? "" : pointer + ": ") + "what");
  const Result<json> twice = parse_json("some.json", "{\"a\": [{},\n{\"b\": 1, \"c\": {}, \"b\": 2}]}");
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().message, "some.json:2: column 21: /a/1/b: this key stands here twice");
}

TEST(JsonFile, SaysInWhichLineATextIsBroken) {
  for (const auto& [text, line] : std::vector<std::pair<std::string, int>>{{"{\n \"a\": [1,\n  {\"b c\": tru}]}", 3},
                                                                           {"[1\n,1e999\n]", 2},
                                                                           {"[1,\n2", 2},
                                                                           {"[1]\n\n x", 3},
                                                                           {"\n\"\xFF\"", 2}}) {
    const Result<json> read = parse_json("some.json", text);
    ASSERT_FALSE(read) << text;
    EXPECT_TRUE(read.error().message.starts_with("some.json:" + std::to_string(line) + ":")) << read.error().message;
    EXPECT_LT(read.error().message.size(), 300U);
  }
  const Result<json> huge = parse_json("some.json", std::string(1'000'000, 'x'));
  EXPECT_LT(huge.error().message.size(), 300U) << huge.error().message;
}

}  // namespace
}  // namespace impinge::report
