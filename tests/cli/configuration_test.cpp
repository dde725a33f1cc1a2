// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// The reader of configurations, and what it says of mistakes.
#include "report/named_tests/configuration.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>

#include "report/json_file.hpp"

namespace impinge::report {
namespace {

using nlohmann::json;

json sample() {
  return json::parse(R"({"$schema":"s","files":["a.off",{"file":"b.off","scale":25.4}],
    "groups":{"pipes":"pipe*","steel":{"file":["s.glb","t.glb"],"except":["bolt*",{"path":"x/*","product":"Ifc*"}]},
      "level":{"class":["IfcWall","IfcSlab"],"property":{"storey":"1*","Pset_W.R":["2HR","3HR"]},"select":"IfcWall"}},
    "mode":"contact","tolerance":"auto","clearance":5,"may_touch":true,
    "ignore":{"same_file":true,"same_parent":false,"pairs":[["a","b"],[{"group":"pipes"},["c","d"]]],"within":["n*"],
      "by_design":["fasteners"]},
    "tests":[{"name":"one","a":"*","mode":"clearance","clearance":2.5,"tolerance":0},
             {"name":"two","a":{"name":["x","y"]},"b":{"group":["pipes","steel"]},"ignore":{"within":[]},
              "tolerance":0.25,"may_touch":[["a",{"name":"b"}]]}]})");
}

/// Every value in a document, and the object or list that holds it.
void collect(json& value, std::vector<json*>& all) {
  all.push_back(&value);
  if (value.is_structured())
    for (json& inner : value) collect(inner, all);
}

TEST(Configuration, IsReadOrRefusedWithAPlace) {
  ASSERT_TRUE(parse_configuration("c.json", sample().dump()));
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const json others = json::parse(R"([null,true,0,-1,0.5,"","word","auto","contact",[],{},["a"],["a","b"],[["a","b"]],
    {"name":"n"},{"file":"f"},{"a":1}])");
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
    const auto read = parse_configuration("c.json", document.dump());
    valid += read ? 1U : 0U;
    EXPECT_TRUE(read || read.error().message.starts_with("c.json:1: ")) << read.error().message;
  }
  EXPECT_GT(valid, 25U);
}

std::string mistake(const std::string& text) {
  const auto read = parse_configuration("c.json", text);
  if (!read) return read.error().message;
  const auto checked = check(*read);
  return checked ? "none" : checked.error().message;
}

TEST(Configuration, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(mistake("{\"tests\":[{\"name\":\"n\",\n\"a\":\"x\",\"tolerence\":1}]}"),
            "c.json:2: /tests/0/tolerence: there is no 'tolerence' here; did you mean 'tolerance'? The keys are a, b, "
            "clearance, ignore, may_touch, mode, name, tolerance");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":{"except":{"nme":"x"}}}]})"),
            "c.json:1: /tests/0/a/except/nme: there is no 'nme' here; did you mean 'name'? The keys are class, "
            "except, file, group, name, path, product, property, select");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x","mode":"touch"}]})"),
            "c.json:1: /tests/0/mode: a mode is penetration, contact or clearance, not \"touch\"");
  EXPECT_EQ(
      mistake(R"({"tests":[{"name":"n","a":"x","tolerance":"1"}]})"),
      "c.json:1: /tests/0/tolerance: a tolerance is \"auto\" or a length from 0 up, such as 10 or \"10mm\", not \"1\"");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x"},{"name":"n","a":"y"}]})"),
            "c.json:1: /tests/1/name: two tests are named 'n'");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x","mode":"clearance"}]})"),
            "c.json:1: /tests/0: mode clearance needs a \"clearance\", the distance to keep");
  EXPECT_EQ(mistake("{\"mode\":\"clearance\",\"tests\":[\n{\"name\":\"m\",\"a\":\"x\",\"clearance\":1},\n{\n\"name\":"
                    "\"n\",\"a\":\"x\"}]}"),
            "c.json:3: /tests/1: mode clearance needs a \"clearance\", the distance to keep");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x","clearance":1}]})"),
            "c.json:1: /tests/0/clearance: only mode clearance keeps a clearance, and this test has mode penetration");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x","a":"y"}]})"),
            "c.json:1: column 33: /tests/0/a: this key stands here twice");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n","a":"x"}]} {})"),
            "c.json:1: column 34: syntax error while parsing value - unexpected '{'; expected end of input");
  EXPECT_EQ(mistake(R"({"clearance":3,"mode":"clearance","tests":[{"name":"n","a":"x"}]})"), "none");
}

