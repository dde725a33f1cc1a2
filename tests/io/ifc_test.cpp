// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// IFC files, written here as STEP text, and what is read of them.
#include <chrono>
#include <cstdlib>

#include "ifc_support.hpp"

namespace impinge::io {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using scenes::kFoot;
using scenes::kMetre;
using scenes::kMillimetre;
using scenes::Step;

TEST(Ifc, BoxesOfEverySchemaAndUnit) {
  struct Unit {
    scenes::StepUnit unit;
    double metres;
  };
  for (const char* schema : {"IFC2X3", "IFC4", "IFC4X3", "IFC4X3_ADD2"}) {
    for (const Unit& unit : {Unit{kMetre, 1},
                             {kMillimetre, 0.001},
                             {scenes::kFoot, 0.3048},
                             {{kMillimetre.si, "IFCRATIOMEASURE(25.4)"}, 0.0254}}) {
      SCOPED_TRACE(schema + std::string(" ") + unit.unit.si + unit.unit.measure);
      Step step(schema, unit.unit);
      step.product("box", step.placement("$", step.axes({100, 200, 300})),
                   step.shape(step.shown(step.extruded(step.rectangle(40, 20), 50))));
      const Model model = read_ifc(step);
      ASSERT_EQ(names_of(model), std::vector<std::string>{"box"});
      const Object& box = model.objects[0];
      EXPECT_EQ(model.unit_in_metres, unit.metres);
      EXPECT_THAT(model.missing, IsEmpty());
      EXPECT_THAT(model.warnings, IsEmpty());
      expect_box(box, {{80, 190, 300}, {120, 210, 350}}, 1e-12);
      EXPECT_NEAR(volume_of(box), 40000, 1e-6);
      EXPECT_TRUE(is_closed(box));
      EXPECT_EQ(box.mesh.vertex_count(), 8u);
      EXPECT_EQ(box.path, "Site/House/Level 1/box");
      EXPECT_TRUE(box.product.starts_with("IfcBuildingElementProxy_box_0")) << box.product;
      EXPECT_THAT(box.properties, Contains(std::pair<std::string, std::string>("storey", "Level 1")));
      EXPECT_THAT(box.properties, Contains(std::pair<std::string, std::string>("Tag", "T1")));
    }
  }
}

TEST(Ifc, OpeningsAreCutAndTheyAndRoomsAreNoParts) {
  Step step("IFC2X3", kMillimetre);
  const std::string at = step.placement("$", step.axes({1000, 2000, 0}));
  const std::string wall =
      step.product("Wall", at, step.shape(step.shown(step.extruded(step.rectangle(4000, 200), 3000))), "IFCWALL", ",$");
  const std::string hole = step.extruded(step.rectangle(1000, 400), 2000);
  const std::string opening = step.product("Opening", step.placement(at, step.axes({500, 0, 500})),
                                           step.shape(step.shown(hole)), "IFCOPENINGELEMENT", ",$");
  step.line("IFCRELVOIDSELEMENT('" + step.guid() + "',$,$,$," + wall + "," + opening + ")");
  step.product("Room", at, step.shape(step.shown(hole)), "IFCSPACE", ",$,.ELEMENT.,.INTERNAL.,$");
  const std::string door = step.product(
      "Door", at, step.shape(step.shown(step.extruded(step.rectangle(900, 50), 1900))), "IFCDOOR", ",$,$,$");
  step.line("IFCRELFILLSELEMENT('" + step.guid() + "',$,$,$," + opening + "," + door + ")");
  step.line("IFCRELFILLSELEMENT('" + step.guid() + "',$,$,$," + opening + ",$)");
  // What projects from the wall is a body of it.
  const std::string pilaster =
      step.product("Pilaster", at, step.shape(step.shown(step.extruded(step.rectangle(400, 600), 3000))),
                   "IFCPROJECTIONELEMENT", ",$");
  step.line("IFCRELPROJECTSELEMENT('" + step.guid() + "',$,$,$," + wall + "," + pilaster + ")");
  const std::string facade = step.product("Facade", at, "$", "IFCCURTAINWALL", ",$");
  step.line("IFCRELAGGREGATES('" + step.guid() + "',$,$,$," + facade + ",(" + wall + "))");
  const Model model = read_ifc(step);
  ASSERT_EQ(names_of(model), (std::vector<std::string>{"Wall", "Door"}));
  std::vector<std::string> hosts;
  for (const Object& object : model.objects)
    for (const auto& [name, value] : object.properties)
      if (name == "host") hosts.push_back(object.name + " in " + value);
  EXPECT_EQ(hosts, (std::vector<std::string>{"Door in Wall", "Door in Facade"}));
  EXPECT_NEAR(volume_of(model.objects[0]), 4000. * 200 * 3000 - 1000. * 200 * 2000 + 400. * 600 * 3000, 1e4);
  EXPECT_TRUE(is_closed(model.objects[0]));
  expect_box(model.objects[0], {{-1000, 1700, 0}, {3000, 2300, 3000}}, 1e-3);
  EXPECT_THAT(model.missing, IsEmpty());
}

/// Of what projects nothing is drawn where its placement is not known, nor where web-ifc traps on it: the walls stay.
TEST(Ifc, ProjectionsThatAreNotDrawnAreSaid) {
  Step step;
  // Each wall has a mesh of its own, so that none is known from an earlier one.
  const auto own_box = [&] { return step.shape(step.shown(step.extruded(step.rectangle(1, 1), 1))); };
  const std::string box = own_box();
  const std::string on_grid =
      step.line("IFCGRIDPLACEMENT(" + step.line("IFCVIRTUALGRIDINTERSECTION(($,$),(0.,0.,0.))") + ",$)");
  const std::string at = step.placement("$", step.axes({100, 0, 0}));
  // A thing that shows itself, on which web-ifc traps.
  const std::string item =
      step.line("IFCMAPPEDITEM(#9000," +
                step.line("IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$," + step.point({0, 0, 0}) + ",$,$)") + ")");
  const std::string endless = step.shape(step.shown(item));
  for (const auto& [name, place, shape] : {std::array{"good", at.c_str(), box.c_str()},
                                           {"on grid", on_grid.c_str(), box.c_str()},
                                           {"looping", "#9002", box.c_str()},
                                           {"endless", at.c_str(), endless.c_str()}}) {
    const std::string wall = step.product(name, at, own_box(), "IFCWALL", ",$,$");
    const std::string part = step.product("part", place, shape, "IFCPROJECTIONELEMENT", ",$,$");
    step.line("IFCRELPROJECTSELEMENT('" + step.guid() + "',$,$,$," + wall + "," + part + ")");
  }
  std::string text = step.text();
  text.replace(text.find("ENDSEC;\nEND-"), 0,
               "#9000=IFCREPRESENTATIONMAP(" + step.origin + ",#9001);\n#9001=IFCSHAPEREPRESENTATION(" + step.context +
                   ",'Body','MappedRepresentation',(" + item + "));\n#9002=IFCLOCALPLACEMENT(#9003," + step.origin +
                   ");\n#9003=IFCLOCALPLACEMENT(#9002," + step.origin + ");\n");
  const Model model = read_text(text, "case.ifc");
  ASSERT_EQ(names_of(model), (std::vector<std::string>{"good", "on grid", "looping", "endless"}));
  for (const Object& object : model.objects) {
    const bool is_whole = object.name == "good";
    EXPECT_EQ(object.incomplete, is_whole ? "" : "what projects from it is not drawn") << object.name;
    EXPECT_NEAR(volume_of(object), is_whole ? 2 : 1, 1e-6) << object.name;
    expect_box(object, {{99.5, -0.5, 0}, {100.5, 0.5, 1}}, 1e-6);
  }
  EXPECT_THAT(model.missing, Contains(HasSubstr("what projects from 'endless' (IfcWall")));
}

TEST(Ifc, MappedItemsAreInstances) {
  Step step;
  const std::string item = step.shown(step.extruded(step.rectangle(2, 1), 3));
  const std::string map = step.line("IFCREPRESENTATIONMAP(" + step.origin + "," + item + ")");
  const auto shown = [&](const std::string& name, const std::string& by, const Point& at) {
    const std::string mapped = step.line("IFCMAPPEDITEM(" + map + "," + step.line(by) + ")");
    step.product(name, step.placement("$", step.axes(at)), step.shape(step.shown(mapped)));
  };
  const std::string op = "IFCCARTESIANTRANSFORMATIONOPERATOR3D", zero = step.point({0, 0, 0});
  shown("plain", op + "($,$," + zero + ",$,$)", {10, 0, 0});
  shown("moved", op + "($,$," + step.point({0, 0, 7}) + ",1.,$)", {20, 0, 0});
  shown("turned",
        op + "(" + step.direction({0, 1, 0}) + "," + step.direction({-1, 0, 0}) + "," + zero + ",1.," +
            step.direction({0, 0, 1}) + ")",
        {30, 0, 0});
  shown("mirrored",
        op + "(" + step.direction({1, 0, 0}) + "," + step.direction({0, 1, 0}) + "," + zero + ",1.," +
            step.direction({0, 0, -1}) + ")",
        {40, 0, 0});
  shown("scaled", op + "NONUNIFORM($,$," + zero + ",1.,$,2.,3.)", {50, 0, 0});
  const Model model = read_ifc(step);
  ASSERT_EQ(names_of(model), (std::vector<std::string>{"plain", "moved", "turned", "mirrored", "scaled"}));
  const auto& parts = model.objects;
  for (const int i : {1, 2}) EXPECT_EQ(&parts[0].mesh.state(), &parts[i].mesh.state()) << i;
  for (const int i : {3, 4}) EXPECT_NE(&parts[0].mesh.state(), &parts[i].mesh.state()) << i;
  expect_box(parts[0], {{9, -0.5, 0}, {11, 0.5, 3}}, 1e-6);
  expect_box(parts[1], {{19, -0.5, 7}, {21, 0.5, 10}}, 1e-6);
  expect_box(parts[2], {{29.5, -1, 0}, {30.5, 1, 3}}, 1e-6);
  expect_box(parts[3], {{39, -0.5, -3}, {41, 0.5, 0}}, 1e-6);
  expect_box(parts[4], {{49, -1, 0}, {51, 1, 9}}, 1e-6);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(volume_of(parts[i]), i == 4 ? 36 : 6, 1e-5) << "outward: " << parts[i].name;
    EXPECT_TRUE(is_closed(parts[i]));
  }
}

