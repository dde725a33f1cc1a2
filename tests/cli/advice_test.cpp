// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What is said where a command is probably not what its author means: options that have no effect, words that are
// nearly right, and files that are others than they are taken for.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;

/// Two pipes 3 apart that lie on a slab.
class Advice : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder.path() / "c");
    folder.write("pipe1.off", off(box({0, 0, 0}, {20, 2, 2})));
    folder.write("pipe2.off", off(box({0, 5, 0}, {20, 7, 2})));
    folder.write("c/slab.off", off(box({-1, -1, -1}, {21, 8, 0})));
  }
  [[nodiscard]] Ended clash(const std::vector<std::string>& more) const {
    return impinge(folder, joined({"clash", "pipe1.off", "pipe2.off"}, more));
  }
  [[nodiscard]] std::string error(const std::vector<std::string>& words) const {
    const Ended run = impinge(folder, words);
    EXPECT_EQ(run.code, 2) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  }
  Folder folder;
};

TEST_F(Advice, SelectorsOfIfcClashWithoutAModeAreNamed) {
  const auto sets = [](const std::string& first, const std::string& second) {
    return "[{\"name\":\"hard\",\"a\":[{\"file\":\"pipe1.off\"},\n{\"file\":\"pipe2.off\"" + first +
           "}],\n\"b\":[{\"file\":\"c/slab.off\"" + second + "}]}]";
  };
  folder.write("sets.json", sets(R"(,"selector":"slab")", R"(,"selector":"pipe*")"));
  const Ended run = impinge(folder, {"clash", "--config", "sets.json"});
  EXPECT_EQ(run.code, 0) << "the slab is not looked for in pipe2.off";
  const std::string rest =
      " counts only with a \"mode\" beside it, \"i\" to take what it names, \"e\" to leave that out, or \"a\" if all "
      "is "
      "meant\n";
  const std::string set = "the clash set 'hard' takes all of this file: as with IfcClash, the selector ";
  EXPECT_EQ(run.err, "impinge: sets.json:2: /0/a/1/selector: " + set + "'slab'" + rest +
                         "impinge: sets.json:3: /0/b/0/selector: " + set + "'pipe*'" + rest);
  EXPECT_EQ(impinge(folder, {"clash", "--config", "sets.json", "--quiet"}).err, "");
  // Whoever says so means it, and what selects everything leaves nothing out.
  for (const std::string source : {R"(,"selector":"pipe*","mode":"a")", R"(,"mode":"i","selector":"pipe*")", R"()",
                                   R"(,"selector":null)", R"(,"selector":"IfcElement")", R"(,"selector":"")"}) {
    folder.write("sets.json", sets(source, ""));
    EXPECT_EQ(impinge(folder, {"clash", "--config", "sets.json"}).err, "") << source;
  }
  // However many there are, a few lines tell it.
  std::string many = "[";
  for (int i = 0; i < 100; ++i)
    many += std::string(i > 0 ? "," : "") + R"({"name":"t)" + std::to_string(i) +
            R"(","a":[{"file":"pipe1.off","selector":"x"},{"file":"pipe2.off"}]})";
  folder.write("sets.json", many + "]");
  const std::string told = impinge(folder, {"clash", "--config", "sets.json"}).err;
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 6) << told;
  EXPECT_NE(told.find("impinge: 95 sources more with a selector and no \"mode\"\n"), std::string::npos) << told;
}

TEST_F(Advice, AClearanceThatNoTestAsksForIsNamed) {
  const std::string nothing =
      "impinge: --clearance 4 changes nothing: no test in c.json has the mode clearance without a \"clearance\" of its "
      "own\n";
  const auto told = [&](const std::string& tests) {
    folder.write("c.json", R"({"tests":[)" + tests + "]}");
    return clash({"--config", "c.json", "--clearance", "4"}).err;
  };
  EXPECT_EQ(told(R"({"name":"t","a":"*"})"), nothing);
  EXPECT_EQ(told(R"({"name":"t","a":"*","mode":"clearance","clearance":1})"), nothing);
  EXPECT_EQ(told(R"({"name":"t","a":"*"},{"name":"u","a":"*","mode":"clearance"})"), "");
  EXPECT_EQ(clash({"--config", "c.json", "--clearance", "4"}).code, 1) << "the pipes are 3 apart";
}

