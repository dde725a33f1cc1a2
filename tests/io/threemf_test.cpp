// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <map>
#include <random>

#include "support.hpp"

namespace impinge::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Members = std::map<std::string, std::string>;

std::string relations(const std::string& to) {
  return R"(<?xml version="1.0" encoding="UTF-8"?><Relationships )"
         R"(xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/)" +
         to +
         R"(.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";
}

std::string model_text(const std::string& resources, const std::string& build, const std::string& attributes = "") {
  return R"(<?xml version="1.0" encoding="UTF-8"?><model )" + attributes +
         R"( xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02")"
         R"( xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06")"
         R"( xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02")"
         R"( xmlns:s="http://schemas.microsoft.com/3dmanufacturing/slice/2015/07"><resources>)" +
         resources + "</resources><build>" + build + "</build></model>";
}

/// An object with a tetrahedron whose corners are 0 0 0, 1 0 0, 0 2 0 and 0 0 3.
std::string tetrahedron(int id, const std::string& attributes = "", const std::string& more = "") {
  return "<object id=\"" + std::to_string(id) + "\" type=\"model\" " + attributes +
         R"(><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="2" z="0"/>)"
         R"(<vertex x="0" y="0" z="3"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/>)"
         R"(<triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/><triangle v1="2" v2="0" v3="3"/></triangles>)" +
         more + "</mesh></object>";
}

Members package(const std::string& text) {
  return {
      {"[Content_Types].xml",
       R"(<?xml version="1.0" encoding="UTF-8"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">)"
       R"(<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>)"
       R"(<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>)"},
      {"_rels/.rels", relations("3dmodel")},
      {"3D/3dmodel.model", text}};
}

class ThreeMf : public testing::Test {
 protected:
  Result<Model> read_package(const Members& members) {
    write_zip(file(), members);
    return read(file());
  }
  Result<Model> read_model(const std::string& text) { return read_package(package(text)); }
  [[nodiscard]] std::filesystem::path file() const { return folder.path() / "case.3mf"; }

  TemporaryFolder folder;
};

TEST_F(ThreeMf, ShowsWhatIsBuiltWithItsComponents) {
  const std::string pair =
      R"(<object id="2" name="pair" type="model"><components><component objectid="1"/>)"
      R"(<component objectid="1" transform="0 1 0 -1 0 0 0 0 1 5 6 7"/><component objectid="3"/></components></object>)";
  const Model found = model_of(read_model(model_text(
      tetrahedron(1, R"(name="Šroub &amp; bolt")") + tetrahedron(3) + pair + tetrahedron(4, "name=\"unused\""),
      R"(<item objectid="1" transform="1 0 0 0 1 0 0 0 1 10 20 30"/>)"
      R"(<item objectid="2" transform="2 0 0 0 2 0 0 0 2 100 0 0"/>)",
      "unit=\"inch\"")));
  EXPECT_THAT(names_of(found),
              ElementsAre("\u0160roub & bolt", "\u0160roub & bolt (2)", "\u0160roub & bolt (3)", "pair"));
  EXPECT_EQ(found.objects[1].path, "pair/\u0160roub & bolt");
  EXPECT_EQ(found.objects[3].path, "pair");
  ASSERT_EQ(found.groups.size(), 1u);
  EXPECT_EQ(found.groups[0].name, "pair");
  EXPECT_FALSE(found.objects[0].group);
  EXPECT_EQ(found.objects[2].group, 0u);
  EXPECT_EQ(found.objects[0].pose.t, (std::array<double, 3>{10, 20, 30}));
  EXPECT_EQ(points_of(found.objects[0]), (Points{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}));
  EXPECT_EQ(triangles_of(found.objects[0]), (Triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
  // 2 (x, y, z) + (100, 0, 0) of (5 - y, 6 + x, 7 + z).
  Points corners = points_of(found.objects[2]);
  for (Point& corner : corners) corner = world_vertex(found.objects[2].pose, corner);
  EXPECT_EQ(corners, (Points{{110, 12, 14}, {110, 14, 14}, {106, 12, 14}, {110, 12, 20}}));
  EXPECT_THAT(found.missing, IsEmpty());
}

TEST_F(ThreeMf, SharesMeshesAndSaysItsUnit) {
  for (const auto& [unit, metres] : {std::pair("micron", 1e-6),
                                     {"millimeter", 0.001},
                                     {"centimeter", 0.01},
                                     {"inch", 0.0254},
                                     {"foot", 0.3048},
                                     {"meter", 1.0}}) {
    const Model found = model_of(read_model(
        model_text(tetrahedron(1), R"(<item objectid="1"/><item objectid="1" transform="0 1 0 -1 0 0 0 0 1 9 0 0"/>)",
                   "unit=\"" + std::string(unit) + "\"")));
    EXPECT_EQ(found.unit_in_metres, metres) << unit;
    EXPECT_THAT(names_of(found), ElementsAre("case", "case (2)"));
    EXPECT_EQ(&found.objects[0].mesh.state(), &found.objects[1].mesh.state());
  }
  EXPECT_EQ(model_of(read_model(model_text(tetrahedron(1), R"(<item objectid="1"/>)"))).unit_in_metres, 0.001);
}

TEST_F(ThreeMf, FollowsTheProductionExtension) {
  const std::string uuid = R"(p:UUID="0a1b2c3d-0000-4000-8000-00000000000)";
  Members members = package(model_text(
      "<object id=\"1\" name=\"both\" type=\"model\" " + uuid +
          "1\"><components><component p:path=\"/3D/parts.model\" objectid=\"7\" " + uuid +
          "2\"/></components></object>",
      "<item objectid=\"1\" " + uuid + "3\"/><item objectid=\"8\" p:path=\"/3D/parts.model\" " + uuid + "4\"/>",
      "requiredextensions=\"p\""));
  members["3D/parts.model"] = model_text(
      tetrahedron(7, "name=\"seven\" " + uuid + "5\"") + tetrahedron(8, "name=\"eight\" " + uuid + "6\""), "");
  members["3D/_rels/3dmodel.model.rels"] = relations("parts");
  const Model found = model_of(read_package(members));
  EXPECT_THAT(names_of(found), ElementsAre("seven", "eight"));
  EXPECT_EQ(found.objects[0].path, "both/seven");
  EXPECT_NE(&found.objects[0].mesh.state(), &found.objects[1].mesh.state());
}

TEST_F(ThreeMf, SaysWhichShapesAreIncomplete) {
  const std::string lattice =
      R"(<b:beamlattice radius="0.1" minlength="0.01"><b:beams><b:beam v1="0" v2="1"/></b:beams></b:beamlattice>)";
  std::string slices = R"(<s:slicestack id="5" zbottom="0">)";
  for (const char* top : {"1", "2"})
    slices +=
        R"(<s:slice ztop=")" + std::string(top) +
        R"("><s:vertices><s:vertex x="0" y="0"/><s:vertex x="1" y="0"/><s:vertex x="0" y="1"/></s:vertices>)"
        R"(<s:polygon startv="0"><s:segment v2="1"/><s:segment v2="2"/><s:segment v2="0"/></s:polygon></s:slice>)";
  slices += "</s:slicestack>";
  const Model found = model_of(
      read_model(model_text(slices + tetrahedron(1, R"(name="lattice")", lattice) +
                                tetrahedron(2, R"(name="coarse" s:slicestackid="5" s:meshresolution="lowres")") +
                                tetrahedron(3, R"(name="fine" s:slicestackid="5" s:meshresolution="fullres")") +
                                tetrahedron(4, "name=\"plain\""),
                            R"(<item objectid="1"/><item objectid="2"/><item objectid="3"/><item objectid="4"/>)")));
  ASSERT_THAT(names_of(found), ElementsAre("lattice", "coarse", "fine", "plain"));
  EXPECT_EQ(found.objects[0].incomplete, "its beam lattice is left out");
  EXPECT_EQ(found.objects[1].incomplete, "its mesh is a coarse one, and its slices are left out");
  EXPECT_EQ(found.objects[2].incomplete, "");
  EXPECT_EQ(found.objects[3].incomplete, "");
  EXPECT_THAT(found.missing, ElementsAre(HasSubstr("'lattice' is incomplete"), HasSubstr("'coarse' is incomplete")));
}

