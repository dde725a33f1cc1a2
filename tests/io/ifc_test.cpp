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
using testing::HasSubstr;
using testing::IsEmpty;

using scenes::kFoot;
using scenes::kMetre;
using scenes::kMillimetre;

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
      IfcFile step(schema, unit.unit);
      step.product("box", step.place({100, 200, 300}), step.block(40, 20, 50));
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
  IfcFile step("IFC2X3", kMillimetre);
  const std::string at = step.place({1000, 2000, 0});
  const std::string wall = step.product("Wall", at, step.block(4000, 200, 3000), "IFCWALL", ",$");
  const std::string hole = step.extruded(step.rectangle(1000, 400), 2000);
  const std::string opening =
      step.product("Opening", step.placement(at, step.axes({500, 0, 500})), step.body(hole), "IFCOPENINGELEMENT", ",$");
  step.related("IFCRELVOIDSELEMENT", wall, opening);
  step.product("Room", at, step.body(hole), "IFCSPACE", ",$,.ELEMENT.,.INTERNAL.,$");
  const std::string door = step.product("Door", at, step.block(900, 50, 1900), "IFCDOOR", ",$,$,$");
  step.related("IFCRELFILLSELEMENT", opening, door);
  step.related("IFCRELFILLSELEMENT", opening, "$");
  // What projects from the wall is a body of it.
  const std::string pilaster = step.product("Pilaster", at, step.block(400, 600, 3000), "IFCPROJECTIONELEMENT", ",$");
  step.related("IFCRELPROJECTSELEMENT", wall, pilaster);
  const std::string facade = step.product("Facade", at, "$", "IFCCURTAINWALL", ",$");
  step.related("IFCRELAGGREGATES", facade, "(" + wall + ")");
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
  IfcFile step;
  // Each wall has a mesh of its own, so that none is known from an earlier one.
  const auto own_box = [&] { return step.block(1, 1, 1); };
  const std::string box = own_box();
  const std::string on_grid = step.on_grid(), at = step.place({100, 0, 0});
  // A thing that shows itself, on which web-ifc traps.
  const std::string item = step.mapped("#9000"), endless = step.body(item);
  for (const auto& [name, place, shape] : std::vector<std::array<std::string, 3>>{
           {"good", at, box}, {"on grid", on_grid, box}, {"looping", "#9002", box}, {"endless", at, endless}}) {
    const std::string wall = step.product(name, at, own_box(), "IFCWALL", ",$,$");
    const std::string part = step.product("part", place, shape, "IFCPROJECTIONELEMENT", ",$,$");
    step.related("IFCRELPROJECTSELEMENT", wall, part);
  }
  const Model model = read_text(
      step.text(step.shows_itself(item) +
                fmt::format("#9002=IFCLOCALPLACEMENT(#9003,{0});\n#9003=IFCLOCALPLACEMENT(#9002,{0});\n", step.origin)),
      "case.ifc");
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
  IfcFile step;
  const std::string map = step.map_of(step.shown(step.extruded(step.rectangle(2, 1), 3)));
  const auto axes = [&](const Point& x, const Point& y) { return step.direction(x) + "," + step.direction(y); };
  const std::string up = step.direction({0, 0, 1}), down = step.direction({0, 0, -1});
  const std::string uneven =
      step.line("IFCCARTESIANTRANSFORMATIONOPERATOR3DNONUNIFORM($,$,{},1.,$,2.,3.)", step.point({0, 0, 0}));
  double x = 0;
  for (const auto& [name, item] : std::vector<std::pair<std::string, std::string>>{
           {"plain", step.mapped(map)},
           {"moved", step.mapped(map, "$,$", {0, 0, 7}, "1.,$")},
           {"turned", step.mapped(map, axes({0, 1, 0}, {-1, 0, 0}), {}, "1.," + up)},
           {"mirrored", step.mapped(map, axes({1, 0, 0}, {0, 1, 0}), {}, "1.," + down)},
           {"scaled", step.line("IFCMAPPEDITEM({},{})", map, uneven)}})
    step.product(name, step.place({x += 10, 0, 0}), step.body(item));
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
  IfcFile step;
  const std::string a = step.extruded(step.rectangle(2, 1), 3);
  const std::string b = step.line("IFCEXTRUDEDAREASOLID({},{},{},1.)", step.rectangle(1, 1), step.axes({5, 0, 0}),
                                  step.direction({0, 0, 1}));
  step.product("two", step.placement("$", step.axes({0, 0, 10}, {0, 0, 1}, {0, 1, 0})), step.body(a + "," + b));
  // Beside its body a product may show its axis, its outline on the floor, a box about it, and room to keep free.
  step.product(
      "door", step.place({0, 0, 20}),
      step.shape(step.shown(a) + "," +
                 step.shown(step.line("IFCPOLYLINE(({},{}))", step.point({0, 0, 0}), step.point({9, 0, 0})), "Axis") +
                 "," + step.shown(step.line("IFCBOUNDINGBOX({},9.,9.,9.)", step.point({0, 0, 0})), "Box") + "," +
                 step.shown(step.extruded(step.rectangle(9, 9), 9), "Clearance")));
  // The same body twice, once as a mirror image.
  const std::string map = step.map_of(step.shown(a));
  const std::string axes = step.direction({1, 0, 0}) + "," + step.direction({0, 1, 0});
  const auto mapped = [&](double z) { return step.mapped(map, axes, {}, "1.," + step.direction({0, 0, z})); };
  for (const double z : {1, -1}) step.solid("mirrored", mapped(z) + "," + mapped(-z));
  const Model model = read_ifc(step);
  ASSERT_EQ(names_of(model), (std::vector<std::string>{"two", "door", "mirrored", "mirrored (2)"}));
  for (const int i : {2, 3}) EXPECT_NEAR(volume_of(model.objects[i]), 12, 1e-5);
  expect_box(model.objects[0], {{-0.5, -1, 10}, {0.5, 5.5, 13}}, 1e-6);
  EXPECT_NEAR(volume_of(model.objects[0]), 7, 1e-5);
  expect_box(model.objects[1], {{-1, -0.5, 20}, {1, 0.5, 23}}, 1e-6);
  EXPECT_THAT(model.missing, IsEmpty());
}