TEST_F(Advice, AScaleMayBeOfAFileThatTheConfigurationNames) {
  folder.write("c/clash.json", R"({"files":["slab.off"],"tests":[{"name":"t","a":"*"}]})");
  const auto volume = [&](const std::string& file) {
    const Ended run = clash({"--config", "c/clash.json", "--scale", file + "=3", "--json", "-"});
    EXPECT_LE(run.code, 1) << run.err;
    return run.code > 1 ? 0 : json::parse(run.out).at("objects").at(2).at("volume").get<double>();
  };
  for (const char* file : {"c/slab.off", "slab.off", "./c/slab.off"}) EXPECT_EQ(volume(file), 22 * 9 * 27) << file;
  EXPECT_EQ(error({"clash", "pipe1.off", "--config", "c/clash.json", "--scale", "slap.off=3"}),
            "impinge: --scale slap.off=3: it is none of the files to read, on the command line or in c/clash.json; the "
            "nearest name is 'c/slab.off'\n");
  EXPECT_NE(error({"clash", "--config", "c/clash.json", "--scale", "slab.off=3", "--scale", "c/slab.off=2"})
                .find("--scale c/slab.off=2: this file has a scale already, 3"),
            std::string::npos);
  folder.write("c/clash.json", R"({"files":[{"file":"slab.off","scale":2}],"tests":[{"name":"t","a":"*"}]})");
  EXPECT_EQ(
      error({"clash", "pipe1.off", "--config", "c/clash.json", "--scale", "c/slab.off=3"}),
      "impinge: --scale c/slab.off=3: this file has a scale already, 2, here or in c/clash.json; leave one out\n");
}

TEST_F(Advice, UnknownOptionsAndCommandsHaveTheNearestNamed) {
  const auto suggests = [&](const std::vector<std::string>& words, const std::string& part) {
    const std::string text = error(words);
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  suggests({"clash", "pipe1.off", "--htlm", "r.html"},
           "'--htlm' is no option of impinge clash (did you mean --html?); see impinge clash --help");
  suggests({"clash", "pipe1.off", "--hlep"}, "(did you mean --help?)");
  suggests({"clash", "pipe1.off", "--tol", "1"}, "(did you mean --tolerance?)");
  suggests({"clash", "pipe1.off", "-json", "r.json"}, "(did you mean --json?)");
  suggests({"clash", "pipe1.off", "--clerance=1"},
           "'--clerance' is no option of impinge clash (did you mean --clearance?)");
  suggests({"motion", "pipe1.off", "--farmes", "1"}, "(did you mean --frames?)");
  suggests({"info", "pipe1.off", "--jsn", "-"}, "(did you mean --json?)");
  suggests({"devices", "--hepl"}, "(did you mean --help?)");
  suggests({"--verison"}, "(did you mean --version?)");
  suggests({"--html", "r.html", "clash", "pipe1.off"}, "'--html' is no option of impinge; see impinge --help");
  suggests({"clahs", "pipe1.off"}, "'clahs' is no command of impinge (did you mean clash?)");
  suggests({"pipe1.off", "clash", "pipe2.off"}, "'pipe1.off' is no command of impinge");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"clash", "pipe1.off", "-x"}, {"clash", "pipe1.off", "--frobnicate"}, {"pipe1.off"}})
    EXPECT_EQ(error(words).find("did you mean"), std::string::npos) << words.back() << " is no slip of anything";
}

