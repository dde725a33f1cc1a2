// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// What is drawn of the profiles and solids of IFC files: volumes, bounding boxes and closedness by formula.
#include <cmath>
#include <numbers>

#include "ifc_support.hpp"

namespace impinge::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using scenes::Step;

/// By the shoelace formula.
double area_of(const std::vector<std::array<double, 2>>& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& [ax, ay] = corners[i];
    const auto& [bx, by] = corners[(i + 1) % corners.size()];
    twice += ax * by - ay * bx;
  }
  return std::abs(twice) / 2;
}

/// What a round corner of radius 1 takes from a square one, or a fillet adds, drawn by chords of a 24th of the circle.
const double kCorner = 1 - 3 * std::sin(std::numbers::pi / 12);

/// What a profile of the standard makes, extruded by 10.
TEST(IfcShape, SolidsHaveTheVolumesOfTheirFormulas) {
  struct Case {
    std::string name;
    std::string (*item)(Step&);
    double volume, error;
  };
  const auto profile = [](Step& step, const std::string& text) {
    return step.extruded(step.line(text.substr(0, text.find('@')) + step.flat_axes() + text.substr(text.find('@') + 1)),
                         10);
  };
  static const auto make = profile;
  const auto by_operator = [](Step& step, const std::string& first_axes, const std::string& third) {
    const std::string map = step.line("IFCREPRESENTATIONMAP(" + step.origin + "," +
                                      step.shown(step.extruded(step.rectangle(4, 3), 10)) + ")");
    return step.line("IFCMAPPEDITEM(" + map + "," +
                     step.line("IFCCARTESIANTRANSFORMATIONOPERATOR3D(" + first_axes + "," + step.point({0, 0, 0}) +
                               ",2.," + third + ")") +
                     ")");
  };
  static const auto mapped = by_operator;
  const double chords = 24 * std::sin(std::numbers::pi / 24);  // the area of 48 chords in a circle of radius 1
  const std::vector<Case> cases{
      {"rectangle", [](Step& s) { return make(s, "IFCRECTANGLEPROFILEDEF(.AREA.,$,@,4.,3.)"); }, 120, 1e-5},
      {"hollow rectangle", [](Step& s) { return make(s, "IFCRECTANGLEHOLLOWPROFILEDEF(.AREA.,$,@,4.,3.,0.5,$,$)"); },
       60, 1e-5},
      {"circle", [](Step& s) { return make(s, "IFCCIRCLEPROFILEDEF(.AREA.,$,@,2.)"); }, 40 * chords, 1e-3},
      {"pipe", [](Step& s) { return make(s, "IFCCIRCLEHOLLOWPROFILEDEF(.AREA.,$,@,2.,0.5)"); }, 17.5 * chords, 1e-3},
      {"ellipse", [](Step& s) { return make(s, "IFCELLIPSEPROFILEDEF(.AREA.,$,@,3.,2.)"); }, 60 * chords, 1e-3},
      {"I", [](Step& s) { return make(s, "IFCISHAPEPROFILEDEF(.AREA.,$,@,4.,6.,0.5,1.,$,$,$)"); }, 10 * (8 + 4 * 0.5),
       1e-5},
      {"L", [](Step& s) { return make(s, "IFCLSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,1.,$,$,$)"); }, 10 * 9, 1e-5},
      {"U", [](Step& s) { return make(s, "IFCUSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,1.,0.5,$,$,$)"); }, 10 * (4 + 5), 1e-5},
      {"T", [](Step& s) { return make(s, "IFCTSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,1.,0.5,$,$,$,$,$)"); }, 10 * (2 + 5.5),
       1e-5},
      {"C", [](Step& s) { return make(s, "IFCCSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,0.5,1.,$)"); }, 10 * (3 + 3 + 2 * 0.5),
       1e-5},
      {"Z", [](Step& s) { return make(s, "IFCZSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,1.,0.5,$,$)"); }, 10 * (6 + 2 * 1.5),
       1e-5},
      {"C with a radius", [](Step& s) { return make(s, "IFCCSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,0.5,1.,0.2)"); },
       10 * (3 + 3 + 2 * 0.5 + 4 * kCorner * (0.2 * 0.2 - 0.7 * 0.7)), 1e-5},
      {"trapezium", [](Step& s) { return make(s, "IFCTRAPEZIUMPROFILEDEF(.AREA.,$,@,6.,4.,3.,1.)"); }, 150, 1e-5},
      {"asymmetric I",
       [](Step& s) { return make(s, "IFCASYMMETRICISHAPEPROFILEDEF(.AREA.,$,@,6.,6.,1.,0.5,$,4.,0.5,$,$,$,$,$)"); },
       10 * (3 + 2 + 5), 1e-5},
      {"fillets of I", [](Step& s) { return make(s, "IFCISHAPEPROFILEDEF(.AREA.,$,@,4.,6.,0.5,1.,0.3,0.1,$)"); },
       10 * (8 + 4 * 0.5 + 4 * kCorner * (0.3 * 0.3 - 0.1 * 0.1)), 1e-5},
      {"fillets of asymmetric I",
       [](Step& s) {
         return make(s, "IFCASYMMETRICISHAPEPROFILEDEF(.AREA.,$,@,6.,6.,1.,0.5,0.2,4.,0.5,0.3,0.1,$,0.1,$)");
       },
       10 * (3 + 2 + 5 + 2 * kCorner * (0.2 * 0.2 + 0.3 * 0.3 - 2 * 0.1 * 0.1)), 1e-5},
      {"fillets of L", [](Step& s) { return make(s, "IFCLSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,1.,0.5,0.3,$)"); },
       10 * (9 + kCorner * (0.5 * 0.5 - 2 * 0.3 * 0.3)), 1e-5},
      {"fillets of U", [](Step& s) { return make(s, "IFCUSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,1.,0.5,0.2,0.1,$)"); },
       10 * (9 + 2 * kCorner * (0.2 * 0.2 - 0.1 * 0.1)), 1e-5},
      {"fillets of T", [](Step& s) { return make(s, "IFCTSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,1.,0.5,0.2,0.1,0.3,$,$)"); },
       10 * (7.5 + 2 * kCorner * (0.2 * 0.2 - 0.1 * 0.1 - 0.3 * 0.3)), 1e-5},
      {"fillets of Z", [](Step& s) { return make(s, "IFCZSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,1.,0.5,0.2,0.1)"); },
       10 * (9 + 2 * kCorner * (0.2 * 0.2 - 0.1 * 0.1)), 1e-5},
      // Sloped flanges by the means of their two ends' thicknesses; tan(0.1) a unit of length.
      {"slopes of I", [](Step& s) { return make(s, "IFCISHAPEPROFILEDEF(.AREA.,$,@,4.,6.,0.5,1.,$,$,0.1)"); },
       10 * (3 + 4 * 1.75 * (1 + (0.75 - 1) / 2 * std::tan(0.1))), 1e-5},
      {"slopes of U", [](Step& s) { return make(s, "IFCUSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,1.,0.5,$,$,0.1)"); },
       10 * (6 + 2 * 3 * (0.5 + (1. - 2) / 2 * std::tan(0.1))), 1e-5},
      // What is beside the legs and the web, of which the inner corner is where the sloped faces meet.
      {"slopes of L",
       [](Step& s) { return make(s, "IFCLSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,1.,$,$,0.09966865249116203)"); },
       10 * (24 - area_of({{2, 3}, {-1 - 0.3, 3}, {-0.8 / 0.99, -1.9 / 0.99}, {2, -2 - 0.2}})), 1e-5},
      {"slopes of T",
       [](Step& s) {
         return make(s, "IFCTSHAPEPROFILEDEF(.AREA.,$,@,6.,4.,1.,0.5,$,$,$,0.09966865249116203,0.09966865249116203)");
       },
       // X = 0.5 + Y / 10 meets Y = 2.5 + (X - 1) / 10.
       10 * (24 - 2 * area_of({{2, -3}, {2, 2.6}, {0.74 / 0.99, 2.45 / 0.99}, {0.2, -3}})), 1e-5},
      {"centre line",
       [](Step& s) {
         const std::string line =
             s.line("IFCPOLYLINE((" + s.point(0, 0) + "," + s.point(5, 0) + "," + s.point(5, 3) + "))");
         return s.extruded(s.line("IFCCENTERLINEPROFILEDEF(.CURVE.,$," + line + ",1.)"), 10);
       },
       10 * (5.5 + 2.5), 1e-5},
      {"centre line with an arc",
       [](Step& s) {
         const std::string points = s.line(
             "IFCCARTESIANPOINTLIST2D(((0.,0.),(10.,0.),(11.414213562373096,0.585786437626904),(12.,2.),(12.,12.)))");
         const std::string line = s.line("IFCINDEXEDPOLYCURVE(" + points +
                                         ",(IFCLINEINDEX((1,2)),IFCARCINDEX((2,3,4)),IFCLINEINDEX((4,5))),.F.)");
         return s.extruded(s.line("IFCCENTERLINEPROFILEDEF(.CURVE.,$," + line + ",1.)"), 10);
       },
       // 12 chords of a quarter circle of radius 2.
       10 * (20 + 12 * 4 * std::sin(std::numbers::pi / 48)), 1e-4},
      {"centre line of a line backwards and a trimmed circle",
       [](Step& s) {
         const std::string circle = s.line(
             "IFCCIRCLE(" +
             s.line("IFCAXIS2PLACEMENT2D(" + s.point(10, 2) + "," + s.line("IFCDIRECTION((0.,-1.))") + ")") + ",2.)");
         const auto segment = [&](const std::string& curve, const char* sense) {
           return s.line(std::string("IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,") + sense + "," + curve + ")");
         };
         const std::string line = s.line(
             "IFCCOMPOSITECURVE((" +
             segment(s.line("IFCPOLYLINE((" + s.point(10, 0) + "," + s.point(0, 0) + "))"), ".F.") + "," +
             segment(s.line("IFCTRIMMEDCURVE(" + circle + ",(IFCPARAMETERVALUE(0.)),(" + s.point(12, 2) +
                            "),.T.,.UNSPECIFIED.)"),
                     ".T.") +
             "," + segment(s.line("IFCPOLYLINE((" + s.point(12, 2) + "," + s.point(12, 12) + "))"), ".T.") + "),.F.)");
         return s.extruded(s.line("IFCCENTERLINEPROFILEDEF(.CURVE.,$," + line + ",1.)"), 10);
       },
       10 * (20 + 12 * 4 * std::sin(std::numbers::pi / 48)), 1e-4},
      {"centre line that is closed",
       [](Step& s) {
         const std::string first = s.point(0, 0);
         const std::string line = s.line("IFCPOLYLINE((" + first + "," + s.point(4, 0) + "," + s.point(4, 3) + "," +
                                         s.point(0, 3) + "," + first + "))");
         return s.extruded(s.line("IFCCENTERLINEPROFILEDEF(.CURVE.,$," + line + ",1.)"), 10);
       },
       10 * (5 * 4 - 3 * 2), 1e-5},
      {"composite",
       [](Step& s) {
         const std::string z = s.line("IFCZSHAPEPROFILEDEF(.AREA.,$," + s.flat_axes() + ",6.,4.,1.,0.5,$,$)");
         const std::string at = s.line("IFCAXIS2PLACEMENT2D(" + s.point(20, 0) + ",$)");
         return s.extruded(s.line("IFCCOMPOSITEPROFILEDEF(.AREA.,$,(" + z + "," +
                                  s.line("IFCRECTANGLEPROFILEDEF(.AREA.,$," + at + ",2.,3.)") + "),$)"),
                           10);
       },
       90 + 60, 1e-4},
      {"tapered",
       [](Step& s) {
         return s.line("IFCEXTRUDEDAREASOLIDTAPERED(" + s.rectangle(2, 2) + "," + s.origin + "," +
                       s.direction({0, 0, 1}) + ",10.," + s.rectangle(1, 1) + ")");
       },
       10. / 3 * (4 + 2 + 1), 1e-4},
      {"rounded", [](Step& s) { return make(s, "IFCROUNDEDRECTANGLEPROFILEDEF(.AREA.,$,@,4.,3.,1.)"); },
       10 * (8 + chords), 1e-4},
      {"voids",
       [](Step& s) {
         const auto square = [&](double r) {
           const std::string first = s.point(-r, -r);
           return s.line("IFCPOLYLINE((" + first + "," + s.point(r, -r) + "," + s.point(r, r) + "," + s.point(-r, r) +
                         "," + first + "))");
         };
         const std::string outer = square(3), inner = square(1);
         return s.extruded(s.line("IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$," + outer + ",(" + inner + "))"), 10);
       },
       320, 1e-4},
      {"direction that is not of length 1",
       [](Step& s) {
         return s.line("IFCEXTRUDEDAREASOLID(" + s.rectangle(4, 3) + "," + s.origin + "," + s.direction({0, 3, 4}) +
                       ",10.)");
       },
       4 * 3 * 10 * 0.8, 1e-4},
      {"mapped by axes that are not at right angles",
       [](Step& s) {
         return mapped(s, s.direction({2, 0, 0}) + "," + s.direction({1, 1, 0}), "$");
       },
       120 * 8, 1e-3},
      {"mapped by a first axis alone",
       [](Step& s) {
         return mapped(s, s.direction({1, 1, 0}) + ",$", "$");
       },
       120 * 8, 1e-3},
      {"mapped by a second axis alone",
       [](Step& s) {
         return mapped(s, "$," + s.direction({1, 0, 0}), "$");
       },
       120 * 8, 1e-3},
      {"mapped by the outer axes",
       [](Step& s) {
         return mapped(s, s.direction({0, 1, 0}) + ",$", s.direction({1, 0, 0}));
       },
       120 * 8, 1e-3},
      {"derived by a first axis alone",
       [](Step& s) {
         return s.extruded(s.line("IFCDERIVEDPROFILEDEF(.AREA.,$," + s.rectangle(4, 3) + "," +
                                  s.line("IFCCARTESIANTRANSFORMATIONOPERATOR2D(" + s.line("IFCDIRECTION((0.,2.))") +
                                         ",$," + s.point(1, 2) + ",2.)") +
                                  ",$)"),
                           10);
       },
       120 * 4, 1e-3},
      {"windows in one line",
       [](Step& s) {
         const auto rectangle = [&](double x, double y, double to_x, double to_y) {
           const std::string first = s.point(x, y);
           return s.line("IFCPOLYLINE((" + first + "," + s.point(to_x, y) + "," + s.point(to_x, to_y) + "," +
                         s.point(x, to_y) + "," + first + "))");
         };
         return s.extruded(
             s.line("IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$," + rectangle(0, 0, 10, 5) + ",(" +
                    rectangle(1, 1, 2, 2) + "," + rectangle(3, 1, 4, 2) + "," + rectangle(6, 1, 7, 3) + "))"),
             2);
       },
       2 * (50 - 1 - 1 - 2), 1e-4},
      {"half space",
       [](Step& s) {
         const std::string plane = s.line("IFCPLANE(" + s.axes({0, 0, 4}, {0, 0, 1}, {1, 0, 0}) + ")");
         return s.line("IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.," + s.extruded(s.rectangle(4, 3), 10) + "," +
                       s.line("IFCHALFSPACESOLID(" + plane + ",.F.)") + ")");
       },
       48, 1e-4},
      {"ring",
       [](Step& s) {
         const std::string at = s.line("IFCAXIS2PLACEMENT2D(" + s.point(3, 0) + ",$)");
         return s.line("IFCREVOLVEDAREASOLID(" + s.line("IFCRECTANGLEPROFILEDEF(.AREA.,$," + at + ",1.,1.)") + "," +
                       s.origin + "," +
                       s.line("IFCAXIS1PLACEMENT(" + s.point({0, 0, 0}) + "," + s.direction({0, 1, 0}) + ")") +
                       ",6.283185307179586)");
       },
       6 * chords, 1e-2},
      {"swept disc",
       [](Step& s) {
         return s.line("IFCSWEPTDISKSOLID(" +
                       s.line("IFCPOLYLINE((" + s.point({0, 0, 0}) + "," + s.point({0, 0, 10}) + "))") + ",2.,$,$,$)");
       },
       40 * chords, 1e-2},
      {"facets",
       [](Step& s) {
         return s.line("IFCTRIANGULATEDFACESET(" +
                       s.line("IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(3.,0.,0.),(0.,4.,0.),(0.,0.,5.)))") +
                       ",$,.T.,((1,3,2),(1,2,4),(2,3,4),(1,4,3)),$)");
       },
       10, 1e-5},
      {"minus",
       [](Step& s) {
         return s.line("IFCBOOLEANRESULT(.DIFFERENCE.," + s.extruded(s.rectangle(4, 3), 10) + "," +
                       s.extruded(s.rectangle(2, 1), 20) + ")");
       },
       100, 1e-4},
  };
  Step step;
  for (const Case& one : cases) step.solid(one.name, one.item(step));
  const Model model = read_ifc(step);
  EXPECT_THAT(model.missing, IsEmpty());
  ASSERT_EQ(model.objects.size(), cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_NEAR(volume_of(model.objects[i]), cases[i].volume, cases[i].error) << cases[i].name;
    EXPECT_TRUE(is_closed(model.objects[i])) << cases[i].name;
  }
}