TEST(Ifc, BodiesOfOneProductAreOnePart) {
  Step step;
  const std::string a = step.extruded(step.rectangle(2, 1), 3);
  const std::string b = step.line("IFCEXTRUDEDAREASOLID(" + step.rectangle(1, 1) + "," + step.axes({5, 0, 0}) + "," +
                                  step.direction({0, 0, 1}) + ",1.)");
  step.product("two", step.placement("$", step.axes({0, 0, 10}, {0, 0, 1}, {0, 1, 0})),
               step.shape(step.shown(a + "," + b)));
  // Beside its body a product may show its axis, its outline on the floor, a box about it, and room to keep free.
  step.product(
      "door", step.placement("$", step.axes({0, 0, 20})),
      step.shape(
          step.shown(a) + "," +
          step.shown(step.line("IFCPOLYLINE((" + step.point({0, 0, 0}) + "," + step.point({9, 0, 0}) + "))"), "Axis") +
          "," + step.shown(step.line("IFCBOUNDINGBOX(" + step.point({0, 0, 0}) + ",9.,9.,9.)"), "Box") + "," +
          step.shown(step.extruded(step.rectangle(9, 9), 9), "Clearance")));
  // The same body twice, once as a mirror image.
  const std::string map = step.line("IFCREPRESENTATIONMAP(" + step.origin + "," + step.shown(a) + ")");
  const auto mapped = [&](double z) {
    return step.line("IFCMAPPEDITEM(" + map + "," +
                     step.line("IFCCARTESIANTRANSFORMATIONOPERATOR3D(" + step.direction({1, 0, 0}) + "," +
                               step.direction({0, 1, 0}) + "," + step.point({0, 0, 0}) + ",1.," +
                               step.direction({0, 0, z}) + ")") +
                     ")");
  };
  for (const double z : {1, -1})
    step.product("mirrored", step.placement("$", step.origin), step.shape(step.shown(mapped(z) + "," + mapped(-z))));
  const Model model = read_ifc(step);
  ASSERT_EQ(names_of(model), (std::vector<std::string>{"two", "door", "mirrored", "mirrored (2)"}));
  for (const int i : {2, 3}) EXPECT_NEAR(volume_of(model.objects[i]), 12, 1e-5);
  expect_box(model.objects[0], {{-0.5, -1, 10}, {0.5, 5.5, 13}}, 1e-6);
  EXPECT_NEAR(volume_of(model.objects[0]), 7, 1e-5);
  expect_box(model.objects[1], {{-1, -0.5, 20}, {1, 0.5, 23}}, 1e-6);
  EXPECT_THAT(model.missing, IsEmpty());
}

