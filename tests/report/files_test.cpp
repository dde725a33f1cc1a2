// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Several outputs in one run: each appears whole or not at all, and is the same bytes each time.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <map>
#include <thread>

#include "impinge/report.hpp"
#include "tests/cli/meshes.hpp"
#include "tests/cli/program.hpp"

namespace impinge::test {
namespace {

using namespace std::chrono_literals;

struct Output {
  std::string option, name, beginning;
};
const std::vector<Output> kOutputs{{"--json", "out.json", "{"},
                                   {"--html", "out.html", kPageHead},
                                   {"--csv", "out.csv", "rank,verdict,"},
                                   {"--bcf", "out.bcf", "PK\3\4"},
                                   {"--gltf", "out.glb", "glTF"}};

class Files : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("a.off", off(box({0, 0, 0}, {2, 2, 2})));
    folder.write("b.off", off(box({1, 1, 1}, {3, 3, 3})));
    folder.write("page.html", kPageHead + "<html><!-- impinge: data --></html>\n");
    launch.environment["SOURCE_DATE_EPOCH"] = "0";
    launch.environment["IMPINGE_PAGE"] = (folder.path() / "page.html").string();
  }
  [[nodiscard]] Ended clash(const std::vector<std::string>& more) const {
    return impinge(folder, joined({"clash", "a.off", "b.off", "--quiet"}, more), launch);
  }
  [[nodiscard]] static std::vector<std::string> all(const std::string& where = "") {
    std::vector<std::string> words;
    for (const Output& output : kOutputs) words.insert(words.end(), {output.option, where + output.name});
    return words;
  }
  [[nodiscard]] std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> found;
    for (const std::string& name : folder.names()) found[name] = folder.read(name);
    return found;
  }
  Folder folder;
  Launch launch;
};

TEST_F(Files, AllComeFromOneRunWithTheSameBytesEachTime) {
  ASSERT_EQ(clash(all()).code, 1);
  const auto first = contents();
  for (const Output& output : kOutputs) EXPECT_TRUE(first.at(output.name).starts_with(output.beginning)) << output.name;
  using Words = std::vector<std::string>;
  for (const Words& more : {Words{"--threads", "1"}, {"--threads", "3"}, {"--threads", "4"}, {"--backend", "paper"}}) {
    ASSERT_EQ(clash(joined(all(), more)).code, 1);  // over the earlier ones
    EXPECT_TRUE(contents() == first) << more[1];
  }
}

TEST_F(Files, OnlyWhatEndsAsSuchADocumentIsReplacedUnlessForced) {
  const std::string foreign = "a letter to somebody\n";
  for (const Output& output : kOutputs) {
    SCOPED_TRACE(output.option);
    folder.write(output.name, foreign);
    EXPECT_EQ(clash({output.option, output.name}).code, 1) << "its own by name";
    EXPECT_TRUE(folder.read(output.name).starts_with(output.beginning));
    // Names of other kinds, and links to such.
    std::filesystem::create_symlink("letter.txt", folder.path() / ("to-letter-" + output.name));
    for (const std::string& name : {std::string("letter"), std::string("letter.txt"), "to-letter-" + output.name}) {
      folder.write(name, foreign);
      const Ended run = clash({output.option, name});
      EXPECT_EQ(run.code, 2) << name;
      EXPECT_NE(
          run.err.find("so it is not replaced: the word after " + output.option + " is the file to write; --force"),
          std::string::npos)
          << run.err;
      EXPECT_EQ(folder.read(name), foreign);
      EXPECT_EQ(clash({output.option, name, "--force"}).code, 1);
      EXPECT_TRUE(folder.read(name).starts_with(output.beginning)) << name;
    }
    folder.write("letter.txt", "");
    EXPECT_EQ(clash({output.option, "letter.txt"}).code, 1) << "an empty file is free";
  }
  folder.write("topics.bcfzip", foreign);
  EXPECT_EQ(clash({"--bcf", "topics.bcfzip"}).code, 1);
}

TEST_F(Files, WhatIsReadIsNeverReplaced) {
  folder.write("clash.json", R"({"tests":[{"name":"all","a":"*"}]})");
  folder.write("decisions.json", "{}");
  std::filesystem::create_symlink("a.off", folder.path() / "a.json");
  const auto before = contents();
  for (const char* name : {"a.off", "./b.off", "a.json", "clash.json", "decisions.json"}) {
    const Ended run = clash({"--json", name, "--config", "clash.json", "--decisions", "decisions.json", "--force"});
    EXPECT_EQ(run.code, 2) << name;
    EXPECT_NE(run.err.find("is one of the files to read"), std::string::npos) << run.err;
  }
  EXPECT_TRUE(contents() == before);
}