TEST(IfcShape, ProfilesStandWhereTheyShould) {
  Step step;
  const std::string turned =
      step.line("IFCAXIS2PLACEMENT2D(" + step.point(10, 20) + "," + step.line("IFCDIRECTION((0.,2.))") + ")");
  const auto profile = [&](const std::string& text) {
    const std::string made = step.line(text);
    step.solid("p", step.extruded(made, 3));
    return made;
  };
  const std::string z = profile("IFCZSHAPEPROFILEDEF(.AREA.,$," + turned + ",6.,4.,1.,0.5,$,$)");
  profile("IFCASYMMETRICISHAPEPROFILEDEF(.AREA.,$," + turned + ",6.,8.,1.,0.5,$,4.,0.5,$,$,$,$,$)");
  profile("IFCROUNDEDRECTANGLEPROFILEDEF(.AREA.,$," + turned + ",4.,2.,1.)");
  profile("IFCLSHAPEPROFILEDEF(.AREA.,$," + turned + ",6.,4.,1.,0.5,0.3,$)");
  const std::string mirrored = profile("IFCMIRROREDPROFILEDEF(.AREA.,$," + z + ",*,$)");
  profile("IFCMIRROREDPROFILEDEF(.AREA.,$," + mirrored + ",*,$)");
  profile("IFCDERIVEDPROFILEDEF(.AREA.,$," + z + "," +
          step.line("IFCCARTESIANTRANSFORMATIONOPERATOR2D($,$," + step.point(1, 2) + ",2.)") + ",$)");
  const Model model = read_ifc(step);
  EXPECT_THAT(model.missing, IsEmpty());
  ASSERT_EQ(model.objects.size(), 7u);
  // A quarter turn: the profile's x is y here.
  expect_box(model.objects[0], {{7, 16.5, 0}, {13, 23.5, 3}}, 1e-6);
  expect_box(model.objects[1], {{6, 17, 0}, {14, 23, 3}}, 1e-6);
  expect_box(model.objects[2], {{9, 18, 0}, {11, 22, 3}}, 1e-6);
  expect_box(model.objects[3], {{7, 18, 0}, {13, 22, 3}}, 1e-6);
  expect_box(model.objects[4], {{-13, 16.5, 0}, {-7, 23.5, 3}}, 1e-6);
  expect_box(model.objects[5], {{7, 16.5, 0}, {13, 23.5, 3}}, 1e-6);
  expect_box(model.objects[6], {{15, 35, 0}, {27, 49, 3}}, 1e-5);
  for (const int i : {0, 4, 5}) EXPECT_NEAR(volume_of(model.objects[i]), 3 * 9, 1e-5) << "outward: " << i;
}