TEST(Ifc, LargeCoordinatesAreExact) {
  Step step;
  // A national grid: nested placements, a turn by a Pythagorean angle.
  const std::string site = step.placement("$", step.axes({5'000'000.125, 4'500'000.25, 300}));
  const std::string turned = step.placement(site, step.axes({10, 0, 0}, {0, 0, 1}, {0.6, 0.8, 0}));
  const std::string box = step.shape(step.shown(step.extruded(step.rectangle(0.5, 0.25), 0.125)));
  step.product("straight", step.placement(site, step.axes({1, 2, 3})), box);
  step.product("turned", step.placement(turned, step.axes({5, 0, 0})), box);
  const Model model = read_ifc(step);
  ASSERT_EQ(model.objects.size(), 2u);
  EXPECT_THAT(model.warnings, IsEmpty()) << "nothing is lost";
  expect_box(model.objects[0], {{5'000'000.875, 4'500'002.125, 303}, {5'000'001.375, 4'500'002.375, 303.125}}, 1e-9);
  const double x = 5'000'013.125, y = 4'500'004.25, half = 0.25 * 0.6 + 0.125 * 0.8, other = 0.25 * 0.8 + 0.125 * 0.6;
  expect_box(model.objects[1], {{x - half, y - other, 300}, {x + half, y + other, 300.125}}, 1e-7);
}