TEST_F(ThreeMf, SaysThatARequiredExtensionIsNotRead) {
  const Model found = model_of(read_model(model_text(
      tetrahedron(1), R"(<item objectid="1"/>)", R"(requiredextensions="x" xmlns:x="http://example.com/implicit")")));
  EXPECT_THAT(found.missing, ElementsAre(HasSubstr("A required extension is not supported")));
}

TEST_F(ThreeMf, FilesThatAreNoneAreErrors) {
  const auto problem = [&](const std::string& text) { return error_of(read_model(text)); };
  const std::string good = model_text(tetrahedron(1), R"(<item objectid="1"/>)");
  EXPECT_THAT(problem(model_text(tetrahedron(1), "")), HasSubstr("case.3mf: the file holds no triangles"));
  EXPECT_THAT(problem(good.substr(0, good.size() / 2)), HasSubstr("case.3mf: lib3mf cannot read the file ("));
  EXPECT_THAT(problem(model_text(tetrahedron(1), R"(<item objectid="2"/>)")),
              HasSubstr("lib3mf cannot read the file ("));
  std::string beyond = good;
  beyond.replace(beyond.find("v3=\"3\""), 6, "v3=\"4\"");
  EXPECT_THAT(problem(beyond), HasSubstr("lib3mf cannot read the file ("));
  const std::string own = R"(<object id="1" type="model"><components><component objectid="1"/></components></object>)";
  EXPECT_THAT(problem(model_text(own, R"(<item objectid="1"/>)")), HasSubstr("lib3mf cannot read the file ("));
  // Components that double 21 times.
  std::string doubled = tetrahedron(1);
  for (int i = 2; i < 23; ++i) {
    const std::string inner = "<component objectid=\"" + std::to_string(i - 1) + "\"/>";
    doubled += "<object id=\"" + std::to_string(i) + "\" type=\"model\"><components>" + inner + inner +
               "</components></object>";
  }
  EXPECT_THAT(problem(model_text(doubled, R"(<item objectid="22"/>)")), HasSubstr("more than 1000000 objects"));
  Members other = package(good);
  other.erase("_rels/.rels");
  EXPECT_THAT(error_of(read_package(other)), HasSubstr("lib3mf cannot read the file ("));
  EXPECT_THAT(error_of(read(folder.write("letter.3mf", "Dear Sir or Madam"))),
              HasSubstr("lib3mf cannot read the file ("));
}

TEST_F(ThreeMf, DamagedFilesAreModelsOrErrors) {
  ASSERT_TRUE(read_model(model_text(tetrahedron(1), R"(<item objectid="1"/>)")));
  const std::string good = bytes_of_file(file());
  std::mt19937 random(20261125);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (int i = 0; i < 60; ++i) {
    std::string bad = good;
    if (i % 3 == 0) bad.resize(below(good.size()));
    for (int k = 0; k < 4 && i % 3 != 0; ++k) bad[below(bad.size())] = static_cast<char>(below(256));
    SCOPED_TRACE(i);
    const std::filesystem::path file = folder.write("bad.3mf", bad);
    expect_sound_or_error(read(file), file.string() + ": ");
  }
}

}  // namespace
}  // namespace impinge::io