/// The lower flange of a Z points to x, the upper one away from it.
TEST(IfcShape, FlangesOfZPointTheWayOfTheStandardsFigure) {
  Step step;
  step.solid(
      "z", step.line(
               "IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.," +
               step.extruded(step.line("IFCZSHAPEPROFILEDEF(.AREA.,$," + step.flat_axes() + ",6.,4.,1.,0.5,$,$)"), 10) +
               "," +
               step.line("IFCHALFSPACESOLID(" +
                         step.line("IFCPLANE(" + step.axes({0, 0, 0}, {0, 1, 0}, {1, 0, 0}) + ")") + ",.F.)") +
               ")"));
  const Model model = read_ifc(step);
  ASSERT_EQ(model.objects.size(), 1u);
  expect_box(model.objects[0], {{-0.5, -3, 0}, {3.5, 0, 10}}, 1e-6);
}

TEST(IfcShape, RadiiThatDoNotFitAreSaid) {
  Step step;
  const std::string solid =
      step.extruded(step.line("IFCISHAPEPROFILEDEF(.AREA.,$," + step.flat_axes() + ",4.,6.,0.5,1.,3.,$,$)"), 10);
  step.solid("plain", solid);
  step.solid("cut", step.line("IFCBOOLEANRESULT(.DIFFERENCE.," + solid + "," +
                              step.extruded(step.rectangle(0.5, 9), 10) + ")"));
  step.solid("other", step.extruded(step.rectangle(1, 1), 1));
  const Model model = read_ifc(step);
  ASSERT_EQ(model.objects.size(), 3u);
  EXPECT_NEAR(volume_of(model.objects[0]), 100, 1e-5) << "sharp";
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(model.objects[i].incomplete,
              i < 2 ? "the radii of its profile do not fit, and its corners are drawn sharp" : "");
  EXPECT_THAT(model.missing, ElementsAre(HasSubstr("'cut' (")));
}

