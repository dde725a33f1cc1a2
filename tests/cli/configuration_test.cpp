// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// The reader of configurations, held against their schema; and what it says of mistakes.
#include "report/named_tests/configuration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "schema.hpp"

namespace impinge::report {
namespace {

using nlohmann::json;

const json& schema() {
  static const json read = json::parse(std::ifstream(IMPINGE_SOURCE_DIR "/docs/clash.schema.json"));
  return read;
}

json sample() {
  return json::parse(R"({"$schema":"s","files":["a.off",{"file":"b.off","scale":25.4}],
    "groups":{"pipes":"pipe*","steel":{"file":["s.glb","t.glb"],"except":["bolt*",{"path":"x/*","product":"Ifc*"}]}},
    "mode":"contact","tolerance":"auto","clearance":5,"may_touch":true,
    "ignore":{"same_file":true,"same_parent":false,"pairs":[["a","b"],[{"group":"pipes"},["c","d"]]],"within":["n*"]},
    "tests":[{"name":"one","a":"*","mode":"clearance","clearance":2.5,"tolerance":0},
             {"name":"two","a":{"name":["x","y"]},"b":{"group":["pipes","steel"]},"ignore":{"within":[]},
              "tolerance":0.25,"may_touch":[["a",{"name":"b"}]]}]})");
}

void compare(const json& document) {
  const std::string text = document.dump();
  const auto read = parse_configuration("c.json", text);
  EXPECT_EQ(static_cast<bool>(read), test::is_valid(document, schema(), schema()))
      << text << "\n"
      << (read ? "" : read.error().message);
}

/// Every value in a document, and the object or list that holds it.
void collect(json& value, std::vector<json*>& all) {
  all.push_back(&value);
  if (value.is_structured())
    for (json& inner : value) collect(inner, all);
}

TEST(Configuration, AgreesWithItsSchema) {
  ASSERT_TRUE(parse_configuration("c.json", sample().dump()));
  compare(sample());
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::vector<json> others{nullptr,
                           true,
                           0,
                           -1,
                           0.5,
                           "",
                           "word",
                           "auto",
                           "contact",
                           json::array(),
                           json::object(),
                           json::array({"a"}),
                           json::array({"a", "b"}),
                           json::parse(R"([["a","b"]])"),
                           json::parse(R"({"name":"n"})"),
                           json::parse(R"({"file":"f"})"),
                           json::parse(R"({"a":1})")};
  std::size_t valid = 0;
  for (int i = 0; i < 1000 && !HasFailure(); ++i) {
    json document = sample();
    for (auto edits = 1 + random() % 2; edits > 0; --edits) {
      std::vector<json*> all;
      collect(document, all);
      json& value = *all[random() % all.size()];
      if (value.is_object() && !value.empty() && random() % 2 == 0) {
        const auto key = std::next(value.begin(), static_cast<std::ptrdiff_t>(random() % value.size())).key();
        if (random() % 2 == 0) value[key + "x"] = value[key];
        value.erase(key);
      } else if (value.is_array() && !value.empty() && random() % 2 == 0) {
        value.erase(random() % value.size());
      } else {
        value = others[random() % others.size()];
      }
    }
    // A list at the top is for another program's files.
    if (document.is_array()) continue;
    valid += test::is_valid(document, schema(), schema()) ? 1U : 0U;
    compare(document);
  }
  EXPECT_GT(valid, 25U);
}

TEST(Configuration, KnowsTheKeysOfTheSchema) {
  const auto keys_at = [](const char* where) {
    std::vector<std::string> keys;
    for (const auto& item : schema().at(json::json_pointer(where)).items()) keys.push_back(item.key());
    return keys;
  };
  const auto sorted = [](const std::vector<std::string_view>& keys) {
    std::vector<std::string> all(keys.begin(), keys.end());
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(sorted(known_keys().configuration), keys_at("/properties"));
  EXPECT_EQ(sorted(known_keys().test), keys_at("/$defs/test/properties"));
  EXPECT_EQ(sorted(known_keys().group), keys_at("/$defs/group/anyOf/2/properties"));
  EXPECT_EQ(sorted(known_keys().ignore), keys_at("/$defs/ignore/properties"));
  EXPECT_EQ(sorted(known_keys().file), keys_at("/$defs/file/anyOf/1/properties"));
}

std::string mistake(const std::string& text) {
  const auto read = parse_configuration("c.json", text);
  if (!read) return read.error().message;
  const auto checked = check(*read);
  return checked ? "none" : checked.error().message;
}

TEST(Configuration, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(mistake("{\"tests\":[{\"name\":\"n\",\n\"a\":\"x\",\"tolerence\":1}]}"),
            "c.json:2: /tests/0/tolerence: there is no 'tolerence' here; did you mean 'tolerance'?");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":{"except":{"nme":"x"}}}]})"),
            "c.json:1: /tests/0/a/except/nme: there is no 'nme' here; did you mean 'name'?");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x","mode":"touch"}]})"),
            "c.json:1: /tests/0/mode: a mode is penetration, contact or clearance, not 'touch'");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x","tolerance":"1"}]})"),
            "c.json:1: /tests/0/tolerance: a tolerance is \"auto\" or a length from 0 up");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x"},{"name":"n","a":"y"}]})"),
            "c.json:1: /tests/1/name: two tests are named 'n'");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x","mode":"clearance"}]})"),
            "c.json:1: /tests/0: mode clearance needs a \"clearance\", the distance to keep");
  EXPECT_EQ(mistake("{\"mode\":\"clearance\",\"tests\":[\n{\"name\":\"m\",\"a\":\"x\",\"clearance\":1},\n{\n\"name\":"
                    "\"n\",\"a\":\"x\"}]}"),
            "c.json:3: /tests/1: mode clearance needs a \"clearance\", the distance to keep");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x","clearance":1}]})"),
            "c.json:1: /tests/0/clearance: only mode clearance keeps a clearance, and this test has mode penetration");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x","a":"y"}]})"), "c.json:1: /tests/0/a: this key stands here twice");
  EXPECT_EQ(mistake(R"({"tests":[]})"), "c.json:1: there are no \"tests\"");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x"}]} {})"),
            "c.json:1: syntax error while parsing value - unexpected '{'; expected end of input");
  EXPECT_EQ(mistake(R"({"clearance":3,"mode":"clearance","tests":[{"name":"n","a":"x"}]})"), "none");
}

