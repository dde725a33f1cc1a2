// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// The reader of JSON texts, held against the values of nlohmann-json's own.
#include "report/json_reader.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <set>

namespace impinge::report {
namespace {

using nlohmann::json;
using Kind = JsonReader::Kind;

/// All that a text says, as the other reader's value.
json value_of(JsonReader& reader) {
  switch (reader.kind()) {
    case Kind::null:
      reader.skip();
      return nullptr;
    case Kind::boolean:
      return reader.boolean();
    case Kind::number:
      return reader.number();
    case Kind::string:
      return reader.string();
    case Kind::array: {
      json list = json::array();
      reader.array([&] { list.push_back(value_of(reader)); });
      return list;
    }
    case Kind::object: {
      json object = json::object();
      reader.object([&](const std::string& key) {
        json value = value_of(reader);
        object[key] = std::move(value);
      });
      return object;
    }
  }
  return nullptr;
}

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

void compare(const std::string& text) {
  SCOPED_TRACE(text);
  const bool accepted = json::accept(text);
  JsonReader reader(text, "t");
  const json value = value_of(reader);
  JsonReader skipping(text, "t");
  skipping.skip();
  EXPECT_EQ(!skipping.failed(), accepted) << (skipping.failed() ? skipping.error().message : "");
  if (!accepted || has_twin_keys(text)) {
    EXPECT_TRUE(reader.failed());
    return;
  }
  ASSERT_FALSE(reader.failed()) << reader.error().message;
  EXPECT_EQ(value, json::parse(text));
}

TEST(JsonReader, ReadsWhatAnotherReaderReads) {
  for (const std::string& text : texts()) compare(text);
  compare("\xEF\xBB\xBF[1]");
  for (const char* text : {"",
                           " ",
                           "[",
                           "]",
                           "{",
                           "[1,]",
                           "{\"a\":1,}",
                           "{\"a\"}",
                           "{a:1}",
                           "01",
                           "1.",
                           ".5",
                           "+1",
                           "-",
                           "1e",
                           "1e999",
                           "-1e999",
                           "tru",
                           "nulll",
                           "\"",
                           "\"\\x\"",
                           "\"\\u12\"",
                           "\"\\ud800\"",
                           "\"\\ud800\\u0041\"",
                           "\"\\udc00\"",
                           "\"\x01\"",
                           "\"\xff\"",
                           "\"\xED\xA0\x80\"",
                           "[1][2]",
                           "[1 2]",
                           "{\"a\":1 \"b\":2}",
                           "NaN",
                           "Infinity",
                           "'a'",
                           "[1]//",
                           "[\"a\",]"}) {
    compare(text);
    EXPECT_TRUE(JsonReader(text, "t").failed()) << text;
  }
}

TEST(JsonReader, AgreesOnWhatIsBroken) {
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
    compare(text);
  }
}

TEST(JsonReader, RefusesWhatIsNestedTooDeep) {
  for (const char* bracket : {"[", "{\"a\":"}) {
    std::string deep;
    for (int i = 0; i < 1'000'000; ++i) deep += bracket;
    for (const bool skips : {true, false}) {
      JsonReader reader(deep, "t");
      if (skips)
        reader.skip();
      else
        value_of(reader);
      ASSERT_TRUE(reader.failed());
      EXPECT_NE(reader.error().message.find("deeper than 64"), std::string::npos);
    }
  }
  const std::string allowed = std::string(64, '[') + std::string(64, ']');
  JsonReader reader(allowed, "t");
  reader.skip();
  EXPECT_FALSE(reader.failed());
}

TEST(JsonReader, SaysWhereAMistakeIs) {
  const std::string text = "{\n \"a\": [1\n,\n  {\"b c\":\n  \"d\"}]}";
  JsonReader reader(text, "some.json");
  reader.object([&](const std::string&) {
    reader.array([&] {
      if (reader.kind() == Kind::number) return static_cast<void>(reader.number());
      reader.object([&](const std::string&) { reader.boolean(); });
    });
  });
  ASSERT_TRUE(reader.failed());
  EXPECT_EQ(reader.error().message, "some.json:5: /a/1/b c: true or false should stand here, not a text in quotes");
  JsonReader number("[\n1\n]", "some.json");
  number.array([&] { number.string(); });
  EXPECT_EQ(number.error().message, "some.json:2: /0: a text in quotes should stand here, not a number");
}

TEST(JsonReader, SaysInWhichLineATextIsBroken) {
  for (const auto& [text, line] : std::vector<std::pair<std::string, int>>{{"{\n \"a\": [1,\n  {\"b c\": tru}]}", 3},
                                                                           {"[1\n,1e999\n]", 2},
                                                                           {"[1,\n2", 2},
                                                                           {"[1]\n\n x", 3},
                                                                           {"\n\"\xFF\"", 2}}) {
    const JsonReader reader(text, "some.json");
    ASSERT_TRUE(reader.failed()) << text;
    EXPECT_TRUE(reader.error().message.starts_with("some.json:" + std::to_string(line) + ": "))
        << reader.error().message;
    EXPECT_LT(reader.error().message.size(), 300U);
  }
  const JsonReader huge(std::string(1'000'000, 'x'), "some.json");
  EXPECT_LT(huge.error().message.size(), 300U) << huge.error().message;
}

}  // namespace
}  // namespace impinge::report