/// Angles by formula, whatever their unit, and small ones that would be taken for radians.
TEST(IfcShape, AnglesAreInTheFilesUnit) {
  for (const bool degrees : {false, true}) {
    SCOPED_TRACE(degrees);
    Step s("IFC4", scenes::kMetre, 0, degrees);
    const auto angle = [&](double of) { return scenes::step_number(degrees ? of : of * std::numbers::pi / 180); };
    std::vector<double> volumes;
    const std::string far = s.line("IFCAXIS2PLACEMENT2D(" + s.point(30, 0) + ",$)");
    const std::string square = s.line("IFCRECTANGLEPROFILEDEF(.AREA.,$," + far + ",1.,1.)");
    const std::string axis = s.line("IFCAXIS1PLACEMENT(" + s.point({0, 0, 0}) + "," + s.direction({0, 1, 0}) + ")");
    for (const double of : {0.5, 3., 5.}) {
      s.solid("turned", s.line("IFCREVOLVEDAREASOLID(" + square + "," + s.origin + "," + axis + "," + angle(of) + ")"));
      volumes.push_back(30 * of * std::numbers::pi / 180);
    }
    // Sectors of a circle of radius 100.
    const std::string circle = s.line("IFCCIRCLE(" + s.flat_axes() + ",100.)");
    for (const auto& [from, to] : {std::pair(0., 3.), {1., 6.}, {88., 91.}, {300., 420.}}) {
      const auto on = [&](double of) {
        return s.point(100 * std::cos(of * std::numbers::pi / 180), 100 * std::sin(of * std::numbers::pi / 180));
      };
      const std::string arc = s.line("IFCTRIMMEDCURVE(" + circle + ",(IFCPARAMETERVALUE(" + angle(from) +
                                     ")),(IFCPARAMETERVALUE(" + angle(to) + ")),.T.,.PARAMETER.)");
      const std::string back = s.line("IFCPOLYLINE((" + on(to) + "," + s.point(0, 0) + "," + on(from) + "))");
      const auto segment = [&](const std::string& curve) {
        return s.line("IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.," + curve + ")");
      };
      s.solid("sector",
              s.extruded(s.line("IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$," +
                                s.line("IFCCOMPOSITECURVE((" + segment(arc) + "," + segment(back) + "),.F.)") + ")"),
                         1));
      volumes.push_back(5000 * (to - from) * std::numbers::pi / 180);
    }
    s.solid("slopes",
            s.extruded(s.line("IFCUSHAPEPROFILEDEF(.AREA.,$," + s.flat_axes() + ",6.,4.,1.,0.5,$,$," + angle(5) + ")"),
                       10));
    volumes.push_back(10 * (6 + 2 * 3 * (0.5 - 0.5 * std::tan(std::numbers::pi / 36))));
    const Model model = read_ifc(s);
    EXPECT_THAT(model.missing, IsEmpty());
    ASSERT_EQ(model.objects.size(), volumes.size());
    for (std::size_t i = 0; i < volumes.size(); ++i)
      EXPECT_NEAR(volume_of(model.objects[i]), volumes[i], 0.002 * volumes[i]) << i;
  }
}

