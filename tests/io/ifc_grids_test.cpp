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
using scenes::Step;

TEST(IfcGrids, StandWhereTheirAxesAre) {
  for (const char* schema : {"IFC2X3", "IFC4", "IFC4X3"})
    for (const auto& [unit, metres] : {std::pair(kMillimetre, 0.001), {kFoot, 0.3048}, {kMetre, 1.}}) {
      const bool degrees = metres == 1;
      Step step(schema, unit, 0, degrees);
      step.solid("box", step.extruded(step.rectangle(1, 1), 1));
      const std::string parent = step.placement("$", step.axes({5e6, 1000, 7}, {0, 0, 1}, {0, 1, 0}));
      const std::string at = step.placement(parent, step.axes({100, 200, 0}));
      const auto world = [](double x, double y) { return Point{5e6 - (200 + y), 1000 + 100 + x, 7}; };
      const auto axis = [&](const std::string& tag, const std::string& curve) {
        return step.line("IFCGRIDAXIS(" + tag + "," + step.line(curve) + ",.T.)");
      };
      const auto grid = [&](const std::string& name, const std::string& axes) {
        return step.line("IFCGRID('" + step.guid() + "',$," + name + ",$,$," + at + ",$," + axes +
                         (std::string(schema) == "IFC2X3" ? ")" : ",$)"));
      };
      const std::string turned =
          step.line("IFCAXIS2PLACEMENT2D(" + step.point(1, 2) + "," + step.line("IFCDIRECTION((0.,1.))") + ")");
      const std::string circle = step.line("IFCCIRCLE(" + turned + ",10.)");
      const std::string quarter = degrees ? "90." : "1.5707963267948966";
      const std::string in_storey = grid(
          "'Wing'", "(" + axis("'A'", "IFCPOLYLINE((" + step.point(0, 0) + "," + step.point(30, 4) + "))") + "),(" +
                        axis("'1'", "IFCTRIMMEDCURVE(" + circle + ",(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(" +
                                        quarter + ")),.T.,.PARAMETER.)") +
                        "," +
                        axis("$", "IFCTRIMMEDCURVE(" + circle + ",(" + step.point(1, 12) + "),(" + step.point(11, 2) +
                                      "),.F.,.CARTESIAN.)") +
                        "),(" +
                        axis("'x'", "IFCTRIMMEDCURVE(" +
                                        step.line("IFCLINE(" + step.point(3, 4) + "," +
                                                  step.line("IFCVECTOR(" + step.direction({0, 2, 0}) + ",5.)") + ")") +
                                        ",(IFCPARAMETERVALUE(1.)),(IFCPARAMETERVALUE(2.)),.T.,.PARAMETER.)") +
                        ")");
      step.line("IFCRELCONTAINEDINSPATIALSTRUCTURE('" + step.guid() + "',$,$,$,(" + in_storey + ")," + step.storey +
                ")");
      const std::string whole = axis("'C'", "IFCCIRCLE(" + turned + ",10.)");
      grid("$", "(" + whole + "),(" + whole + "),$");
      grid("'Old'", "(" + axis("'E'", "IFCELLIPSE(" + turned + ",1.,2.)") + "),(" + whole + "),$");
      Model model = read_ifc(step);
      EXPECT_EQ(model.warnings,
                std::vector<std::string>{"Clashes are not named by the axes of the grid 'Old': its axis 'E' is a curve "
                                         "that is not read (IfcEllipse); export the axes as lines and arcs."});
      ASSERT_EQ(model.grids.size(), 2u);
      EXPECT_EQ(model.grids[0].name, "Wing");
      EXPECT_EQ(model.grids[0].storey, "Level 1");
      EXPECT_EQ(model.grids[1].name, "IfcGrid");
      EXPECT_EQ(model.grids[1].storey, "");
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
  Step step;
  step.solid("box", step.extruded(step.rectangle(1, 1), 1));
  const std::string at = step.placement("$", step.origin);
  const auto grid = [&](const std::string& name, const std::string& curve) {
    const std::string axis = step.line("IFCGRIDAXIS('A'," + curve + ",.T.)");
    step.line("IFCGRID('" + step.guid() + "',$,'" + name + "',$,$," + at + ",$,(" + axis + "),(" + axis + "),$,$)");
  };
  const auto composite = [&](const std::string& part) {
    std::string parts = part;
    for (int i = 1; i < 200; ++i) parts += "," + part;
    return "IFCCOMPOSITECURVE((" + parts + "),.U.)";
  };
  const auto segment = [](const std::string& curve) {
    return "IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.," + curve + ")";
  };
  std::string curve = step.line("IFCPOLYLINE((" + step.point(0, 0) + "," + step.point(1, 0) + "))");
  grid("small", curve);
  for (int level = 0; level < 3; ++level) curve = step.line(composite(step.line(segment(curve))));
  grid("shared", curve);
  grid("loop", "#9000");
  std::string text = step.text();
  text.replace(text.find("ENDSEC;\nEND-"), 0, "#9000=" + composite("#9001") + ";\n#9001=" + segment("#9000") + ";\n");
  const Model model = read_text(text, "case.ifc");
  ASSERT_EQ(model.grids.size(), 1u);
  EXPECT_EQ(model.grids[0].name, "small");
  EXPECT_THAT(model.warnings, testing::UnorderedElementsAre(
                                  HasSubstr("'shared': its axes have more than 20000 points"),
                                  HasSubstr("'loop': its axis 'A' is a curve that is not read (IfcCompositeCurve)")));
}

/// A wall is placed there too: web-ifc says what is wrong with a placement only when it first meets it.
TEST(IfcGrids, WithBrokenPlacementsAreRefused) {
  Step step;
  const std::string box = step.shape(step.shown(step.extruded(step.rectangle(1, 1), 1)));
  const std::string axis = step.line(
      "IFCGRIDAXIS('A'," + step.line("IFCPOLYLINE((" + step.point(0, 0) + "," + step.point(1, 0) + "))") + ",.T.)");
  const auto linear = [&](const std::string& curve) {
    const std::string point = step.line("IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(3.),$,$,$," + curve + ")");
    return step.line("IFCLINEARPLACEMENT($," + step.line("IFCAXIS2PLACEMENTLINEAR(" + point + ",$,$)") + ",$)");
  };
  const std::string lacking = step.placement("$", "#9999");
  const std::vector<std::string> broken{"#9999",
                                        lacking,
                                        step.placement(lacking, step.origin),
                                        step.placement("$", step.line("IFCAXIS2PLACEMENT3D(#9999,$,$)")),
                                        step.placement("$", step.line("IFCAXIS2PLACEMENT3D(" + step.point({0, 0, 0}) +
                                                                      "," + step.point({0, 0, 1}) + ",$)")),
                                        step.origin,
                                        linear("#9999")};
  for (const std::string& place : broken) {
    step.product("wall", place, box);
    step.line("IFCGRID('" + step.guid() + "',$,'broken',$,$," + place + ",$,(" + axis + "),(" + axis + "),$,$)");
  }
  step.line("IFCGRID('" + step.guid() + "',$,'good',$,$," + step.placement("$", step.origin) + ",$,(" + axis + "),(" +
            axis + "),$,$)");
  step.solid("box", step.extruded(step.rectangle(1, 1), 1));
  const Model model = read_ifc(step);
  ASSERT_EQ(model.grids.size(), 1u);
  EXPECT_EQ(model.grids[0].name, "good");
  EXPECT_EQ(model.warnings.size(), broken.size());
  EXPECT_THAT(model.warnings,
              testing::Each(HasSubstr("'broken': its placement is on another grid or an alignment, or a "
                                      "line of it is missing or broken.")));
}

std::string good_text() {
  Step step;
  step.solid("box", step.extruded(step.rectangle(1, 1), 1));
  return step.text();
}

}  // namespace
}  // namespace impinge::io