TEST(Ifc, NamesAreThoseOfTheFile) {
  Step step;
  const std::string box = step.extruded(step.rectangle(1, 1), 1);
  for (const char* name : {R"(Basic Wall: Interior - Partition (92mm Stud))", R"(\X2\0159\X0\ez \X2\58C1\X0\)",
                           R"(St\X\FCtze)", R"(O''Brien)"})
    step.solid(name, box);
  step.product("$", step.placement("$", step.origin), step.shape(step.shown(box)));
  EXPECT_EQ(names_of(read_ifc(step)),
            (std::vector<std::string>{"Basic Wall: Interior - Partition (92mm Stud)", "\u0159ez \u58c1", "St\u00fctze",
                                      "O'Brien", "IfcBuildingElementProxy"}));
}

TEST(Ifc, PropertiesAreOfTheProductItsTypeAndWhatItIsRelatedTo) {
  Step step;
  const auto related = [&](const std::string& kind, const std::string& parts, const std::string& to) {
    step.line(kind + "('" + step.guid() + "',$,$,$,(" + parts + ")," + to + ")");
  };
  const auto set = [&](const std::string& name, const std::vector<std::pair<std::string, std::string>>& values) {
    std::string lines;
    for (const auto& [key, value] : values)
      lines += (lines.empty() ? "" : ",") + step.line("IFCPROPERTYSINGLEVALUE('" + key + "',$," + value + ",$)");
    return step.line("IFCPROPERTYSET('" + step.guid() + "',$,'" + name + "',$,(" + lines + "))");
  };
  const std::string shown = step.shown(step.extruded(step.rectangle(1, 1), 1));
  step.line("IFCPRESENTATIONLAYERASSIGNMENT('A-WALL',$,(" + shown + "),$)");
  const std::string wall = step.product("wall", step.placement("$", step.origin), step.shape(shown), "IFCWALL");
  related("IFCRELDEFINESBYTYPE", wall,
          step.line("IFCWALLTYPE('" + step.guid() + "',$,'WT01',$,$,(" +
                    set("Pset_WallCommon", {{"FireRating", "IFCLABEL('1HR')"}, {"IsExternal", "IFCBOOLEAN(.T.)"}}) +
                    "),$,$,$,.STANDARD.)"));
  related("IFCRELDEFINESBYPROPERTIES", wall,
          set("Pset_WallCommon", {{"FireRating", "IFCLABEL('2HR')"}, {"Width", "IFCLENGTHMEASURE(0.25)"}}));
  const std::string layers = [&] {
    std::string text;
    for (const char* name : {"brick", "wool"})
      text += (text.empty() ? "" : ",") +
              step.line("IFCMATERIALLAYER(" + step.line(std::string("IFCMATERIAL('") + name + "',$,$)") +
                        ",0.1,$,$,$,$,$)");
    return text;
  }();
  related("IFCRELASSOCIATESMATERIAL", wall,
          step.line("IFCMATERIALLAYERSETUSAGE(" + step.line("IFCMATERIALLAYERSET((" + layers + "),$,$)") +
                    ",.AXIS2.,.POSITIVE.,0.,$)"));
  for (const auto& [kind, name] : {std::pair("IFCSYSTEM", "Supply"), {"IFCGROUP", "Phase 1"}})
    related("IFCRELASSIGNSTOGROUP", wall,
            "$," + step.line(std::string(kind) + "('" + step.guid() + "',$,'" + name + "',$,$)"));
  related("IFCRELASSOCIATESCLASSIFICATION", wall, step.line("IFCCLASSIFICATIONREFERENCE($,'Ss_25','Walls',$,$,$)"));
  // A list that holds itself, and twice.
  const std::string other = step.product("other", step.placement("$", step.origin), step.shape(shown));
  const std::string before = step.line("IFCMATERIAL('sand',$,$)");
  const std::string list = "#" + std::to_string(std::stoi(before.substr(1)) + 1);
  std::string items = before;
  for (int i = 0; i < 100; ++i) items += "," + list;
  EXPECT_EQ(step.line("IFCMATERIALLIST((" + items + "))"), list);
  const std::string type = step.line("IFCWALLTYPE('" + step.guid() + "',$,'WT02',$,$,$,$,$,$,.STANDARD.)");
  related("IFCRELDEFINESBYTYPE", other, type);
  related("IFCRELASSOCIATESMATERIAL", type, list);
  const auto rest = [&](bool property_sets) {
    const TemporaryFolder folder;
    ReadOptions options;
    options.property_sets = property_sets;
    const Model model = model_of(read(folder.write("case.ifc", step.text()), options));
    EXPECT_THAT(model.objects.at(1).properties, Contains(std::pair<std::string, std::string>("material", "sand")));
    auto properties = model.objects.at(0).properties;
    EXPECT_EQ(properties.at(1).first, "GlobalId");
    properties.erase(properties.begin() + 1);
    return properties;
  };
  using Properties = std::vector<std::pair<std::string, std::string>>;
  Properties expected{{"class", "IfcWall"},
                      {"Tag", "T1"},
                      {"storey", "Level 1"},
                      {"building", "House"},
                      {"site", "Site"},
                      {"PredefinedType", "STANDARD"},
                      {"type", "WT01"},
                      {"material", "brick"},
                      {"material", "wool"},
                      {"classification", "Ss_25"},
                      {"classification", "Walls"},
                      {"layer", "A-WALL"},
                      {"system", "Supply"},
                      {"group", "Phase 1"}};
  EXPECT_EQ(rest(false), expected);
  for (const auto& more : Properties{{"Pset_WallCommon.FireRating", "2HR"},
                                     {"Pset_WallCommon.Width", "0.25"},
                                     {"Pset_WallCommon.IsExternal", "TRUE"}})
    expected.push_back(more);
  EXPECT_EQ(rest(true), expected);
}

