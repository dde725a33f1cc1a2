// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What people wrote about a pair stays with this pair, or with none.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;

class Approval : public testing::Test {
 protected:
  /// The report of a run in the folder, whose pairs must all have ids of their own.
  json run(const std::vector<std::string>& words, const std::string& in = ".") {
    std::string line = "cd " + in + " && rm -f out.json && impinge clash --json out.json --quiet";
    for (const std::string& word : words) line += " '" + word + "'";
    const Ended ended = shell(folder, line);
    EXPECT_LE(ended.code, 1) << ended.err;
    if (ended.code > 1) return {};
    json report = json::parse(folder.read(in + "/out.json"));
    std::set<std::string> ids;
    for (const json& pair : report.at("pairs")) EXPECT_TRUE(ids.insert(pair.at("id").get<std::string>()).second);
    return report;
  }
  /// That of two parts, each by the end of its file's name or by its path.
  static json& pair_of(json& report, const std::string& a, const std::string& b) {
    for (json& pair : report.at("pairs")) {
      const auto says = [&](const char* side, const std::string& what) {
        const json& part = report.at("objects").at(pair.at(side).get<std::size_t>());
        return part.at("file").get<std::string>().ends_with(what) || part.at("path") == what;
      };
      if ((says("a", a) && says("b", b)) || (says("b", a) && says("a", b))) return pair;
    }
    ADD_FAILURE() << "no pair of " << a << " and " << b;
    static json none = json::object();
    return none;
  }
  void keep(json& report, const std::string& name) { folder.write(name, report.dump()); }
  Folder folder;
};

TEST_F(Approval, StaysWithItsFileAmongFilesOfOneName) {
  for (const char* name : {"project", "project/left", "project/right", "elsewhere"})
    std::filesystem::create_directory(folder.path() / name);
  folder.write("project/left/part.off", off(box({0, 0, 0}, {2, 2, 2})));
  folder.write("project/right/part.off", off(box({10, 0, 0}, {12, 2, 2})));
  folder.write("project/plate.off", off(box({-1, 1, 1}, {20, 3, 3})));
  json first = run({"left/part.off", "right/part.off", "plate.off"}, "project");
  ASSERT_EQ(first.at("pairs").size(), 2U);
  pair_of(first, "left/part.off", "plate.off")["status"] = "approved";
  keep(first, "last.json");
  const auto expect_kept = [&](json report) {
    for (const char* side : {"left/part.off", "right/part.off"}) {
      const json& pair = pair_of(report, side, "plate.off");
      EXPECT_EQ(pair.at("id"), pair_of(first, side, "plate.off").at("id"));
      EXPECT_EQ(pair.at("change"), "persisting");
      EXPECT_EQ(pair.at("ambiguous"), false);
    }
    EXPECT_EQ(pair_of(report, "left/part.off", "plate.off").at("status"), "approved");
    EXPECT_TRUE(pair_of(report, "right/part.off", "plate.off").at("status").is_null());
    EXPECT_TRUE(report.at("resolved").empty());
  };
  const std::vector<std::string> previous{"--previous", (folder.path() / "last.json").string()};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.end(), previous.begin(), previous.end());
    return words;
  };
  expect_kept(run(with({"right/part.off", "plate.off", "left/part.off"}), "project"));
  // A file that has nothing to do with them, though it lies above; and a part that moved.
  folder.write("other.off", off(box({50, 0, 0}, {52, 2, 2})));
  folder.write("project/left/part.off", off(box({4, 0, 0}, {6, 2, 2})));
  expect_kept(run(with({"../other.off", "right/part.off", "left/part.off", "plate.off"}), "project"));
  // The whole project elsewhere, under another name, and named from above.
  std::filesystem::rename(folder.path() / "project", folder.path() / "elsewhere/copy");
  expect_kept(run(with({"elsewhere/copy/right/part.off", "elsewhere/copy/left/part.off", "elsewhere/copy/plate.off"})));
}

