// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What is said where a command is probably not what its author means: options that have no effect, words that are
// nearly right, and files that are others than they are taken for.
#include <algorithm>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

/// Two pipes 3 apart that lie on a slab.
class Advice : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder.path() / "c");
    write_off(folder, {{"pipe1", box({0, 0, 0}, {20, 2, 2})},
                       {"pipe2", box({0, 5, 0}, {20, 7, 2})},
                       {"c/slab", box({-1, -1, -1}, {21, 8, 0})}});
  }
  [[nodiscard]] Ended clash(const Words& more) const {
    return impinge(folder, joined({"clash", "pipe1.off", "pipe2.off"}, more));
  }
  [[nodiscard]] std::string error(const Words& words) const { return refusal(folder, words); }
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
      "is meant\n";
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
  EXPECT_THAT(told,
              HasSubstr("impinge: sets.json: 95 sources more with a selector and no \"mode\"; add a mode to each\n"));
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
    const Words words{"clash", "pipe1.off", "pipe2.off", "--config", "c/clash.json", "--scale", file + "=3"};
    return document(folder, words, 0).at("objects").at(2).at("volume").get<double>();
  };
  for (const char* file : {"c/slab.off", "slab.off", "./c/slab.off"}) EXPECT_EQ(volume(file), 22 * 9 * 27) << file;
  EXPECT_EQ(error({"clash", "pipe1.off", "--config", "c/clash.json", "--scale", "slap.off=3"}),
            "impinge: --scale slap.off=3: it is none of the files to read, on the command line or in c/clash.json; the "
            "nearest name is 'c/slab.off'\n");
  EXPECT_THAT(error({"clash", "--config", "c/clash.json", "--scale", "slab.off=3", "--scale", "c/slab.off=2"}),
              HasSubstr("--scale c/slab.off=2: this file has a scale already, 3"));
  folder.write("c/clash.json", R"({"files":[{"file":"slab.off","scale":2}],"tests":[{"name":"t","a":"*"}]})");
  EXPECT_EQ(
      error({"clash", "pipe1.off", "--config", "c/clash.json", "--scale", "c/slab.off=3"}),
      "impinge: --scale c/slab.off=3: this file has a scale already, 2, here or in c/clash.json; leave one out\n");
}

TEST_F(Advice, UnknownOptionsAndCommandsHaveTheNearestNamed) {
  const auto suggests = [&](const Words& words, const char* part) { EXPECT_THAT(error(words), HasSubstr(part)); };
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
  for (const Words& words : {Words{"clash", "pipe1.off", "-x"}, {"clash", "pipe1.off", "--frobnicate"}, {"pipe1.off"}})
    EXPECT_THAT(error(words), Not(HasSubstr("did you mean"))) << words.back() << " is no slip of anything";
}

TEST_F(Advice, WhatIsNoEarlierReportIsRefused) {
  const auto told = [&](const std::string& text) {
    folder.write("old", text);
    return error({"clash", "pipe1.off", "pipe2.off", "--previous", "old"});
  };
  const std::string no_report =
      "impinge: old:1: this is no report of an earlier run, which impinge clash FILE... --json REPORT writes: ";
  for (const char* text : {"", "solid pipe\n", "rank,verdict,fails\r\n"})
    EXPECT_THAT(told(text), StartsWith("impinge: old:1:")) << text;
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
    EXPECT_THAT(told(text), StartsWith("impinge: c.json:1:")) << text;
  EXPECT_EQ(told(clash({"--json", "-"}).out),
            "impinge: c.json:1: /version: " + none + "it is a report, as --json writes it\n");
  // The one that is shown is one.
  folder.write("c.json", R"({"tests": [{"name": "all", "a": "*"}]})");
  EXPECT_EQ(clash({"--config", "c.json"}).code, 0);
}

TEST_F(Advice, APairThatGotWorseIsMarked) {
  const auto run = [&](const std::vector<int>& lo, const Words& more) {
    folder.write("lid.off", off(box({lo[0], lo[1], lo[2]}, {lo[0] + 2, lo[1] + 1, lo[2] + 1})));
    return impinge(folder,
                   joined({"clash", "c/slab.off", "lid.off", "--fail-on", "contact", "--json", "now.json"}, more));
  };
  // The top of the slab is at 0.
  EXPECT_THAT(run({2, 2, 0}, {}).out, StartsWith("verdict   part  part\ntouching  slab  lid\n"));
  std::filesystem::rename(folder.path() / "now.json", folder.path() / "old.json");
  const std::string same = run({2, 2, 0}, {"--previous", "old.json"}).out;
  EXPECT_THAT(same, HasSubstr("touching  slab  lid   persisting"));
  EXPECT_THAT(same, HasSubstr("1 persisting, 0 resolved.\n"));
  const std::string worse = run({2, 2, -1}, {"--previous", "old.json"}).out;
  EXPECT_THAT(worse, HasSubstr("inside   lid   slab  worse"));
  EXPECT_THAT(worse, HasSubstr("1 persisting, 0 resolved; 1 worse than before.\n"));
  std::filesystem::rename(folder.path() / "now.json", folder.path() / "old.json");
  const std::string better = run({2, 2, 0}, {"--previous", "old.json"}).out;
  EXPECT_THAT(better, HasSubstr("touching  slab  lid   persisting"));
  // With a contact elsewhere as well it is both.
  folder.write("lid.off", off(box({19, 2, -1}, {25, 3, 0})));
  const Ended both =
      impinge(folder, {"clash", "c/slab.off", "lid.off", "--fail-on", "contact", "--previous", "now.json"});
  EXPECT_THAT(both.out, HasSubstr("worse, new region"));
}

}  // namespace
}  // namespace impinge::test