/// By the schemas: in IFC2x3 some classes have another enumeration in its place.
TEST(Ifc, PredefinedTypesAndAssembliesAreProperties) {
  const auto said = [](const Object& object, std::string_view name) {
    for (const auto& [key, value] : object.properties)
      if (key == name) return value;
    return std::string();
  };
  for (const char* schema : {"IFC2X3", "IFC4"}) {
    SCOPED_TRACE(schema);
    Step step(schema);
    const std::string shape = step.shape(step.shown(step.extruded(step.rectangle(1, 1), 1)));
    const std::string at = step.placement("$", step.origin);
    const std::string beam = step.product("a", at, shape, "IFCSLAB", ",'T',.ROOF.");
    step.product("b", at, shape, "IFCBUILDINGELEMENTPROXY", ",'T',.ELEMENT.");
    step.product("c", at, shape, "IFCCOVERING", ",'T',.NOTDEFINED.");
    const std::string frame = step.product("Frame", at, "$", "IFCELEMENTASSEMBLY", ",'T',.SITE.,.TRUSS.");
    step.line("IFCRELAGGREGATES('" + step.guid() + "',$,$,$," + frame + ",(" + beam + "))");
    const Model model = read_ifc(step);
    ASSERT_EQ(names_of(model), (std::vector<std::string>{"a", "b", "c"}));
    EXPECT_EQ(said(model.objects[0], "PredefinedType"), "ROOF");
    EXPECT_EQ(said(model.objects[1], "PredefinedType"), schema == std::string("IFC4") ? "ELEMENT" : "");
    EXPECT_EQ(said(model.objects[2], "PredefinedType"), "");
    EXPECT_EQ(said(model.objects[0], "assembly"), "Frame");
  }
}

TEST(Ifc, WhatIsNotDrawnIsNamed) {
  Step step;
  const std::string box = step.extruded(step.rectangle(1, 1), 1), at = step.placement("$", step.origin);
  step.product("shapeless", at, "$", "IFCPUMP");
  const std::string frame = step.product("frame", at, "$", "IFCELEMENTASSEMBLY", ",$,$,$");
  const std::string beam = step.product("beam", at, step.shape(step.shown(box)), "IFCBEAM");
  step.line("IFCRELAGGREGATES('" + step.guid() + "',$,$,$," + frame + ",(" + beam + "))");
  const std::string a = step.line("IFCLOCALPLACEMENT(#9001," + step.origin + ")");
  step.line("IFCPERSON($,$,$,$,$,$,$,$)");
  step.product("circular", a, step.shape(step.shown(box)));
  step.product("broken", at, step.shape(step.shown(step.extruded(step.line("IFCCIRCLEPROFILEDEF(.AREA.,$,$,$)"), 1))));
  step.product("hollow", at, step.shape(step.shown("#9002")));
  const std::string bad = step.extruded(step.line("IFCCIRCLEPROFILEDEF(.AREA.,$,$,$)"), 1);
  step.product("partly", at, step.shape(step.shown(box + "," + bad)));
  step.product("after", at, step.shape(step.shown(box)));
  // web-ifc would draw both at the origin.
  const std::string crossing = step.line("IFCVIRTUALGRIDINTERSECTION(($,$),(0.,0.,0.))");
  const std::string on_grid = step.line("IFCGRIDPLACEMENT(" + crossing + ",$)");
  step.product("on axes", on_grid, step.shape(step.shown(box)));
  step.product("beside", step.placement(on_grid, step.origin), step.shape(step.shown(box)));
  std::string text = step.text();
  text.replace(text.find("ENDSEC;\nEND-"), 0, "#9001=IFCLOCALPLACEMENT(" + a + "," + step.origin + ");\n");
  const Model model = read_text(text, "case.ifc");
  EXPECT_EQ(names_of(model), (std::vector<std::string>{"beam", "partly", "after"}));
  for (const Object& object : model.objects)
    EXPECT_EQ(object.incomplete.empty(), object.name != "partly") << object.name << object.incomplete;
  const auto about = [&](const std::string& name) {
    return std::count_if(model.missing.begin(), model.missing.end(),
                         [&](const std::string& sentence) { return sentence.find("'" + name + "'") != sentence.npos; });
  };
  for (const char* name : {"shapeless", "circular", "on axes", "beside", "broken", "hollow", "partly"})
    EXPECT_GE(about(name), 1) << name;
  for (const char* name : {"frame", "beam", "after"}) EXPECT_EQ(about(name), 0) << name;
  EXPECT_THAT(model.missing, Contains(HasSubstr("Products without a shape, 1: 'shapeless' (IfcPump 0")));
  EXPECT_THAT(model.missing, Contains(HasSubstr("placement is on a grid or depends on itself")));
}