TEST_F(Approval, IsNotForAFileThatTookTheName) {
  std::filesystem::create_directory(folder.path() / "sub");
  folder.write("part.off", off(box({0, 0, 0}, {2, 2, 2})));
  folder.write("sub/part.off", off(box({10, 0, 0}, {12, 2, 2})));
  folder.write("plate.off", off(box({-1, 1, 1}, {20, 3, 3})));
  json first = run({"part.off", "plate.off"});
  first.at("pairs").at(0)["status"] = "approved";
  keep(first, "last.json");
  const json both = run({"sub/part.off", "part.off", "plate.off", "--previous", "last.json"});
  ASSERT_EQ(both.at("pairs").size(), 2U);
  for (const json& pair : both.at("pairs")) {
    EXPECT_EQ(pair.at("change"), "new");
    EXPECT_TRUE(pair.at("status").is_null());
  }
  ASSERT_EQ(both.at("resolved").size(), 1U);
  EXPECT_EQ(both.at("resolved").at(0).at("status"), "approved") << "nothing that was written is lost";
  EXPECT_EQ(both.at("resolved").at(0).at("ambiguous"), false);
}

TEST_F(Approval, StaysWithItsPartAmongPartsOfOneName) {
  folder.write("a.gltf", gltf({{"bolt", {0, 0, 0}}, {"bolt", {10, 0, 0}}, {"left", {1, 1, 1}}, {"right", {11, 1, 1}}}));
  json first = run({"a.gltf"});
  ASSERT_EQ(first.at("pairs").size(), 2U);
  pair_of(first, "bolt", "right")["comment"] = "as agreed";
  keep(first, "last.json");
  // In another order and with more of them, what was "bolt (2)" is "bolt (3)".
  folder.write("a.gltf", gltf({{"bolt", {30, 0, 0}},
                               {"right", {11, 1, 1}},
                               {"bolt", {10, 0, 0}},
                               {"bolt", {0, 0, 0}},
                               {"far", {31, 1, 1}},
                               {"left", {1, 1, 1}}}));
  json second = run({"a.gltf", "--previous", "last.json"});
  ASSERT_EQ(second.at("pairs").size(), 3U);
  EXPECT_EQ(pair_of(second, "bolt", "right").at("comment"), "as agreed");
  EXPECT_EQ(pair_of(second, "bolt", "right").at("change"), "persisting");
  EXPECT_EQ(pair_of(second, "bolt", "left").at("change"), "persisting");
  EXPECT_TRUE(pair_of(second, "bolt", "left").at("comment").is_null());
  EXPECT_EQ(pair_of(second, "bolt", "far").at("change"), "new");
  EXPECT_TRUE(second.at("resolved").empty());
}

TEST_F(Approval, IsNotForTheLastNamesake) {
  const Node bolt{"bolt", {1, 0, 0}}, plate{"plate", {2, 1, 1}};
  const std::string text = gltf({bolt, plate});
  folder.write("a.gltf", text);
  json first = run({"a.gltf", "--regions"});
  ASSERT_EQ(first.at("pairs").size(), 1U);
  first.at("pairs").at(0)["status"] = "approved";
  first.at("pairs").at(0).at("regions").at(0)["comment"] = "here";
  keep(first, "1.json");
  folder.write("a.gltf", gltf({bolt, {"bolt", {3, 0, 0}}, plate}));
  json second = run({"a.gltf", "--previous", "1.json"});
  EXPECT_EQ(second.at("pairs").at(0).at("change"), "new");
  keep(second, "2.json");
  for (const bool stays : {true, false}) {
    SCOPED_TRACE(stays);
    // What is left is the bolt that was meant; or one that nobody has looked at.
    folder.write("a.gltf", stays ? text : gltf({{"bolt", {3, 0, 0}}, plate}));
    std::string previous = "2.json";
    for (int week = 0; week < 3; ++week) {
      const Ended ended = shell(folder, "rm -f out.json; impinge clash a.gltf --json out.json --previous " + previous);
      EXPECT_EQ(ended.err.find("such as bolt / plate, is not taken over: what has") != std::string::npos, !stays)
          << ended.err;
      const json report = json::parse(folder.read("out.json"));
      ASSERT_EQ(report.at("pairs").size(), 1U);
      const json& pair = report.at("pairs").at(0);
      EXPECT_EQ(pair.at("change"), week == 0 ? "new" : "persisting");
      EXPECT_EQ(pair.at("status"), stays ? json("approved") : json(nullptr));
      EXPECT_EQ(pair.at("regions").at(0).at("comment"), stays ? json("here") : json(nullptr));
      std::size_t kept = 0;
      for (const json& gone : report.at("resolved")) {
        if (gone.at("status").is_null()) continue;
        ++kept;
        EXPECT_EQ(gone.at("ambiguous"), true);
        EXPECT_EQ(gone.at("regions").at(0).at("comment"), "here");
      }
      EXPECT_EQ(kept, stays ? 0U : 1U);
      previous = "week.json";
      folder.write(previous, report.dump());
    }
  }
}

