// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What a reader could not read of a file is said wherever an answer without it is.
#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>

#include "io/import_stream.hpp"
#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

const std::string kLost = "3 of 15 triangles are missing", kLid = "its lid is left out";

/// A file of one triangle, by an importer that says that something of it is lost.
class Missing : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("a.dae", "<COLLADA/>");
    folder.write("page.html", kPageHead + "<html><!-- impinge: data --></html>\n");
    const std::filesystem::path stream = folder.path() / "stream", importer = folder.path() / "importer";
    const int descriptor = ::open(stream.c_str(), O_WRONLY | O_CREAT, 0600);
    ASSERT_GE(descriptor, 0);
    io::ImportWriter writer(descriptor);
    writer.missing(kLost);
    const std::vector<double> xyz{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::vector<std::uint32_t> triangle{0, 1, 2};
    writer.mesh(xyz, triangle);
    writer.object("bolt", "bolt", "", 0, io::kNoNode, io::kNoNode, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    writer.incomplete(kLid);
    ASSERT_TRUE(writer.end());
    ::close(descriptor);
    folder.write("importer", "#!/bin/sh\nexec cat '" + stream.string() + "'\n");
    std::filesystem::permissions(importer, std::filesystem::perms::owner_all);
    launch.environment["IMPINGE_IMPORTER"] = importer.string();
    launch.environment["IMPINGE_PAGE"] = (folder.path() / "page.html").string();
  }
  Folder folder;
  Launch launch;
};

TEST_F(Missing, FilesAreNotTurned) {
  folder.write("a.3mf", "PK");
  EXPECT_THAT(impinge(folder, {"check", "gone.glb", "a.3mf", "--skip-unreadable"}, launch).err,
              HasSubstr("a.3mf was turned so that Y is up, as in gone.glb"));
  EXPECT_THAT(impinge(folder, {"check", "a.3mf", "gone.glb", "--skip-unreadable"}, launch).err,
              Not(HasSubstr("was turned")));
}

TEST_F(Missing, IsSaidWithEveryAnswer) {
  for (const char* const command : {"check", "clash"}) {
    const Ended run = impinge(folder, {command, "a.dae", "--quiet", "--json", "-"}, launch);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.err, "impinge: a.dae: " + kLost + "\n");
    EXPECT_EQ(json::parse(run.out).at("missing"), json::array({"a.dae: " + kLost}));
  }
  EXPECT_THAT(impinge(folder, {"info", "a.dae"}, launch).out, HasSubstr("warning: " + kLost));
}

TEST_F(Missing, MarksPartsAndWhatRestsOnThem) {
  folder.write("b.off", off(cube(-1, -1, -1)));
  const Ended clash = impinge(
      folder,
      {"clash", "a.dae", "b.off", "--scale", "b.off=1", "--json", "out.json", "--csv", "out.csv", "--html", "out.html"},
      launch);
  const json answer = json::parse(folder.read("out.json"));
  EXPECT_EQ(answer.at("objects").at(0).at("incomplete"), kLid);
  EXPECT_TRUE(answer.at("objects").at(1).at("incomplete").is_null());
  ASSERT_EQ(answer.at("pairs").size(), 1U);
  EXPECT_EQ(answer.at("pairs").at(0).at("incomplete"), "a");
  const std::string table = folder.read("out.csv");
  EXPECT_THAT(table, HasSubstr(",a,,,,0.9"));
  EXPECT_THAT(table, HasSubstr("\r\n,missing,"));
  EXPECT_THAT(table, HasSubstr(",a.dae: " + kLost + ","));
  EXPECT_THAT(clash.out, HasSubstr("  incomplete"));
  EXPECT_THAT(clash.out, HasSubstr("bolt is incomplete: " + kLid + "\n"));
  const Ended info = impinge(folder, {"info", "a.dae", "b.off", "--json", "out.json"}, launch);
  EXPECT_THAT(info.out, HasSubstr("bolt is incomplete: " + kLid + "\n"));
  const json files = json::parse(folder.read("out.json")).at("files");
  EXPECT_EQ(files.at(0).at("objects").at(0).at("incomplete"), kLid);
  EXPECT_TRUE(files.at(1).at("objects").at(0).at("incomplete").is_null());
}