TEST(Ifc, WhatTrapsTakesNothingElseAlong) {
  Step step;
  const std::string box = step.extruded(step.rectangle(1, 1), 1), at = step.placement("$", step.origin);
  step.product("before", at, step.shape(step.shown(box)));
  // A thing that shows itself.
  const std::string map = "#" + std::to_string(9000);
  const std::string item =
      step.line("IFCMAPPEDITEM(" + map + "," +
                step.line("IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$," + step.point({0, 0, 0}) + ",$,$)") + ")");
  step.product("endless", at, step.shape(step.shown(item)));
  step.product("after", at, step.shape(step.shown(box)));
  std::string text = step.text();
  text.replace(text.find("ENDSEC;\nEND-"), 0,
               map + "=IFCREPRESENTATIONMAP(" + step.origin + ",#9001);\n#9001=IFCSHAPEREPRESENTATION(" + step.context +
                   ",'Body','MappedRepresentation',(" + item + "));\n");
  // What is cut out of itself, which web-ifc alone would follow into gigabytes.
  text.replace(text.find("ENDSEC;\nEND-"), 0,
               "#9003=IFCBOOLEANRESULT(.DIFFERENCE.,#9004," + box + ");\n#9004=IFCBOOLEANRESULT(.DIFFERENCE.,#9003," +
                   box + ");\n#9005=IFCSHAPEREPRESENTATION(" + step.context +
                   ",'Body','CSG',(#9003));\n#9006=IFCPRODUCTDEFINITIONSHAPE($,$,(#9005));\n"
                   "#9007=IFCWALL('0000000000000000000099',$,'eaten',$,$," +
                   at + ",#9006,$,$);\n");
  const Model model = read_text(text, "case.ifc");
  EXPECT_EQ(names_of(model), (std::vector<std::string>{"before", "after"}));
  EXPECT_THAT(model.missing, testing::UnorderedElementsAre(HasSubstr("'endless' (IfcBuildingElementProxy"),
                                                           HasSubstr("leads back to itself")));
}