TEST_F(Approval, OfARegionIsNotForOneOfAnotherPart) {
  const auto comb = [](const std::vector<int>& places) {
    std::string text;
    int corners = 0;
    for (const int x : places) {
      const Solid solid = box({x, -2, -2}, {x + 2, 4, 4});
      for (const auto& [a, b, c] : solid.vertices) text += fmt::format("v {} {} {}\n", a, b, c);
      for (const auto& [a, b, c] : solid.triangles)
        text += fmt::format("f {} {} {}\n", corners + a + 1, corners + b + 1, corners + c + 1);
      corners += 8;
    }
    return text;
  };
  const auto write = [&](const std::string& combs) {
    folder.write("a.obj", "o bar\n" + obj(box({0, 0, 0}, {80, 2, 2})));
    folder.write("b.obj", combs);
  };
  write("o comb\n" + comb({10, 30}));
  json report = run({"a.obj", "b.obj", "--regions"});
  ASSERT_EQ(report.at("pairs").size(), 1U);
  ASSERT_EQ(report.at("pairs").at(0).at("regions").size(), 2U);
  for (json& region : report.at("pairs").at(0).at("regions"))
    if (region.at("centroid").at(0) > 20) region["comment"] = "here";
  keep(report, "last.json");
  // The prong goes, then the comb; then there is another comb, which at last has a prong in that place.
  for (const std::string& combs : {comb({10}), std::string(), comb({50}), comb({30, 50})}) {
    write(combs.empty() ? "o else\n" + comb({200}) : "o comb\n" + combs);
    report = run({"a.obj", "b.obj", "--previous", "last.json"});
    keep(report, "last.json");
    std::size_t kept = 0;
    for (const json& gone : report.at("resolved")) kept += gone.at("comment") == "here" ? 1 : 0;
    EXPECT_EQ(kept, 1U);
    for (const json& pair : report.at("pairs"))
      for (const json& region : pair.at("regions")) EXPECT_TRUE(region.at("comment").is_null());
  }
}

TEST_F(Approval, IsGivenToNoneOfTwins) {
  const std::vector<Node> nodes{{"bolt", {0, 0, 0}}, {"bolt", {0, 0, 0}}, {"plate", {1, 1, 1}}};
  folder.write("a.gltf", gltf(nodes));
  json first = run({"a.gltf", "--regions"});
  ASSERT_EQ(first.at("pairs").size(), 3U);
  for (const json& pair : first.at("pairs")) EXPECT_EQ(pair.at("ambiguous"), true);
  keep(first, "plain.json");
  json& pair = pair_of(first, "bolt", "plate");
  pair["status"] = "approved";
  pair.at("regions").at(0)["comment"] = "here";
  keep(first, "last.json");

  // Nothing was written: nothing is complained of, and nothing is new.
  const Ended plain = shell(folder, "impinge clash a.gltf --previous plain.json --fail-on new --json out.json");
  EXPECT_EQ(plain.code, 0) << plain.err;
  EXPECT_EQ(plain.err, "");

  std::string previous = "last.json";
  for (int week = 0; week < 3; ++week) {
    const Ended ended = shell(folder, "impinge clash a.gltf --previous " + previous + " --json out.json --fail-on new");
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(
        ended.err.starts_with("impinge: what was written about a clash, such as bolt / plate, is not taken over"))
        << ended.err;
    EXPECT_NE(ended.out.find(": 0 new, 0 with a new region, 3 persisting, 0 resolved.\n"), std::string::npos);
    const json report = json::parse(folder.read("out.json"));
    ASSERT_EQ(report.at("pairs").size(), 3U);
    for (const json& now : report.at("pairs")) {
      EXPECT_EQ(now.at("change"), "persisting");
      EXPECT_TRUE(now.at("status").is_null());
      for (const json& region : now.at("regions")) {
        EXPECT_EQ(region.at("change"), "persisting");
        EXPECT_TRUE(region.at("comment").is_null());
      }
    }
    ASSERT_EQ(report.at("resolved").size(), 1U);
    const json& resolved = report.at("resolved").at(0);
    EXPECT_EQ(resolved.at("ambiguous"), true);
    EXPECT_EQ(resolved.at("status"), "approved");
    EXPECT_EQ(resolved.at("regions").at(0).at("comment"), "here");
    previous = "week" + std::to_string(week) + ".json";
    folder.write(previous, report.dump());
  }
  // A third one is new.
  folder.write("a.gltf", gltf({nodes[0], nodes[0], nodes[0], nodes[2]}));
  const json third = run({"a.gltf", "--previous", "plain.json"});
  std::size_t fresh = 0;
  for (const json& now : third.at("pairs")) fresh += now.at("change") == "new" ? 1 : 0;
  EXPECT_EQ(fresh, 3U) << "against the plate and both others";
}