/// A cylinder, and half a ball, of which web-ifc has no surface, as faces on curved surfaces.
TEST(IfcShape, AdvancedBrepsAreRightOrSaidToBeIncomplete) {
  Step s;
  const auto circle = [&](double z) { return s.line("IFCCIRCLE(" + s.axes({0, 0, z}) + ",2.)"); };
  const auto vertex = [&](const Point& at) { return s.line("IFCVERTEXPOINT(" + s.point(at) + ")"); };
  const auto edge = [&](const std::string& from, const std::string& to, const std::string& curve) {
    return s.line("IFCEDGECURVE(" + from + "," + to + "," + curve + ",.T.)");
  };
  const auto face = [&](const std::vector<std::pair<std::string, bool>>& edges, const std::string& surface) {
    std::string loop;
    for (const auto& [line, forward] : edges)
      loop += (loop.empty() ? "" : ",") + s.line("IFCORIENTEDEDGE(*,*," + line + (forward ? ",.T.)" : ",.F.)"));
    return s.line("IFCADVANCEDFACE((" + s.line("IFCFACEOUTERBOUND(" + s.line("IFCEDGELOOP((" + loop + "))") + ",.T.)") +
                  ")," + surface + ",.T.)");
  };
  const auto brep = [&](const std::string& faces) {
    return s.line("IFCADVANCEDBREP(" + s.line("IFCCLOSEDSHELL((" + faces + "))") + ")");
  };
  const std::string low = vertex({2, 0, 0}), high = vertex({2, 0, 5}), other = vertex({-2, 0, 0});
  const std::string bottom = edge(low, low, circle(0)), top = edge(high, high, circle(5));
  const std::string seam = edge(
      low, high,
      s.line("IFCLINE(" + s.point({2, 0, 0}) + "," + s.line("IFCVECTOR(" + s.direction({0, 0, 1}) + ",1.)") + ")"));
  const std::string down = s.line("IFCPLANE(" + s.axes({0, 0, 0}, {0, 0, -1}, {1, 0, 0}) + ")");
  s.solid("cylinder", brep(face({{bottom, false}}, down) + "," +
                           face({{top, true}}, s.line("IFCPLANE(" + s.axes({0, 0, 5}) + ")")) + "," +
                           face({{bottom, true}, {seam, true}, {top, false}, {seam, false}},
                                s.line("IFCCYLINDRICALSURFACE(" + s.origin + ",2.)"))));
  const std::string front = edge(low, other, circle(0)), back = edge(other, low, circle(0));
  s.solid("dome", brep(face({{back, false}, {front, false}}, down) + "," +
                       face({{front, true}, {back, true}}, s.line("IFCSPHERICALSURFACE(" + s.origin + ",2.)"))));
  const Model model = read_ifc(s);
  ASSERT_EQ(names_of(model), (std::vector<std::string>{"cylinder", "dome"}));
  EXPECT_NEAR(volume_of(model.objects[0]), 5 * 4 * 24 * std::sin(std::numbers::pi / 24), 1e-4);
  EXPECT_TRUE(is_closed(model.objects[0]));
  EXPECT_EQ(model.objects[0].incomplete, "");
  EXPECT_EQ(model.objects[1].incomplete, "web-ifc does not draw its kind of surface");
  EXPECT_THAT(model.missing, ElementsAre(HasSubstr("'dome' (")));
}