TEST_F(Files, OnePlaceTakesOneDocument) {
  std::filesystem::create_directory(folder.path() / "sub");
  std::filesystem::create_symlink("sub", folder.path() / "link");
  std::filesystem::create_symlink("sub/new", folder.path() / "dangling");
  for (const auto& [first, second] : std::vector<std::pair<std::string, std::string>>{{"out", "out"},
                                                                                      {"out", "./out"},
                                                                                      {"sub/out", "link/out"},
                                                                                      {"out", "sub/../out"},
                                                                                      {"dangling", "sub/new"},
                                                                                      {"sub/new", "dangling"},
                                                                                      {"-", "-"}}) {
    const Ended run = clash({"--csv", first, "--gltf", second});
    EXPECT_EQ(run.code, 2) << second;
    EXPECT_NE(run.err.find("--csv and --gltf cannot both go to"), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
  }
  EXPECT_EQ(clash({"--csv", "out", "--gltf", "sub/out"}).code, 1);
}

TEST_F(Files, APlaceThatCannotBeWrittenIsSaidBeforeTheWork) {
  const auto before = contents();
  for (const Output& output : kOutputs)
    for (const std::string place : {"missing/out", ".", "a.off/out", "/dev/null/out"}) {
      const Ended run = clash({output.option, place});
      EXPECT_EQ(run.code, 2) << output.option << ' ' << place;
      EXPECT_TRUE(run.err.starts_with("impinge: ") && run.err.find(place) != std::string::npos) << run.err;
      EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
  EXPECT_TRUE(contents() == before);
}

/// The JSON is what the next run compares with: it is not to be of a run that failed.
TEST_F(Files, OneThatCannotBeWrittenLeavesAllTheOthers) {
  ASSERT_EQ(clash(all()).code, 1);
  const auto before = contents();
  for (const Output& full : kOutputs) {
    std::vector<std::string> words{"--clearance", "1"};  // other bytes than before
    for (const Output& output : kOutputs)
      words.insert(words.end(), {output.option, output.name == full.name ? "/dev/full" : output.name});
    const Ended run = clash(words);
    EXPECT_EQ(run.code, 2);
    EXPECT_EQ(run.err, "impinge: cannot write to '/dev/full': No space left on device\n");
    EXPECT_TRUE(contents() == before) << full.option;
  }
}

TEST_F(Files, AFileThatCannotGrowLeavesTheOldOne) {
  ASSERT_EQ(clash(all()).code, 1);
  const auto before = contents();
  folder.write("c.off", off(box({-1, -1, -1}, {1, 1, 1})));
  for (const Output& output : kOutputs) {
    // As a full disk does, but without one: no file may be longer than 512 bytes.
    const Ended run =
        shell(folder, "ulimit -f 1; IMPINGE_PAGE=" + launch.environment["IMPINGE_PAGE"] +
                          " impinge clash a.off b.off c.off --quiet " + output.option + " " + output.name);
    EXPECT_EQ(run.code, 2) << output.option;
    EXPECT_NE(run.err.find("cannot write to"), std::string::npos) << run.err;
    auto after = contents();
    after.erase("c.off");
    EXPECT_TRUE(after == before) << output.option;
  }
}

TEST_F(Files, AnInterruptWhileTopicsAreDrawnLeavesTheOldArchive) {
  // 50 cubes that all meet each other: 1,225 topics.
  std::vector<std::string> words{IMPINGE_PROGRAM, "clash",     "--quiet", "--csv",        "out.csv", "--bcf",
                                 "out.bcf",       "--threads", "2",       "--bcf-topics", "2000"};
  for (int i = 0; i < 50; ++i) {
    const std::string name = "c" + std::to_string(i) + ".off";
    folder.write(name, off(box({i, i, i}, {i + 100, i + 100, i + 100})));
    words.push_back(name);
  }
  ASSERT_NE(clash({"--bcf", "out.bcf"}).code, 2);
  const std::string older = folder.read("out.bcf");
  ASSERT_FALSE(older.empty());
  Running running(folder, words);
  ASSERT_TRUE(running.handles(SIGINT, 20s));
  const auto names = [&] {
    std::vector<std::string> found;
    for (const std::string& name : folder.names())
      if (name.starts_with("out.bcf")) found.push_back(name);
    return found;
  };
  // The archive is written beside the older one.
  const auto last = std::chrono::steady_clock::now() + 60s;
  while (names().size() < 2 && std::chrono::steady_clock::now() < last) std::this_thread::sleep_for(5ms);
  std::this_thread::sleep_for(100ms);
  running.send(SIGINT);
  const Ended run = running.wait();
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err, "impinge: interrupted; there is no result\n");
  EXPECT_EQ(names(), std::vector<std::string>{"out.bcf"});
  EXPECT_TRUE(folder.read("out.bcf") == older);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.csv"));
}

TEST_F(Files, OptionsThatSayNothingAreRefused) {
  const auto refused = [&](const std::vector<std::string>& words, const std::string& part) {
    const Ended run = clash(words);
    EXPECT_EQ(run.code, 2) << part;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
  };
  refused({"--date", "2024-01-01"}, "--date requires --bcf");
  refused({"--bcf-topics", "3", "--csv", "out.csv"}, "--bcf-topics requires --bcf");
  refused({"--author", "Ann"}, "--author requires --bcf");
  refused({"--due", "2024-01-01"}, "--due requires --bcf");
  refused({"--due", "Friday", "--bcf", "out.bcf"}, "--due takes now, or a date such as 2024-05-31, not 'Friday'");
  refused({"--stage", "LPH 5"}, "--stage requires --bcf");
  refused({"--author", " ", "--bcf", "out.bcf"}, "an author has a name");
  refused({"--bcf-version", "2.0", "--bcf", "out.bcf"}, "--bcf-version takes 2.1|3.0, not '2.0'");
  refused({"--up", "y"}, "--up is for --html FILE, --csv FILE, --bcf FILE and --gltf FILE");
  refused({"--up", "x", "--html", "out.html"}, "'x'");
  refused({"--unit", "miles", "--bcf", "out.bcf"}, "'miles'");
  refused({"--up", "x", "--gltf", "out.glb"}, "'x'");
  refused({"--date", "2023-02-29", "--bcf", "out.bcf"}, "'2023-02-29'");
  refused({"--bcf-topics", "many", "--bcf", "out.bcf"}, "'many'");
  refused({"--bcf-topics", "20001", "--bcf", "out.bcf"}, "20000");
}

/// What the library's own calls write, of clashes that it looks for and of clashes that are known.
TEST_F(Files, AReportOfKnownClashesIsThatOfTheSameScene) {
  report::ReportOptions options;
  options.files = {(folder.path() / "a.off").string(), (folder.path() / "b.off").string()};
  options.regions = true;
  options.page_program = (folder.path() / "page.html").string();
  const auto read = [&] { return *report::read_assembly(options); };
  Scene scene;
  for (const io::Object& object : read().objects) ASSERT_TRUE(scene.add(object.mesh, object.pose));
  const Clashes clashes = *find_clashes(scene, {.regions = true});
  const auto bytes = [&](const Result<report::Report>& found,
                         Result<void> (*write)(const report::Report&, const std::string&), const char* name) {
    EXPECT_TRUE(found) << found.error().message;
    EXPECT_TRUE(write(*found, (folder.path() / name).string()));
    return folder.read(name);
  };
  const auto known = report::review(read(), clashes, options), looked_for = report::review(read(), options);
  EXPECT_EQ(bytes(known, report::write_csv, "x.csv"), bytes(looked_for, report::write_csv, "y.csv"));
  EXPECT_EQ(bytes(known, report::write_bcf, "x.bcf"), bytes(looked_for, report::write_bcf, "y.bcf"));
  EXPECT_TRUE(bytes(known, report::write_page, "x.html").starts_with(kPageHead));

  Clashes of_one = clashes;
  of_one.parts.pop_back();
  EXPECT_EQ(report::review(read(), of_one, options).error().message,
            "the clashes are of 1 parts, and the assembly has 2");
  options.between.emplace(options.files[0], options.files[1]);
  EXPECT_EQ(report::review(read(), clashes, options).error().code, Code::bad_option);
}

}  // namespace
}  // namespace impinge::test