TEST_F(Missing, IsOnThePage) {
  for (const char* const command : {"view", "clash"}) {
    const Ended run = impinge(folder, {command, "a.dae", "--quiet", "--html", "out.html"}, launch);
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.err, "impinge: a.dae: " + kLost + "\n");
    EXPECT_THAT(folder.read("out.html"), HasSubstr(R"("missing":["a.dae: )" + kLost));
  }
}

TEST_F(Missing, FilesAreSkippedOnlyIfAsked) {
  folder.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  folder.write("b.off", "OFF\n3 1 0\n0.1 0.1 -1\n0.1 0.1 1\n0.2 0.1 1\n3 0 1 2\n");
  folder.write("bad.off", "OFF\n3 1 0\n0.1 0.1 -1\n");
  const Words good{"clash", "a.off", "b.off", "--quiet", "--json", "last.json"};
  EXPECT_EQ(impinge(folder, good, launch).code, 1);
  std::filesystem::rename(folder.path() / "b.off", folder.path() / "kept.off");
  folder.write("b.off", folder.read("bad.off"));
  Words run{"clash", "a.off", "b.off",  "--quiet", "--json",     "j.json",
            "--csv", "c.csv", "--html", "p.html",  "--previous", "last.json"};
  EXPECT_EQ(impinge(folder, run, launch).code, 2);
  run.emplace_back("--skip-unreadable");
  const Ended ended = impinge(folder, run, launch);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, StartsWith("impinge: skipped: b.off, line "));
  const json answer = json::parse(folder.read("j.json"));
  EXPECT_EQ("impinge: " + answer.at("missing").at(0).get<std::string>() + "\n", ended.err);
  EXPECT_EQ(answer.at("resolved").size(), 0U) << "nobody knows";
  EXPECT_THAT(folder.read("p.html"), HasSubstr("skipped: b.off"));
  EXPECT_THAT(folder.read("c.csv"), HasSubstr(",skipped,"));
  EXPECT_TRUE(answer.at("files").at(0).at("error").is_null());
  EXPECT_EQ(answer.at("files").at(1).at("error"), answer.at("missing").at(0));
  for (const char* const command : {"check", "view", "clash"}) {
    EXPECT_THAT(
        refusal(folder, {command, "bad.off", "b.off", "--skip-unreadable"}, launch),
        AllOf(StartsWith("impinge: none of the 2 files can be read: bad.off, line "), HasSubstr("; b.off, line ")));
  }
}

TEST_F(Missing, NothingIsFoundClearOfASkippedFile) {
  const std::string triangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const char* const name : {"a.off", "c.off"}) folder.write(name, triangle);
  folder.write("b.off", "OFF\n3 1 0\n");
  const auto clash = [&](const Words& words) {
    const Ended run = impinge(folder, joined({"clash", "a.off", "c.off", "b.off", "--skip-unreadable"}, words), launch);
    return run.code == 2 ? run.err : "ended with " + std::to_string(run.code);
  };
  const std::string skipped = "; skipped: b.off, line 2: ";
  const auto expect = [&](const Words& words, const std::string& begin) {
    EXPECT_THAT(clash(words), StartsWith("impinge: " + begin + skipped));
  };
  expect({"--between", "a.off", "b.off"},
         "--between b.off: it could not be read, so no pair of it is judged; mend it, or leave out --between");
  EXPECT_EQ(clash({"--between", "a.off", "c.off"}), "ended with 1");
  expect({"--ignore", "a", "b"}, "--ignore: nothing is named 'b'; the nearest name is 'a'");
  const auto configured = [&](const std::string& group) {
    folder.write("t.json", R"({"files":["a.off"],"tests":[{"name":"t","a":{"file":"a.off"},"b":)" + group + "}]}");
    return Words{"--config", "t.json"};
  };
  expect(configured(R"({"file":"b.off"})"), "t.json:1: /tests/0/b: no part is in this group");
  expect(configured(R"("bolt")"), "t.json:1: /tests/0/b: nothing is named 'bolt'; the nearest name is 'a'");
  // A file that is not there is skipped as well, whoever names it.
  folder.write("t.json", R"({"files":["a.off","gone.off"],"tests":[{"name":"t","a":{"file":["a.off","c.off"]}}]})");
  EXPECT_EQ(clash({"--config", "t.json"}), "ended with 1");
  folder.write("t.json", R"({"files":["a.off"],"tests":[{"name":"t","a":{"file":["a.off","gone.off"]},"b":"c"}]})");
  EXPECT_EQ(clash({"--config", "t.json"}), "ended with 1");
}