TEST_F(Advice, WhatIsNoEarlierReportIsRefused) {
  const auto told = [&](const std::string& text) {
    folder.write("old", text);
    return error({"clash", "pipe1.off", "pipe2.off", "--previous", "old"});
  };
  const std::string no_report =
      "impinge: old:1: this is no report of an earlier run, which impinge clash FILE... --json REPORT writes: ";
  for (const char* text : {"", "solid pipe\n", "rank,verdict,fails\r\n"})
    EXPECT_TRUE(told(text).starts_with("impinge: old:1:")) << text;
  EXPECT_EQ(told("[1]"), no_report + "it has no \"version\"\n");
  EXPECT_EQ(told(R"({"tests":[{"name":"t","a":"*"}]})"), no_report + "it has no \"version\"\n");
  // Documents of the other commands, as they are written.
  EXPECT_EQ(told(impinge(folder, {"info", "pipe1.off", "--json", "-"}).out), no_report + "it has no \"objects\"\n");
  EXPECT_EQ(told(impinge(folder, {"check", "pipe1.off", "pipe2.off", "--json", "-"}).out),
            no_report + "it has no \"resolved\"\n")
      << "though nothing touches";
  EXPECT_EQ(told(R"({"version":1,"animation":{},"settings":{},"objects":[],"spans":[]})"),
            no_report + "it has no \"pairs\"\n");
  // What people add to a report does not make it another document.
  json report = json::parse(clash({"--json", "-"}).out);
  report["reviewers"] = report["truncated"] = 1;
  folder.write("old", report.dump());
  EXPECT_EQ(clash({"--previous", "old"}).code, 0);
}

TEST_F(Advice, AFirstRunHasNoEarlierReport) {
  folder.write("broken.off", "OFF\n");
  EXPECT_EQ(error({"clash", "broken.off", "--previous", "last.json"}),
            "impinge: --previous last.json: there is no such file; a first run has nothing to compare with: leave "
            "--previous out, and write last.json with --json\n")
      << "before any other file is read";
}

TEST_F(Advice, WhatIsNoConfigurationIsRefused) {
  const std::string none =
      "this is no configuration, such as {\"tests\": [{\"name\": \"all\", \"a\": \"*\"}]} (docs/triage.md): ";
  const auto told = [&](const std::string& text) {
    folder.write("c.json", text);
    return error({"clash", "pipe1.off", "pipe2.off", "--config", "c.json"});
  };
  for (const char* text : {"", "tests: all\n", "true", "<!doctype html>"})
    EXPECT_TRUE(told(text).starts_with("impinge: c.json:1:")) << text;
  const std::string report = told(clash({"--json", "-"}).out);
  EXPECT_EQ(report, "impinge: c.json:1: /version: " + none + "it is a report, as --json writes it\n");
  // The one that is shown is one.
  folder.write("c.json", R"({"tests": [{"name": "all", "a": "*"}]})");
  EXPECT_EQ(clash({"--config", "c.json"}).code, 0);
}

TEST_F(Advice, APairThatGotWorseIsMarked) {
  const auto run = [&](const std::vector<int>& lo, const std::vector<std::string>& more) {
    folder.write("lid.off", off(box({lo[0], lo[1], lo[2]}, {lo[0] + 2, lo[1] + 1, lo[2] + 1})));
    return impinge(folder,
                   joined({"clash", "c/slab.off", "lid.off", "--fail-on", "contact", "--json", "now.json"}, more));
  };
  // The top of the slab is at 0.
  EXPECT_TRUE(run({2, 2, 0}, {}).out.starts_with("verdict   part  part\ntouching  slab  lid\n"));
  std::filesystem::rename(folder.path() / "now.json", folder.path() / "old.json");
  const std::string same = run({2, 2, 0}, {"--previous", "old.json"}).out;
  EXPECT_NE(same.find("touching  slab  lid   persisting"), std::string::npos) << same;
  EXPECT_NE(same.find("1 persisting, 0 resolved.\n"), std::string::npos) << same;
  const std::string worse = run({2, 2, -1}, {"--previous", "old.json"}).out;
  EXPECT_NE(worse.find("inside   lid   slab  worse"), std::string::npos) << worse;
  EXPECT_NE(worse.find("1 persisting, 0 resolved; 1 worse than before.\n"), std::string::npos) << worse;
  std::filesystem::rename(folder.path() / "now.json", folder.path() / "old.json");
  const std::string better = run({2, 2, 0}, {"--previous", "old.json"}).out;
  EXPECT_NE(better.find("touching  slab  lid   persisting"), std::string::npos) << better;
  // With a contact elsewhere as well it is both.
  folder.write("lid.off", off(box({19, 2, -1}, {25, 3, 0})));
  const Ended both =
      impinge(folder, {"clash", "c/slab.off", "lid.off", "--fail-on", "contact", "--previous", "now.json"});
  EXPECT_NE(both.out.find("worse, new region"), std::string::npos) << both.out;
}

}  // namespace
}  // namespace impinge::test
