// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// `impinge info`: the list and its document.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;

/// The place that the line of its facts names between two texts, if it is one of the edges that (2 0 0), (2 2 2) and (2
/// 0 2) are the ends of: which of them comes first is open.
std::string edge_between(const std::string& text, const std::string& before, const std::string& after) {
  for (const char* a : {"(2 0 0)", "(2 2 2)", "(2 0 2)"})
    for (const char* b : {"(2 0 0)", "(2 2 2)", "(2 0 2)"}) {
      const std::string edge = std::string(a) + "-" + b;
      if (std::string_view(a) != b && text.find(before + edge + after) != std::string::npos) return edge;
    }
  return "none of the open edges";
}

TEST(Info, ListsObjectsTrianglesAndOpenEdges) {
  const Folder folder;
  Solid open = cube(0, 0, 0);
  open.triangles.pop_back();
  open.triangles.push_back({0, 1, 1});
  folder.write("closed.off", off(cube(4, 5, 6)));
  folder.write("open.off", off(open));
  const Ended run = impinge(folder, {"info", "closed.off", "open.off"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out,
            "closed.off: 1 object, 12 triangles, in an unknown unit\n"
            "object  triangles  vertices  degenerate  open edges  class             centre  radius\n"
            "closed         12         8           0      closed  solid  5.000 6.000 7.000   1.732\n"
            "\n"
            "open.off: 1 object, 12 triangles, in an unknown unit\n"
            "object  triangles  vertices  degenerate  open edges  class               centre  radius\n"
            "open           12         8           1           3  surface  1.000 1.000 1.000   1.732\n"
            "open is a surface: 3 open edges, first at " +
                edge_between(run.out, "3 open edges, first at ", "; ") +
                "; at none of them can inside be told from outside\n"
                "Surfaces have no inside: what lies wholly within one is not found.\n");
}

TEST(Info, JsonHoldsTheSame) {
  const Folder folder;
  folder.write("a.off", off(cube(4, 5, 6)));
  folder.write("pair.gltf", gltf({{"left", {0, 0, 0}}, {"right", {2, 0, 0}}}));
  const Ended run = impinge(folder, {"info", "a.off", "missing.off", "pair.gltf", "--json", "-"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("missing.off"), std::string::npos);
  const json answer = json::parse(run.out);
  EXPECT_EQ(answer.at("version"), 1);
  ASSERT_EQ(answer.at("files").size(), 3U);
  const json& file = answer.at("files").at(0);
  EXPECT_EQ(file.at("file"), "a.off");
  EXPECT_TRUE(file.at("error").is_null());
  EXPECT_TRUE(file.at("warnings").is_array());
  const json& object = file.at("objects").at(0);
  EXPECT_EQ(object.at("id"), 0);
  EXPECT_EQ(object.at("name"), "a");
  EXPECT_EQ(object.at("triangles"), 12);
  EXPECT_EQ(object.at("vertices"), 8);
  EXPECT_EQ(object.at("degenerate"), 0);
  EXPECT_EQ(object.at("closed"), true);
  EXPECT_EQ(object.at("open_edges"), 0);
  EXPECT_EQ(object.at("class"), "solid");
  EXPECT_EQ(object.at("self_crossings"), 0);
  EXPECT_TRUE(object.at("first_open_edge").is_null());
  EXPECT_TRUE(object.at("first_self_crossing").is_null());
  EXPECT_NEAR(object.at("volume"), 8.0, 1e-9);
  EXPECT_NEAR(object.at("area"), 24.0, 1e-9);
  EXPECT_NEAR(object.at("inner_radius"), 1.0, 0.05);
  EXPECT_NEAR(object.at("center").at(2), 7.0, 1e-9);
  EXPECT_NEAR(object.at("radius"), std::sqrt(3.0), 1e-9);
  EXPECT_TRUE(answer.at("files").at(1).at("error").is_string());
  const json& right = answer.at("files").at(2).at("objects").at(1);
  EXPECT_EQ(right.at("id"), 2);
  EXPECT_EQ(right.at("name"), "right");
  EXPECT_NEAR(right.at("center").at(0), 3.0, 1e-6);
}

TEST(Info, NamesWhereAPartCrossesItself) {
  const Folder folder;
  // Two boxes in one part; they cross around (5 5 5), and neither is open.
  folder.write("both.off", off(as_one({box({0, 0, 0}, {6, 6, 6}), box({4, 4, 4}, {10, 10, 10})})));
  const Ended run = impinge(folder, {"info", "both.off", "--json", "out.json"});
  EXPECT_EQ(run.out.find("both is "), std::string::npos) << run.out;  // it has an inside
  const json object = json::parse(folder.read("out.json")).at("files").at(0).at("objects").at(0);
  EXPECT_EQ(object.at("closed"), true);
  EXPECT_EQ(object.at("class"), "solid");
  EXPECT_GT(object.at("self_crossings"), 0);
  const json& crossing = object.at("first_self_crossing");
  // One triangle of each box, and a place that is in the box of both.
  EXPECT_LT(crossing.at("triangles").at(0), 12);
  EXPECT_GE(crossing.at("triangles").at(1), 12);
  for (const json& coordinate : crossing.at("near")) {
    EXPECT_GE(coordinate, 4.0);
    EXPECT_LE(coordinate, 6.0);
  }
}

TEST(Info, WhereNothingIsExactNothingIsSaidOfSolids) {
  const Folder folder;
  folder.write("far.off", "OFF\n3 1 0\n1e200 0 0\n0 1e100 0\n0 0 1e-200\n3 0 1 2\n");
  const Ended run = impinge(folder, {"info", "far.off", "--json", "out.json"});
  EXPECT_NE(run.out.find("unknown"), std::string::npos) << run.out;
  const json object = json::parse(folder.read("out.json")).at("files").at(0).at("objects").at(0);
  for (const char* key : {"class", "closed", "open_edges", "self_crossings", "volume", "area", "inner_radius"})
    EXPECT_TRUE(object.at(key).is_null()) << key;
}

TEST(Info, LeavesOutColumnsOnNarrowTerminals) {
  const Folder folder;
  folder.write("a.off", off(cube(0, 0, 0)));
  Launch launch;
  launch.environment["COLUMNS"] = "60";
  const Ended run = impinge(folder, {"info", "a.off"}, launch);
  EXPECT_EQ(run.out.find("radius"), std::string::npos);
  EXPECT_NE(run.out.find("closed"), std::string::npos);
  EXPECT_NE(run.out.find("wider terminal"), std::string::npos);
}

}  // namespace
}  // namespace impinge::test