TEST(Ifc, LargeCoordinatesAreExact) {
  IfcFile step;
  // A national grid: nested placements, a turn by a Pythagorean angle.
  const std::string site = step.place({5'000'000.125, 4'500'000.25, 300});
  const std::string turned = step.placement(site, step.axes({10, 0, 0}, {0, 0, 1}, {0.6, 0.8, 0}));
  const std::string box = step.block(0.5, 0.25, 0.125);
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
  IfcFile step;
  const std::string box = step.extruded(step.rectangle(1, 1), 1);
  for (const char* name : {R"(Basic Wall: Interior - Partition (92mm Stud))", R"(\X2\0159\X0\ez \X2\58C1\X0\)",
                           R"(St\X\FCtze)", R"(O''Brien)"})
    step.solid(name, box);
  step.product("$", step.place(), step.body(box));
  EXPECT_EQ(names_of(read_ifc(step)),
            (std::vector<std::string>{"Basic Wall: Interior - Partition (92mm Stud)", "\u0159ez \u58c1", "St\u00fctze",
                                      "O'Brien", "IfcBuildingElementProxy"}));
}

TEST(Ifc, PropertiesAreOfTheProductItsTypeAndWhatItIsRelatedTo) {
  IfcFile step;
  const auto related = [&](const std::string& kind, const std::string& parts, const std::string& to) {
    step.related(kind, "(" + parts + ")", to);
  };
  const auto set = [&](const std::string& name, const std::vector<std::pair<std::string, std::string>>& values) {
    std::vector<std::string> lines;
    for (const auto& [key, value] : values)
      lines.push_back(step.line("IFCPROPERTYSINGLEVALUE('{}',$,{},$)", key, value));
    return step.line("IFCPROPERTYSET('{}',$,'{}',$,({}))", step.guid(), name, fmt::join(lines, ","));
  };
  const std::string shown = step.shown(step.extruded(step.rectangle(1, 1), 1));
  step.line("IFCPRESENTATIONLAYERASSIGNMENT('A-WALL',$,({}),$)", shown);
  const std::string wall = step.product("wall", step.place(), step.shape(shown), "IFCWALL");
  related("IFCRELDEFINESBYTYPE", wall,
          step.line("IFCWALLTYPE('{}',$,'WT01',$,$,({}),$,$,$,.STANDARD.)", step.guid(),
                    set("Pset_WallCommon", {{"FireRating", "IFCLABEL('1HR')"}, {"IsExternal", "IFCBOOLEAN(.T.)"}})));
  related("IFCRELDEFINESBYPROPERTIES", wall,
          set("Pset_WallCommon", {{"FireRating", "IFCLABEL('2HR')"}, {"Width", "IFCLENGTHMEASURE(0.25)"}}));
  std::vector<std::string> layers;
  for (const char* name : {"brick", "wool"})
    layers.push_back(step.line("IFCMATERIALLAYER({},0.1,$,$,$,$,$)", step.line("IFCMATERIAL('{}',$,$)", name)));
  related("IFCRELASSOCIATESMATERIAL", wall,
          step.line("IFCMATERIALLAYERSETUSAGE({},.AXIS2.,.POSITIVE.,0.,$)",
                    step.line("IFCMATERIALLAYERSET(({}),$,$)", fmt::join(layers, ","))));
  for (const auto& [kind, name] : {std::pair("IFCSYSTEM", "Supply"), {"IFCGROUP", "Phase 1"}})
    related("IFCRELASSIGNSTOGROUP", wall, "$," + step.line("{}('{}',$,'{}',$,$)", kind, step.guid(), name));
  related("IFCRELASSOCIATESCLASSIFICATION", wall, step.line("IFCCLASSIFICATIONREFERENCE($,'Ss_25','Walls',$,$,$)"));
  // A list that holds itself, and twice.
  const std::string other = step.product("other", step.place(), step.shape(shown));
  const std::string before = step.line("IFCMATERIAL('sand',$,$)");
  const std::string list = "#" + std::to_string(std::stoi(before.substr(1)) + 1);
  std::string items = before;
  for (int i = 0; i < 100; ++i) items += "," + list;
  EXPECT_EQ(step.line("IFCMATERIALLIST(({}))", items), list);
  const std::string type = step.line("IFCWALLTYPE('{}',$,'WT02',$,$,$,$,$,$,.STANDARD.)", step.guid());
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
    IfcFile step(schema);
    const std::string shape = step.block(1, 1, 1);
    const std::string at = step.place();
    const std::string beam = step.product("a", at, shape, "IFCSLAB", ",'T',.ROOF.");
    step.product("b", at, shape, "IFCBUILDINGELEMENTPROXY", ",'T',.ELEMENT.");
    step.product("c", at, shape, "IFCCOVERING", ",'T',.NOTDEFINED.");
    const std::string frame = step.product("Frame", at, "$", "IFCELEMENTASSEMBLY", ",'T',.SITE.,.TRUSS.");
    step.related("IFCRELAGGREGATES", frame, "(" + beam + ")");
    const Model model = read_ifc(step);
    ASSERT_EQ(names_of(model), (std::vector<std::string>{"a", "b", "c"}));
    EXPECT_EQ(said(model.objects[0], "PredefinedType"), "ROOF");
    EXPECT_EQ(said(model.objects[1], "PredefinedType"), schema == std::string("IFC4") ? "ELEMENT" : "");
    EXPECT_EQ(said(model.objects[2], "PredefinedType"), "");
    EXPECT_EQ(said(model.objects[0], "assembly"), "Frame");
  }
}