TEST(Configuration, SaysWhichRuleOfTheSchemaIsBroken) {
  const std::string group =
      "a group is a pattern of names (\"*\" is every part), an object such as {\"file\": "
      "\"steel.glb\"}, or a list of at least one group, not ";
  const std::string words = "this is a text that is not empty, or a list of at least one, not ";
  for (const auto& [member, what] : std::vector<std::pair<std::string, std::string>>{
           {R"("files":"a.off")", "/files: this must be of type array, not \"a.off\""},
           {R"("files":[""])",
            "/files/0: a file is its name, or an object such as {\"file\": \"steel.glb\", \"scale\": 0.001}, not \"\""},
           {R"("files":[{"scale":2}])", "/files/0: this has no \"file\""},
           {R"("files":[{"file":"a.off","scale":0}])", "/files/0/scale: a scale is a number above 0, not 0"},
           {R"("groups":["a"])", "/groups: this must be of type object, not a list of 1"},
           {R"("groups":{"x/y":5})", "/groups/x~1y: " + group + "5"},
           {R"("groups":{"x":[]})", "/groups/x: " + group + "an empty list"},
           {R"("groups":{"x":{}})", "/groups/x: " + group + "{}"},
           {R"("groups":{"x":{"any":["a"]}})",
            "/groups/x/any: there is no 'any' here; did you mean 'name'? The keys "
            "are class, except, file, group, name, path, product, property, select"},
           {R"("groups":{"x":["a",{"path":[]}]})", "/groups/x/1/path: " + words + "an empty list"},
           {R"("groups":{"x":{"name":{"a":1}}})", "/groups/x/name: " + words + "an object"},
           {R"("groups":{"x":{"file":["a",""]}})", "/groups/x/file/1: this is a text that is not empty, not \"\""},
           {R"("tolerance":-0.5)",
            "/tolerance: a tolerance is \"auto\" or a length from 0 up, such as 10 or \"10mm\", not -0.5"},
           {R"("tolerance":"-1mm")",
            "/tolerance: a tolerance is \"auto\" or a length from 0 up, such as 10 or \"10mm\", not \"-1mm\""},
           {R"("clearance":0)", "/clearance: a clearance is a length above 0, such as 10 or \"10mm\", not 0"},
           {R"("clearance":"0 mm")",
            "/clearance: a clearance is a length above 0, such as 10 or \"10mm\", not \"0 mm\""},
           {R"("clearance":"auto")",
            "/clearance: a clearance is a length above 0, such as 10 or \"10mm\", not \"auto\""},
           {R"("groups":{"x":{"property":{}}})",
            "/groups/x/property: properties are an object such as {\"storey\": \"Level 2*\"}, not {}"},
           {R"("ignore":{"by_design":["bolts"]})",
            "/ignore/by_design/0: the ready rules are fasteners, reinforcement, opening fillings and insulation "
            "coverings, not \"bolts\""},
           {R"("ignore":{"same_file":1})", "/ignore/same_file: this must be of type boolean, not 1"},
           {R"("ignore":{"pairs":[["a"]]})", "/ignore/pairs/0: a pair is a list of two groups, not a list of 1"},
           {R"("ignore":{"within":[null]})", "/ignore/within/0: " + group + "null"},
           {R"("may_touch":"all")", "/may_touch: this is true, false, or a list of pairs of groups, not \"all\""},
           {R"("may_touch":[["a","b","c"]])", "/may_touch/0: a pair is a list of two groups, not a list of 3"}})
    EXPECT_EQ(mistake("{" + member + R"(,"tests":[{"name":"n","a":"x"}]})"), "c.json:1: " + what);
  EXPECT_EQ(mistake("{}"), "c.json:1: this has no \"tests\"");
  EXPECT_EQ(mistake(R"({"tests":[{"name":"n"}]})"), "c.json:1: /tests/0: this has no \"a\"");
  EXPECT_EQ(mistake(R"({"tests":[]})"),
            "c.json:1: /tests: \"tests\" is a list of at least one test, such as {\"name\": "
            "\"all\", \"a\": \"*\"}, not an empty list");
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
  const Group& walls = first.a.any.at(0);
  EXPECT_EQ(walls.selects.at(0).text, ".IfcWall");
  EXPECT_EQ(walls.files.at(0).text, "/x/one.ifc");
  ASSERT_TRUE(first.b);
  EXPECT_EQ(first.b->any.at(0).files.at(0).text, "two.ifc");
  ASSERT_EQ(first.b->any.at(0).except.size(), 1U);
  EXPECT_EQ(first.b->any.at(0).except[0].selects.at(0).text, "IfcPipeSegment, IfcPipeFitting");
  EXPECT_EQ(read->mode_of(read->tests[1]), Mode::contact);
  EXPECT_EQ(read->mode_of(read->tests[2]), Mode::penetration);
  EXPECT_FALSE(read->tests[2].b);
  EXPECT_EQ(read->mode_of(read->tests[3]), Mode::clearance);
  EXPECT_EQ(read->clearance_of(read->tests[3]), 0.1);
  EXPECT_EQ(read->tests[3].a.any.at(0).selects.at(0).text, "#25fsbPyk15VvuXI$yNKenK");
  EXPECT_TRUE(read->tests[4].a.any.at(0).selects.empty()) << "everything";

  EXPECT_EQ(mistake(R"([{"name":"q","a":[{"fil":"f"}]}])"),
            "c.json:1: /0/a/0/fil: there is no 'fil' here; did you mean 'file'? The keys are file, mode, selector");
  EXPECT_EQ(mistake("[]"), "c.json:1: this is a list of at least one clash set, not an empty list");
  for (const auto& [set, what] : std::vector<std::pair<std::string, std::string>>{
           {R"("a":[{"file":"f"}])", "/0: this has no \"name\""},
           {R"("name":"","a":[{"file":"f"}])", "/0/name: a name is a text that is not empty, not \"\""},
           {R"("name":"n")", "/0: this has no \"a\""},
           {R"("name":"n","a":[])", "/0/a: the sources \"a\" are a list of at least one, not an empty list"},
           {R"("name":"n","a":null)", "/0/a: the sources \"a\" are a list of at least one, not null"},
           {R"("name":"n","a":[{}])", "/0/a/0: this has no \"file\""},
           {R"("name":"n","a":[{"file":"f","mode":"x"}])",
            "/0/a/0/mode: the mode of a source is i (include), e (exclude) or a (all), not \"x\""},
           {R"("name":"n","a":[{"file":"f","selector":1}])",
            "/0/a/0/selector: this must be of type string or null, not 1"},
           {R"("name":"n","a":[{"file":"f"}],"mode":"hit")",
            "/0/mode: the mode of a clash set is intersection, collision or clearance, not \"hit\""},
           {R"("name":"n","a":[{"file":"f"}],"tolerance":-1)", "/0/tolerance: a length is 0 or more, not -1"},
           {R"("name":"n","a":[{"file":"f"}],"allow_touching":"yes")",
            "/0/allow_touching: this must be of type boolean, not \"yes\""},
           {R"("name":"n","a":[{"file":"f"}],"mode":"clearance")",
            "/0: mode clearance needs a \"clearance\", the distance to keep"}})
    EXPECT_EQ(mistake("[{" + set + "}]"), "c.json:1: " + what);
}

// JSON texts from files: what is refused, and where a mistake is said to be.

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