TEST(Configuration, ReadsClashSetsOfIfcClash) {
  const auto read = parse_configuration("sets.json", R"([
    {"name":"Walls and pipes","mode":"intersection","tolerance":0.002,"check_all":true,"allow_touching":true,"clearance":1,
     "a":[{"file":"/x/one.ifc","selector":".IfcWall","mode":"i"}],
     "b":[{"file":"two.ifc","selector":"IfcPipeSegment, IfcPipeFitting","mode":"e"},{"file":"three.ifc","mode":"a"}],
     "clashes":{"1-2":{"position":[0,0,0]}}},
    {"name":"touching","mode":"collision","allow_touching":true,"a":[{"file":"one.ifc"}]},
    {"name":"no touching","mode":"collision","allow_touching":false,"a":[{"file":"one.ifc"}],"b":[]},
    {"name":"near","mode":"clearance","clearance":0.1,"check_all":false,"a":[{"file":"one.ifc","selector":"#25fsbPyk15VvuXI$yNKenK","mode":"i"}]},
    {"name":"old","tolerance":0.01,"a":[{"file":"one.ifc","selector":"IfcElement","mode":"i"}]}])");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_TRUE(check(*read));
  ASSERT_EQ(read->tests.size(), 5U);
  const NamedTest& first = read->tests[0];
  EXPECT_EQ(first.terms.mode, Mode::penetration);
  EXPECT_EQ(first.terms.tolerance.value_or(std::nullopt), 0.002);
  EXPECT_FALSE(first.terms.clearance);
  const Group& walls = first.a.any.at(0).any.at(0);
  EXPECT_EQ(walls.classes.at(0).text, "IfcWall");
  EXPECT_EQ(walls.files.at(0).text, "/x/one.ifc");
  ASSERT_TRUE(first.b);
  EXPECT_EQ(first.b->any.at(0).files.at(0).text, "two.ifc");
  ASSERT_EQ(first.b->any.at(0).except.size(), 2U);
  EXPECT_EQ(first.b->any.at(0).except[1].classes.at(0).text, "IfcPipeFitting");
  EXPECT_EQ(read->mode_of(read->tests[1]), Mode::contact);
  EXPECT_EQ(read->mode_of(read->tests[2]), Mode::penetration);
  EXPECT_FALSE(read->tests[2].b);
  EXPECT_EQ(read->mode_of(read->tests[3]), Mode::clearance);
  EXPECT_EQ(read->clearance_of(read->tests[3]), 0.1);
  EXPECT_EQ(read->tests[3].a.any.at(0).any.at(0).products.at(0).text, "*25fsbPyk15VvuXI$yNKenK*");
  EXPECT_TRUE(read->tests[4].a.any.at(0).any.empty());

  EXPECT_NE(mistake(R"([{"name":"q","a":[{"file":"f","selector":"IfcWall, Name=/x/","mode":"i"}]}])")
                .find("is a query that impinge does not answer"),
            std::string::npos);
  EXPECT_EQ(mistake(R"([{"name":"q","a":[{"fil":"f"}]}])"),
            "c.json:1: /0/a/0/fil: there is no 'fil' here; did you mean 'file'?");
  EXPECT_EQ(mistake("[]"), "c.json:1: this list has no clash sets in it");
}

}  // namespace
}  // namespace impinge::report