TEST(Ifc, WhatIsNotDrawnIsNamed) {
  IfcFile step;
  const std::string box = step.extruded(step.rectangle(1, 1), 1), at = step.place();
  step.product("shapeless", at, "$", "IFCPUMP");
  const std::string frame = step.product("frame", at, "$", "IFCELEMENTASSEMBLY", ",$,$,$");
  const std::string beam = step.product("beam", at, step.body(box), "IFCBEAM");
  step.related("IFCRELAGGREGATES", frame, "(" + beam + ")");
  const std::string a = step.line("IFCLOCALPLACEMENT(#9001,{})", step.origin);
  step.line("IFCPERSON($,$,$,$,$,$,$,$)");
  step.product("circular", a, step.body(box));
  const std::string bad = step.extruded(step.line("IFCCIRCLEPROFILEDEF(.AREA.,$,$,$)"), 1);
  step.solid("broken", bad);
  step.solid("hollow", "#9002");
  step.solid("partly", box + "," + bad);
  step.solid("after", box);
  // web-ifc would draw both at the origin.
  const std::string on_grid = step.on_grid();
  step.product("on axes", on_grid, step.body(box));
  step.product("beside", step.placement(on_grid, step.origin), step.body(box));
  const Model model = read_text(step.text("#9001=IFCLOCALPLACEMENT(" + a + "," + step.origin + ");\n"), "case.ifc");
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
  IfcFile step;
  const std::string box = step.extruded(step.rectangle(1, 1), 1);
  step.solid("before", box);
  const std::string item = step.mapped("#9000");
  step.solid("endless", item);
  step.solid("after", box);
  // What is cut out of itself, which web-ifc alone would follow into gigabytes.
  step.product("eaten", step.place(), step.body("#9003"), "IFCWALL", ",$,$");
  const std::string cut = fmt::format(
      "#9003=IFCBOOLEANRESULT(.DIFFERENCE.,#9004,{0});\n#9004=IFCBOOLEANRESULT(.DIFFERENCE.,#9003,{0});\n", box);
  const Model model = read_text(step.text(step.shows_itself(item) + cut), "case.ifc");
  EXPECT_EQ(names_of(model), (std::vector<std::string>{"before", "after"}));
  EXPECT_THAT(model.missing, testing::UnorderedElementsAre(HasSubstr("'endless' (IfcBuildingElementProxy"),
                                                           HasSubstr("leads back to itself")));
}