/// A tetrahedron with a face on a line: around it all other faces meet, unless one of them is missing.
TEST(IfcShape, FacesWithoutAnAreaTakeNothingFromAClosedBody) {
  Step s;
  std::vector<std::string> points;
  for (const Point& p : {Point{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {0, 0, 5}, {1, 0, 0}, {2, 0, 0}})
    points.push_back(s.point(p));
  for (const char* name : {"closed", "open"}) {
    std::string faces;
    for (const std::vector<std::size_t>& loop :
         {std::vector<std::size_t>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 4, 5, 1}, {0, 3, 2}}) {
      if (name == std::string("open") && loop.back() == 2) continue;
      std::string corners;
      for (const std::size_t i : loop) corners += (corners.empty() ? "" : ",") + points[i];
      faces += (faces.empty() ? "" : ",") +
               s.line("IFCFACE((" + s.line("IFCFACEOUTERBOUND(" + s.line("IFCPOLYLOOP((" + corners + "))") + ",.T.)") +
                      "))");
    }
    s.solid(name, s.line("IFCFACETEDBREP(" + s.line("IFCCLOSEDSHELL((" + faces + "))") + ")"));
  }
  const Model model = read_ifc(s);
  ASSERT_EQ(model.objects.size(), 2u);
  EXPECT_NEAR(volume_of(model.objects[0]), 10, 1e-5);
  EXPECT_EQ(model.objects[0].incomplete, "");
  EXPECT_EQ(model.objects[1].incomplete, "a face without an area is left out");
  EXPECT_THAT(model.missing, ElementsAre(HasSubstr("'open' (")));
}