/// What web-ifc alone would take minutes and gigabytes for.
TEST(Ifc, ShapesWithinEachOtherAreCountedFirst) {
  Step step;
  const std::string box = step.extruded(step.rectangle(1, 1), 1), at = step.placement("$", step.origin);
  step.product("whole", at, step.shape(step.shown(box)));
  std::string carved = box;
  for (int i = 0; i < 20'000; ++i) carved = step.line("IFCBOOLEANRESULT(.DIFFERENCE.," + carved + "," + box + ")");
  step.product("carved", at, step.shape(step.shown(carved)));
  std::string items = box, map;
  for (int i = 0; i < 60; ++i) {  // 2^60 shapes
    map = step.line("IFCREPRESENTATIONMAP(" + step.origin + "," + step.shown(items) + ")");
    const std::string item = "IFCMAPPEDITEM(" + map + "," +
                             step.line("IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$," + step.point({0, 0, 0}) + ",$,$)") +
                             ")";
    items = step.line(item) + "," + step.line(item);
  }
  step.product("forest", at, step.shape(step.shown(items)));
  // Of which nothing is shown, and of which one is beside a box.
  map = step.line("IFCREPRESENTATIONMAP(" + step.origin + "," + step.shown(items) + ")");
  step.product("alone", at, step.shape(step.shown(box)));
  const std::string item =
      step.line("IFCMAPPEDITEM(" + map + "," +
                step.line("IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$," + step.point({0, 0, 0}) + ",$,$)") + ")");
  step.product("partly", at, step.shape(step.shown(box + "," + item)));
  const std::string opening = step.product("opening", at, step.shape(step.shown(carved)), "IFCOPENINGELEMENT", ",$");
  const std::string host = step.product("host", at, step.shape(step.shown(box)));
  step.line("IFCRELVOIDSELEMENT('" + step.guid() + "',$,$,$," + host + "," + opening + ")");
  // Out of the parts of a whole, and theirs, its openings are cut too: here one whose fillets do not fit.
  const std::string layer = step.product("layer", at, step.shape(step.shown(box)));
  const std::string stud = step.product("stud", at, step.shape(step.shown(box)));
  step.line("IFCRELAGGREGATES('" + step.guid() + "',$,$,$," + layer + ",(" + stud + "))");
  const std::string wall = step.product("wall", at, "$", "IFCWALL", ",$,$");
  step.line("IFCRELAGGREGATES('" + step.guid() + "',$,$,$," + wall + ",(" + layer + "))");
  const std::string beam =
      step.extruded(step.line("IFCISHAPEPROFILEDEF(.AREA.,$," + step.flat_axes() + ",0.5,0.5,0.1,0.1,0.4,$,$)"), 1);
  const std::string slot = step.product("slot", at, step.shape(step.shown(beam)), "IFCOPENINGELEMENT", ",$,$");
  step.line("IFCRELVOIDSELEMENT('" + step.guid() + "',$,$,$," + wall + "," + slot + ")");
  const Model model = read_ifc(step);
  EXPECT_EQ(names_of(model), (std::vector<std::string>{"whole", "alone", "partly", "host", "layer", "stud"}));
  EXPECT_THAT(model.objects[3].incomplete, HasSubstr("an opening of it is not drawn in full: 20000 differences"));
  for (const std::size_t part : {4, 5})
    EXPECT_EQ(model.objects[part].incomplete,
              "an opening of it is not drawn in full: the radii of its profile do not fit, and its corners are drawn "
              "sharp");
  ASSERT_EQ(model.missing.size(), 2u);
  EXPECT_THAT(model.missing[0],
              testing::AllOf(HasSubstr("'carved'"), HasSubstr("20000 differences within each other; more than 2000"),
                             HasSubstr("'forest'"), HasSubstr("show more than 100000 shapes")));
  EXPECT_THAT(model.missing[1], testing::AllOf(HasSubstr("'partly'"), HasSubstr("show more than 100000 shapes")));
  EXPECT_THAT(model.missing[1], testing::AllOf(HasSubstr("incomplete shape"), HasSubstr("'host'"),
                                               HasSubstr("an opening of it is not drawn in full: 20000 differences")));
}

TEST(Ifc, NamesMayBeInWindowsLetters) {
  Step step;
  const std::string shape = step.shape(step.shown(step.extruded(step.rectangle(1, 1), 1)));
  step.product("W\x96\xE4nde \x80", step.placement("$", step.origin), shape);
  step.product(
      "B\xC3\xB6"
      "den",
      step.placement("$", step.origin), shape);  // a line in UTF-8
  EXPECT_EQ(names_of(read_ifc(step)), (std::vector<std::string>{"W\xE2\x80\x93\xC3\xA4nde \xE2\x82\xAC",
                                                                "B\xC3\xB6"
                                                                "den"}));
}

TEST(Ifc, FilesThatAreNoneAreErrors) {
  const TemporaryFolder folder;
  const auto problem = [&](const std::string& text) { return error_of(read(folder.write("case.ifc", text))); };
  const std::string good = good_text();
  EXPECT_TRUE(read(folder.write("case.ifc", good)).has_value());
  EXPECT_TRUE(read(folder.write("CASE.IFC", "\xEF\xBB\xBF/* by hand */\n" + good + "\n\n")).has_value());
  EXPECT_THAT(problem(good.substr(0, good.size() / 2)),
              HasSubstr("case.ifc: the file is cut off: its last line, 'END-ISO-10303-21;', is missing"));
  EXPECT_THAT(problem("Dear Sir or Madam"), HasSubstr("this is no IFC file"));
  EXPECT_THAT(problem("<?xml version=\"1.0\"?><ifcXML/>"), HasSubstr("IFC as XML"));
  for (const auto& [schema, words] : {std::pair("AUTOMOTIVE_DESIGN", "STEP of another kind"),
                                      {"IFC1.5", "another version"},
                                      {"", "names no schema"}}) {
    std::string other = good;
    other.replace(other.find("IFC4'"), 4, schema);
    EXPECT_THAT(problem(other), HasSubstr(words));
  }
  std::string empty = good;
  const std::size_t data = empty.find("DATA;\n") + 6;
  empty.erase(data, empty.find("ENDSEC;", data) - data);
  EXPECT_THAT(problem(empty), HasSubstr("the file holds no product"));
}

TEST(Ifc, BrokenLinesAreSaid) {
  const std::string good = good_text();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    const TemporaryFolder folder;
    return read(folder.write("case.ifc", text));
  };
  for (const auto& [from, to, words] : std::vector<std::array<std::string, 3>>{
           {"IFCEXTRUDEDAREASOLID(", "IFCEXTRUDEDAREASOLID(#99999,", "(the file lacks its line #99999)"},
           {",1.,1.)", ",1e400,1.)", "with bodies in no finite place"},
           {"IFCLOCALPLACEMENT($,",
            "IFCLOCALPLACEMENT(" +
                good.substr(good.rfind('#', good.find("=IFCLOCAL")),
                            good.find("=IFCLOCAL") - good.rfind('#', good.find("=IFCLOCAL"))) +
                ",",
            "whose placement is on a grid or depends on itself"}})
    EXPECT_THAT(error_of(with(from, to)),
                testing::AllOf(HasSubstr("no product has a shape that can be drawn: products"), HasSubstr(words),
                               HasSubstr("'box' (IfcBuilding")));
  // A line that is not needed for the shape, and what a reader by recursion would not survive.
  const Model lost = model_of(with("IFCPRODUCTDEFINITIONSHAPE($,$,(", "IFCPRODUCTDEFINITIONSHAPE($,$,(#99999,"));
  ASSERT_EQ(lost.objects.size(), 1u);
  EXPECT_EQ(lost.objects[0].incomplete, "the file lacks its line #99999");
  EXPECT_EQ(model_of(with("DATA;\n", "DATA;\n#9999=IFCLABEL(" + std::string(200'000, '(') + ");\n")).objects.size(),
            1u);
}

/// A ZIP archive of one member, packed as one stored block of deflate (RFC 1951, 3.2.4).
std::string zipped(const std::string& name, const std::string& text, std::uint32_t claimed) {
  std::string packed(1, '\1');
  append_bytes(packed, static_cast<std::uint16_t>(text.size()));
  append_bytes(packed, static_cast<std::uint16_t>(~text.size()));
  packed += text;
  const auto sizes = [&](std::string& out) {
    append_bytes(out, std::uint32_t{0});  // time
    append_bytes(out, std::uint32_t{0});  // checksum, which is not looked at
    append_bytes(out, static_cast<std::uint32_t>(packed.size()));
    append_bytes(out, claimed);
    append_bytes(out, static_cast<std::uint16_t>(name.size()));
    append_bytes(out, std::uint16_t{0});
  };
  std::string zip = std::string("PK\3\4\24\0\0\0\10\0", 10);
  sizes(zip);
  zip += name + packed;
  const std::size_t directory = zip.size();
  zip += std::string("PK\1\2\24\0\24\0\0\0\10\0", 12);
  sizes(zip);
  zip += std::string(14, '\0') + name;
  const std::size_t length = zip.size() - directory;
  zip += std::string("PK\5\6\0\0\0\0\1\0\1\0", 12);
  append_bytes(zip, static_cast<std::uint32_t>(length));
  append_bytes(zip, static_cast<std::uint32_t>(directory));
  return zip + std::string(2, '\0');
}

TEST(Ifc, ArchivesAreUnpacked) {
  const TemporaryFolder folder;
  const std::string good = good_text();
  const auto size = static_cast<std::uint32_t>(good.size());
  const auto with = [&](const std::string& bytes) { return read(folder.write("case.ifczip", bytes)); };
  EXPECT_EQ(names_of(model_of(with(zipped("model.ifc", good, size)))), std::vector<std::string>{"box"});
  EXPECT_EQ(names_of(model_of(with(good))), std::vector<std::string>{"box"}) << "not packed, whatever it is called";
  EXPECT_THAT(error_of(with(zipped("model.txt", good, size))), HasSubstr("holds no file whose name ends in .ifc"));
  EXPECT_THAT(error_of(with(zipped("model.ifc", good.substr(0, 900), 900))), HasSubstr("the file is cut off"));
  EXPECT_THAT(error_of(with(zipped("model.ifc", good, 10))), HasSubstr("cannot be unpacked")) << "more than it says";
  EXPECT_THAT(error_of(with(zipped("model.ifc", good, 0xF0000000))), HasSubstr("more than 2 GiB"));
  const std::string zip = zipped("model.ifc", good, size);
  for (std::size_t length = 25; length < zip.size(); length += zip.size() / 7)
    EXPECT_THAT(error_of(with(zip.substr(0, length))), HasSubstr("the archive is cut off"));
}

TEST(Ifc, LimitsHold) {
  // A million instances of one box: too many for a second.
  Step step;
  const std::string map =
      step.line("IFCREPRESENTATIONMAP(" + step.origin + "," + step.shown(step.extruded(step.rectangle(1, 1), 1)) + ")");
  const std::string item =
      step.line("IFCMAPPEDITEM(" + map + "," +
                step.line("IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$," + step.point({0, 0, 0}) + ",$,$)") + ")");
  std::string items = item;
  items.reserve(9'000'000);
  for (int i = 1; i < 1'000'000; ++i) items += "," + item;
  step.product("many", step.placement("$", step.origin), step.shape(step.shown(items)));
  const TemporaryFolder folder;
  const auto file = folder.write("case.ifc", step.text());
  ReadOptions options;
  options.time_limit = std::chrono::seconds(1);
  EXPECT_THAT(error_of(read(file, options)), HasSubstr("time limit of 1 s"));
  options.time_limit = std::chrono::seconds(60);
  options.memory_limit_bytes = 400'000'000;
  EXPECT_THAT(error_of(read(file, options)), HasSubstr("case.ifc: "));
}

TEST(Ifc, WithoutNodeASentenceSaysWhatToInstall) {
  const TemporaryFolder folder;
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  const Result<Model> model = read(folder.write("case.ifc", good_text()));
  setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(error_of(model), HasSubstr("install Node.js 18 or newer"));
}

}  // namespace
}  // namespace impinge::io
