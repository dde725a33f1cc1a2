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
            "closed.off: 1 object, 12 triangles\n"
            "object  triangles  vertices  degenerate  open edges             centre  radius\n"
            "closed         12         8           0      closed  5.000 6.000 7.000   1.732\n"
            "\n"
            "open.off: 1 object, 12 triangles\n"
            "object  triangles  vertices  degenerate  open edges             centre  radius\n"
            "open           12         8           1           3  1.000 1.000 1.000   1.732\n");
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
  EXPECT_NEAR(object.at("center").at(2), 7.0, 1e-9);
  EXPECT_NEAR(object.at("radius"), std::sqrt(3.0), 1e-9);
  EXPECT_TRUE(answer.at("files").at(1).at("error").is_string());
  const json& right = answer.at("files").at(2).at("objects").at(1);
  EXPECT_EQ(right.at("id"), 2);
  EXPECT_EQ(right.at("name"), "right");
  EXPECT_NEAR(right.at("center").at(0), 3.0, 1e-6);
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