TEST_F(Missing, AnswersWithoutPairsNameSkippedFiles) {
  folder.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  folder.write("b.off", "OFF");
  for (const char* const version : {"2.1", "3.0"}) {
    const Ended run = impinge(folder,
                              {"clash", "a.off", "b.off", "--skip-unreadable", "--matrix", "m.csv", "--gltf", "g.glb",
                               "--bcf", "b.bcf", "--bcf-version", version, "--quiet"},
                              launch);
    EXPECT_EQ(run.code, 0) << run.err;
    const std::string sentence = run.err.substr(9, run.err.size() - 10);
    EXPECT_EQ(folder.read("m.csv"), "by,a,b,pairs,fail\r\nskipped,b.off,,,\r\n");
    EXPECT_THAT(folder.read("g.glb"), HasSubstr("\"missing\":[\"" + sentence + "\"]")) << sentence;
    // A topic that a later run takes no decision from.
    EXPECT_TRUE(document(folder, {"clash", "a.off", "--decisions", "b.bcf"}, 0, launch).at("decisions").empty());
  }
}

TEST_F(Missing, FilesAreReadAtOnceAndSpokenOfInTheirOrder) {
  folder.write("bad.off", "OFF\n3 1 0\n0.1 0.1 -1\n");
  for (const char* const name : {"late.dae", "endless.dae"}) folder.write(name, "<COLLADA/>");
  folder.write("importer",
               "#!/bin/sh\ncase $1 in\n*late.dae) sleep 0.3; exit 3;;\n*endless.dae) exec sleep 60;;\nesac\n" +
                   folder.read("importer"));
  const std::string late = "late.dae: the importer ended with status 3", bad = "bad.off, line 2: ";
  for (const char* const threads : {"1", "3"}) {
    SCOPED_TRACE(threads);
    const auto check = [&](Words files) {
      return impinge(folder, joined({"check", "--quiet", "--threads", threads}, files), launch);
    };
    EXPECT_THAT(check({"late.dae", "bad.off"}).err, StartsWith("impinge: " + late));
    EXPECT_THAT(check({"a.dae", "bad.off", "late.dae"}).err, StartsWith("impinge: " + bad));
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THAT(check({"bad.off", "endless.dae"}).err, StartsWith("impinge: " + bad));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30))
        << "what follows an error is given up";
    const Ended skipping = check({"late.dae", "a.dae", "bad.off", "--skip-unreadable", "--json", "-"});
    EXPECT_EQ(skipping.code, 0) << skipping.err;
    const json missing = json::parse(skipping.out).at("missing");
    ASSERT_EQ(missing.size(), 3U);
    EXPECT_EQ(missing.at(0), "a.dae: " + kLost);
    EXPECT_THAT(missing.at(1).get<std::string>(), StartsWith("skipped: " + late)) << missing;
    EXPECT_THAT(missing.at(2).get<std::string>(), StartsWith("skipped: " + bad)) << missing;
  }
}

TEST_F(Missing, IsNoMemberWhereNothingIs) {
  folder.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_FALSE(document(folder, {"clash", "a.off", "--quiet"}, 0, launch).contains("missing"));
}

}  // namespace
}  // namespace impinge::test
