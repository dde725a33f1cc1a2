// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// `impinge info`: the list and its document.
#include <cmath>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

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
  write_off(folder, {{"closed", cube(4, 5, 6)}, {"open", open}});
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
  EXPECT_THAT(run.err, HasSubstr("missing.off"));
  const json answer = json::parse(run.out);
  EXPECT_EQ(answer.at("version"), 1);
  ASSERT_EQ(answer.at("files").size(), 3U);
  const json& file = answer.at("files").at(0);
  expect_members(file, {{"file", "a.off"}, {"error", nullptr}});
  EXPECT_TRUE(file.at("warnings").is_array());
  const json& object = file.at("objects").at(0);
  expect_members(object, json::parse(R"({"id":0,"name":"a","triangles":12,"vertices":8,"degenerate":0,"closed":true,
      "open_edges":0,"class":"solid","self_crossings":0,"first_open_edge":null,"first_self_crossing":null})"));
  EXPECT_NEAR(object.at("volume"), 8.0, 1e-9);
  EXPECT_NEAR(object.at("area"), 24.0, 1e-9);
  EXPECT_NEAR(object.at("inner_radius"), 1.0, 0.05);
  EXPECT_NEAR(object.at("center").at(2), 7.0, 1e-9);
  EXPECT_NEAR(object.at("radius"), std::sqrt(3.0), 1e-9);
  EXPECT_TRUE(answer.at("files").at(1).at("error").is_string());
  const json& right = answer.at("files").at(2).at("objects").at(1);
  expect_members(right, {{"id", 2}, {"name", "right"}});
  EXPECT_NEAR(right.at("center").at(0), 3.0, 1e-6);
}

TEST(Info, NamesWhereAPartCrossesItself) {
  const Folder folder;
  // Two boxes in one part; they cross around (5 5 5), and neither is open.
  folder.write("both.off", off(as_one({box({0, 0, 0}, {6, 6, 6}), box({4, 4, 4}, {10, 10, 10})})));
  const Ended run = impinge(folder, {"info", "both.off", "--json", "out.json"});
  EXPECT_THAT(run.out, Not(HasSubstr("both is ")));  // it has an inside
  const json object = json::parse(folder.read("out.json")).at("files").at(0).at("objects").at(0);
  expect_members(object, {{"closed", true}, {"class", "solid"}});
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
  EXPECT_THAT(run.out, HasSubstr("unknown"));
  const json object = json::parse(folder.read("out.json")).at("files").at(0).at("objects").at(0);
  expect_members(object, json::parse(R"({"class":null,"closed":null,"open_edges":null,"self_crossings":null,
      "volume":null,"area":null,"inner_radius":null})"));
}

TEST(Info, LeavesOutColumnsOnNarrowTerminals) {
  const Folder folder;
  folder.write("a.off", off(cube(0, 0, 0)));
  Launch launch;
  launch.environment["COLUMNS"] = "60";
  const Ended run = impinge(folder, {"info", "a.off"}, launch);
  EXPECT_THAT(run.out, AllOf(HasSubstr("closed"), HasSubstr("wider terminal"), Not(HasSubstr("radius"))));
}

}  // namespace
}  // namespace impinge::test