TEST_F(Approval, OfTwinsIsNotForAThirdInAnotherPlace) {
  folder.write("a.gltf", gltf({{"bolt", {0, 0, 0}}, {"bolt", {0, 0, 0}}, {"plate", {1, 1, 1}}}));
  json first = run({"a.gltf", "--regions"});
  for (json& pair : first.at("pairs")) pair["status"] = "approved";
  keep(first, "last.json");
  folder.write("a.gltf", gltf({{"bolt", {2, 2, 2}}, {"plate", {1, 1, 1}}}));
  const json third = run({"a.gltf", "--previous", "last.json"});
  ASSERT_EQ(third.at("pairs").size(), 1U);
  EXPECT_TRUE(third.at("pairs").at(0).at("status").is_null());
  std::size_t kept = 0;
  for (const json& resolved : third.at("resolved")) kept += resolved.at("status") == "approved" ? 1 : 0;
  EXPECT_EQ(kept, 3U);
}

TEST_F(Approval, ComesBackWhenATwinIsTakenOutAgain) {
  for (const std::string between : {"", " --regions"}) {
    SCOPED_TRACE(between);
    const Node bolt{"bolt", {0, 0, 0}}, plate{"plate", {1, 1, 1}};
    folder.write("a.gltf", gltf({bolt, plate}));
    json first = run({"a.gltf", "--regions"});
    ASSERT_EQ(first.at("pairs").size(), 1U);
    const std::string id = first.at("pairs").at(0).at("id");
    first.at("pairs").at(0)["status"] = "approved";
    first.at("pairs").at(0).at("regions").at(0)["comment"] = "here";
    keep(first, "last.json");

    folder.write("a.gltf", gltf({bolt, bolt, plate}));
    const Ended ended =
        shell(folder, "rm -f week.json; impinge clash a.gltf --previous last.json --json week.json" + between);
    EXPECT_NE(ended.err.find("such as bolt / plate, is not taken over"), std::string::npos) << ended.err;
    EXPECT_NE(ended.out.find(": 2 new, 0 with a new region, 1 persisting, 0 resolved.\n"), std::string::npos)
        << ended.out;
    const json both = json::parse(folder.read("week.json"));
    for (const json& pair : both.at("pairs")) {
      EXPECT_EQ(pair.at("change"), pair.at("id") == id ? "persisting" : "new");
      EXPECT_TRUE(pair.at("status").is_null());
    }
    ASSERT_EQ(both.at("resolved").size(), 1U);
    EXPECT_EQ(both.at("resolved").at(0).at("status"), "approved");
    EXPECT_EQ(both.at("resolved").at(0).at("ambiguous"), true);

    folder.write("a.gltf", gltf({bolt, plate}));
    const json last = run({"a.gltf", "--previous", "week.json", "--regions"});
    ASSERT_EQ(last.at("pairs").size(), 1U);
    const json& pair = last.at("pairs").at(0);
    EXPECT_EQ(pair.at("id"), id);
    EXPECT_EQ(pair.at("change"), "persisting");
    EXPECT_EQ(pair.at("status"), "approved");
    EXPECT_EQ(pair.at("regions").at(0).at("comment"), "here");
    for (const json& gone : last.at("resolved"))
      EXPECT_TRUE(gone.at("status").is_null() && gone.at("comment").is_null());
  }
}