/// Each of the first four vertices is within rounding of an edge between two others: cutting the triangles there makes
/// the same triangles again.
TEST(IfcShape, CuttingNearlyCollinearVerticesEnds) {
  Step s;
  const std::string points = s.line(
      "IFCCARTESIANPOINTLIST3D(((1000.,0.,0.),(1010.,0.0001,0.),(1020.,0.,0.),(1030.,0.,0.),(1005.,5000.,0.),"
      "(1005.,0.,5000.)))");
  s.solid("sliver", s.line("IFCTRIANGULATEDFACESET(" + points + ",$,$,((1,2,4),(1,3,5),(1,4,6)),$)"));
  const Model model = read_ifc(s);
  ASSERT_EQ(model.objects.size(), 1u);
  EXPECT_FALSE(is_closed(model.objects[0]));
}

TEST(IfcShape, PlacesMayBeLeftOut) {
  Step step;
  step.solid("p", step.line("IFCEXTRUDEDAREASOLID(" + step.line("IFCRECTANGLEPROFILEDEF(.AREA.,$,$,4.,3.)") + ",$," +
                            step.direction({0, 0, 1}) + ",5.)"));
  const Model model = read_ifc(step);
  ASSERT_EQ(model.objects.size(), 1u);
  expect_box(model.objects[0], {{-2, -1.5, 0}, {2, 1.5, 5}}, 1e-6);
  EXPECT_THAT(model.missing, IsEmpty());
}

}  // namespace
}  // namespace impinge::io