/// What web-ifc alone would take minutes and gigabytes for.
TEST(Ifc, ShapesWithinEachOtherAreCountedFirst) {
  IfcFile step;
  const std::string box = step.extruded(step.rectangle(1, 1), 1), at = step.place();
  step.solid("whole", box);
  std::string carved = box;
  for (int i = 0; i < 20'000; ++i) carved = step.line("IFCBOOLEANRESULT(.DIFFERENCE.,{},{})", carved, box);
  step.solid("carved", carved);
  std::string items = box, map;
  for (int i = 0; i < 60; ++i) {  // 2^60 shapes
    map = step.map_of(step.shown(items));
    items = step.mapped(map) + "," + step.mapped(map);
  }
  step.solid("forest", items);
  // Of which nothing is shown, and of which one is beside a box.
  map = step.map_of(step.shown(items));
  step.solid("alone", box);
  step.solid("partly", box + "," + step.mapped(map));
  const std::string opening = step.product("opening", at, step.body(carved), "IFCOPENINGELEMENT", ",$");
  const std::string host = step.solid("host", box);
  step.related("IFCRELVOIDSELEMENT", host, opening);
  // Out of the parts of a whole, and theirs, its openings are cut too: here one whose fillets do not fit.
  const std::string layer = step.solid("layer", box), stud = step.solid("stud", box);
  step.related("IFCRELAGGREGATES", layer, "(" + stud + ")");
  const std::string wall = step.product("wall", at, "$", "IFCWALL", ",$,$");
  step.related("IFCRELAGGREGATES", wall, "(" + layer + ")");
  const std::string beam =
      step.extruded(step.line("IFCISHAPEPROFILEDEF(.AREA.,$,{},0.5,0.5,0.1,0.1,0.4,$,$)", step.flat_axes()), 1);
  const std::string slot = step.product("slot", at, step.body(beam), "IFCOPENINGELEMENT", ",$,$");
  step.related("IFCRELVOIDSELEMENT", wall, slot);
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
  EXPECT_THAT(model.missing[1], testing::AllOf(HasSubstr("incomplete shape"), HasSubstr("'partly'"),
                                               HasSubstr("show more than 100000 shapes"), HasSubstr("'host'"),
                                               HasSubstr("an opening of it is not drawn in full: 20000 differences")));
}

TEST(Ifc, NamesMayBeInWindowsLetters) {
  IfcFile step;
  const std::string shape = step.block(1, 1, 1);
  step.product("W\x96\xE4nde \x80", step.place(), shape);
  step.product("R\xC3\xBCst", step.place(), shape);  // a line in UTF-8
  EXPECT_EQ(names_of(read_ifc(step)),
            (std::vector<std::string>{"W\xE2\x80\x93\xC3\xA4nde \xE2\x82\xAC", "R\xC3\xBCst"}));
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
  const std::size_t placement = good.find("=IFCLOCAL"), number = good.rfind('#', placement);
  const std::string own_number = good.substr(number, placement - number);
  for (const auto& [from, to, words] : std::vector<std::array<std::string, 3>>{
           {"IFCEXTRUDEDAREASOLID(", "IFCEXTRUDEDAREASOLID(#99999,", "(the file lacks its line #99999)"},
           {",1.,1.)", ",1e400,1.)", "with bodies in no finite place"},
           {"IFCLOCALPLACEMENT($,", "IFCLOCALPLACEMENT(" + own_number + ",",
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

TEST(Ifc, ArchivesAreUnpacked) {
  const TemporaryFolder folder;
  const std::string good = good_text();
  const auto with = [&](const std::string& bytes) { return read(folder.write("case.ifczip", bytes)); };
  const auto zipped = [&](const std::string& name, const std::string& text) {
    write_zip(folder.path() / "case.ifczip", {{name, text}});
    return folder.read("case.ifczip");
  };
  const std::string zip = zipped("model.ifc", good);
  // The directory's entry says it at byte 24 (PKWARE's APPNOTE.TXT, 4.3.12).
  const auto claiming = [&](std::uint32_t size) {
    std::string bytes;
    append_bytes(bytes, size);
    return std::string(zip).replace(zip.find("PK\1\2") + 24, 4, bytes);
  };
  EXPECT_EQ(names_of(model_of(with(zip))), std::vector<std::string>{"box"});
  EXPECT_EQ(names_of(model_of(with(good))), std::vector<std::string>{"box"}) << "not packed, whatever it is called";
  EXPECT_THAT(error_of(with(zipped("model.txt", good))), HasSubstr("holds no file whose name ends in .ifc"));
  EXPECT_THAT(error_of(with(zipped("model.ifc", good.substr(0, 900)))), HasSubstr("the file is cut off"));
  EXPECT_THAT(error_of(with(claiming(10))), HasSubstr("cannot be unpacked")) << "more than it says";
  EXPECT_THAT(error_of(with(claiming(0xF0000000))), HasSubstr("more than 2 GiB"));
  for (std::size_t length = 25; length < zip.size(); length += zip.size() / 7)
    EXPECT_THAT(error_of(with(zip.substr(0, length))), HasSubstr("the archive is cut off"));
}

TEST(Ifc, LimitsHold) {
  // A million instances of one box: too many for a second.
  IfcFile step;
  const std::string item = step.mapped(step.map_of(step.shown(step.extruded(step.rectangle(1, 1), 1))));
  std::string items = item;
  items.reserve(9'000'000);
  for (int i = 1; i < 1'000'000; ++i) items += "," + item;
  step.solid("many", items);
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