TEST_F(Approval, StaysWithTheLastOfTwinsIfAllThatWasWrittenAgrees) {
  const Node bolt{"bolt", {0, 0, 0}}, plate{"plate", {1, 1, 1}}, far{"bolt", {40, 0, 0}};
  struct Case {
    std::array<const char*, 3> written;  ///< about each twin and the plate
    const char* kept;                    ///< null: withheld
    bool has_namesake;
  };
  for (const Case& each : {Case{{"", "", ""}, "", false}, Case{{"", "", "ok"}, "ok", false},
                           Case{{"ok", "", "ok"}, "ok", true}, Case{{"", "ok", "ok"}, "ok", false},
                           Case{{"ok", "", "bad"}, nullptr, false}, Case{{"", "bad", "ok"}, nullptr, true}}) {
    SCOPED_TRACE(std::string(each.written[0]) + "/" + each.written[1] + "/" + each.written[2]);
    std::vector<Node> nodes{bolt, bolt, bolt, plate};
    if (each.has_namesake) nodes.push_back(far);
    folder.write("a.gltf", gltf(nodes));
    json three = run({"a.gltf", "--regions"});
    ASSERT_EQ(three.at("pairs").size(), 6U);
    std::size_t twin = 0;
    for (json& pair : three.at("pairs")) {
      if (pair.at("b") != 3) continue;
      const std::string text = each.written.at(pair.at("a").get<std::size_t>());
      ++twin;
      if (text.empty()) continue;
      pair["status"] = text;
      pair.at("regions").at(0)["comment"] = "here";
    }
    ASSERT_EQ(twin, 3U);
    keep(three, "last.json");

    nodes.erase(nodes.begin(), nodes.begin() + 2);
    folder.write("a.gltf", gltf(nodes));
    std::string previous = "last.json";
    for (int week = 0; week < 3; ++week) {
      const Ended ended =
          shell(folder,
                "rm -f out.json; impinge clash a.gltf --regions --json out.json --fail-on new --previous " + previous);
      EXPECT_EQ(ended.code, 0) << ended.out;
      EXPECT_EQ(ended.err.find("is not taken over") != std::string::npos, each.kept == nullptr) << ended.err;
      const json report = json::parse(folder.read("out.json"));
      ASSERT_EQ(report.at("pairs").size(), 1U);
      const json& pair = report.at("pairs").at(0);
      EXPECT_EQ(pair.at("change"), "persisting");
      EXPECT_EQ(pair.at("ambiguous"), false);
      EXPECT_EQ(pair.at("regions").at(0).at("change"), "persisting");
      const bool is_kept = each.kept != nullptr && *each.kept != '\0';
      EXPECT_EQ(pair.at("status"), is_kept ? json(each.kept) : json(nullptr));
      EXPECT_EQ(pair.at("regions").at(0).at("comment"), is_kept ? json("here") : json(nullptr));
      std::multiset<std::string> withheld;
      for (const json& gone : report.at("resolved")) {
        if (gone.at("status").is_null()) continue;
        EXPECT_EQ(gone.at("ambiguous"), true);
        withheld.insert(gone.at("status"));
      }
      const std::multiset<std::string> none, both{"bad", "ok"};
      EXPECT_EQ(withheld, each.kept != nullptr ? none : both);
      previous = "week" + std::to_string(week) + ".json";
      folder.write(previous, report.dump());
    }
  }
}

TEST_F(Approval, OfATwinThatIsGoneMayBeThatOfOneThatIsLeft) {
  const Node bolt{"bolt", {0, 0, 0}}, plate{"plate", {1, 1, 1}};
  folder.write("a.gltf", gltf({bolt, bolt, bolt, plate}));
  json three = run({"a.gltf"});
  for (json& pair : three.at("pairs"))
    if (pair.at("a") == 2 && pair.at("b") == 3) pair["status"] = "approved";
  keep(three, "last.json");
  folder.write("a.gltf", gltf({bolt, bolt, plate}));
  const json two = run({"a.gltf", "--previous", "last.json"});
  std::size_t withheld = 0;
  for (const json& gone : two.at("resolved")) {
    EXPECT_EQ(gone.at("ambiguous"), !gone.at("status").is_null());
    withheld += gone.at("status") == "approved" ? 1 : 0;
  }
  EXPECT_EQ(withheld, 1U);
  keep(three = two, "last.json");
  folder.write("a.gltf", gltf({bolt, plate}));
  const json one = run({"a.gltf", "--previous", "last.json"});
  ASSERT_EQ(one.at("pairs").size(), 1U);
  EXPECT_EQ(one.at("pairs").at(0).at("status"), "approved");
  EXPECT_EQ(one.at("pairs").at(0).at("change"), "persisting");
}

TEST_F(Approval, OfAFileThatIsReadTwiceIsForNoneOfThem) {
  folder.write("a.off", off(box({0, 0, 0}, {2, 2, 2})));
  json report = run({"a.off", "./a.off"});
  ASSERT_EQ(report.at("pairs").size(), 1U);
  EXPECT_EQ(report.at("pairs").at(0).at("ambiguous"), true);
}

}  // namespace
}  // namespace impinge::test
