// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The grids of axes of IFC files.
#include "ifc_support.hpp"

namespace impinge::io {
namespace {

using testing::HasSubstr;

using scenes::kFoot;
using scenes::kMetre;
using scenes::kMillimetre;

TEST(IfcGrids, StandWhereTheirAxesAre) {
  for (const char* schema : {"IFC2X3", "IFC4", "IFC4X3"})
    for (const auto& [unit, metres] : {std::pair(kMillimetre, 0.001), {kFoot, 0.3048}, {kMetre, 1.}}) {
      const bool degrees = metres == 1;
      IfcFile step(schema, unit, 0, degrees);
      step.solid("box", step.extruded(step.rectangle(1, 1), 1));
      const std::string parent = step.placement("$", step.axes({5e6, 1000, 7}, {0, 0, 1}, {0, 1, 0}));
      const std::string at = step.placement(parent, step.axes({100, 200, 0}));
      const auto world = [](double x, double y) { return Point{5e6 - (200 + y), 1000 + 100 + x, 7}; };
      const auto axis = [&](const std::string& tag, const std::string& curve) {
        return step.line("IFCGRIDAXIS({},{},.T.)", tag, curve);
      };
      const auto grid = [&](const std::string& name, const std::string& axes) {
        return step.line("IFCGRID('{}',$,{},$,$,{},$,{}{}", step.guid(), name, at, axes,
                         (std::string(schema) == "IFC2X3" ? ")" : ",$)"));
      };
      const std::string turned = step.flat_axes(1, 2, step.line("IFCDIRECTION((0.,1.))"));
      const std::string circle = step.line("IFCCIRCLE({},10.)", turned);
      const std::string quarter = degrees ? "90." : "1.5707963267948966";
      const std::string upwards = step.line("IFCVECTOR({},5.)", step.direction({0, 2, 0}));
      const std::string straight = step.line("IFCLINE({},{})", step.point(3, 4), upwards);
      const std::string along = axis("'A'", step.polyline({{0, 0}, {30, 4}}));
      const std::string by_angles = axis("'1'", step.line("IFCTRIMMEDCURVE({},(IFCPARAMETERVALUE(0.)),"
                                                          "(IFCPARAMETERVALUE({})),.T.,.PARAMETER.)",
                                                          circle, quarter));
      const std::string by_points = axis("$", step.line("IFCTRIMMEDCURVE({},({}),({}),.F.,.CARTESIAN.)", circle,
                                                        step.point(1, 12), step.point(11, 2)));
      const std::string third = axis("'x'", step.line("IFCTRIMMEDCURVE({},(IFCPARAMETERVALUE(1.)),"
                                                      "(IFCPARAMETERVALUE(2.)),.T.,.PARAMETER.)",
                                                      straight));
      const std::string in_storey =
          grid("'Wing'", fmt::format("({}),({},{}),({})", along, by_angles, by_points, third));
      step.related("IFCRELCONTAINEDINSPATIALSTRUCTURE", "(" + in_storey + ")", step.storey);
      const std::string whole = axis("'C'", circle);
      grid("$", fmt::format("({}),({}),$", whole, whole));
      grid("'Old'", fmt::format("({}),({}),$", axis("'E'", step.line("IFCELLIPSE({},1.,2.)", turned)), whole));
      Model model = read_ifc(step);
      EXPECT_EQ(model.warnings,
                std::vector<std::string>{"Clashes are not named by the axes of the grid 'Old': its axis 'E' is a curve "
                                         "that is not read (IfcEllipse); export the axes as lines and arcs."});
      ASSERT_EQ(model.grids.size(), 2u);
      EXPECT_EQ(model.grids[0].name + " of " + model.grids[0].storey, "Wing of Level 1");
      EXPECT_EQ(model.grids[1].name + " of " + model.grids[1].storey, "IfcGrid of ");
      ASSERT_TRUE(bring_to_unit(model, 2, "case.ifc").has_value());
      const auto expect_axis = [&](const GridAxis& found, const char* tag, std::uint32_t family, const Points& ends) {
        EXPECT_EQ(found.tag, tag);
        EXPECT_EQ(found.family, family);
        for (const std::size_t end : {0, 1}) {
          const Point& p = end == 0 ? found.points.front() : found.points.back();
          EXPECT_NEAR(p.x, ends[end].x * metres / 2, 1e-8) << tag;
          EXPECT_NEAR(p.y, ends[end].y * metres / 2, 1e-8) << tag;
          EXPECT_NEAR(p.z, ends[end].z * metres / 2, 1e-8) << tag;
        }
      };
      const std::vector<GridAxis>& axes = model.grids[0].axes;
      ASSERT_EQ(axes.size(), 4u);
      expect_axis(axes[0], "A", 0, {world(0, 0), world(30, 4)});
      expect_axis(axes[1], "1", 1, {world(1, 12), world(-9, 2)});
      expect_axis(axes[2], "", 1, {world(1, 12), world(11, 2)});
      expect_axis(axes[3], "x", 2, {world(3, 9), world(3, 14)});
      EXPECT_EQ(axes[0].points.size(), 2u);
      const Point middle = world(1, 2);
      for (const std::size_t arc : {1, 2}) {
        EXPECT_EQ(axes[arc].points.size(), 61u);
        for (const Point& p : axes[arc].points)
          EXPECT_NEAR(std::hypot(p.x - middle.x * metres / 2, p.y - middle.y * metres / 2), 5 * metres, 1e-8);
      }
      const GridAxis& closed = model.grids[1].axes[0];
      EXPECT_EQ(closed.points.size(), 241u);
      EXPECT_EQ(closed.points.front().x, closed.points.back().x);
      EXPECT_EQ(closed.points.front().y, closed.points.back().y);
    }
}

/// Composite curves of shared segments: 8 million points in a small file, and a curve of itself.
TEST(IfcGrids, OfEndlessCurvesAreRefused) {
  IfcFile step;
  step.solid("box", step.extruded(step.rectangle(1, 1), 1));
  const std::string at = step.place();
  const auto grid = [&](const std::string& name, const std::string& curve) {
    const std::string axis = step.line("IFCGRIDAXIS('A',{},.T.)", curve);
    step.line("IFCGRID('{}',$,'{}',$,$,{},$,({}),({}),$,$)", step.guid(), name, at, axis, axis);
  };
  const auto composite = [&](const std::string& part) {
    std::string parts = part;
    for (int i = 1; i < 200; ++i) parts += "," + part;
    return "IFCCOMPOSITECURVE((" + parts + "),.U.)";
  };
  const auto segment = [](const std::string& curve) {
    return "IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.," + curve + ")";
  };
  std::string curve = step.polyline({{0, 0}, {1, 0}});
  grid("small", curve);
  for (int level = 0; level < 3; ++level) curve = step.line(composite(step.line(segment(curve))));
  grid("shared", curve);
  grid("loop", "#9000");
  const std::string loop = "#9000=" + composite("#9001") + ";\n#9001=" + segment("#9000") + ";\n";
  const Model model = read_text(step.text(loop), "case.ifc");
  ASSERT_EQ(model.grids.size(), 1u);
  EXPECT_EQ(model.grids[0].name, "small");
  EXPECT_THAT(model.warnings, testing::UnorderedElementsAre(
                                  HasSubstr("'shared': its axes have more than 20000 points"),
                                  HasSubstr("'loop': its axis 'A' is a curve that is not read (IfcCompositeCurve)")));
}

/// A wall is placed there too: web-ifc says what is wrong with a placement only when it first meets it.
TEST(IfcGrids, WithBrokenPlacementsAreRefused) {
  IfcFile step;
  const std::string box = step.block(1, 1, 1);
  const std::string axis = step.line("IFCGRIDAXIS('A',{},.T.)", step.polyline({{0, 0}, {1, 0}}));
  const auto linear = [&](const std::string& curve) {
    const std::string point = step.line("IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(3.),$,$,$,{})", curve);
    return step.line("IFCLINEARPLACEMENT($,{},$)", step.line("IFCAXIS2PLACEMENTLINEAR({},$,$)", point));
  };
  const std::string lacking = step.placement("$", "#9999");
  const std::vector<std::string> broken{
      "#9999",
      lacking,
      step.placement(lacking, step.origin),
      step.placement("$", step.line("IFCAXIS2PLACEMENT3D(#9999,$,$)")),
      step.placement("$", step.line("IFCAXIS2PLACEMENT3D({},{},$)", step.point({0, 0, 0}), step.point({0, 0, 1}))),
      step.origin,
      linear("#9999")};
  for (const std::string& place : broken) {
    step.product("wall", place, box);
    step.line("IFCGRID('{}',$,'broken',$,$,{},$,({}),({}),$,$)", step.guid(), place, axis, axis);
  }
  step.line("IFCGRID('{}',$,'good',$,$,{},$,({}),({}),$,$)", step.guid(), step.place(), axis, axis);
  step.solid("box", step.extruded(step.rectangle(1, 1), 1));
  const Model model = read_ifc(step);
  ASSERT_EQ(model.grids.size(), 1u);
  EXPECT_EQ(model.grids[0].name, "good");
  EXPECT_EQ(model.warnings.size(), broken.size());
  EXPECT_THAT(model.warnings,
              testing::Each(HasSubstr("'broken': its placement is on another grid or an alignment, or a "
                                      "line of it is missing or broken.")));
}

}  // namespace
}  // namespace impinge::io
