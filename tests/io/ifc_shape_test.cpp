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

TEST(IfcShape, SolidsHaveTheVolumesOfTheirFormulas) {
  IfcFile s;
  // What a profile of the standard makes, extruded by 10.
  const auto profile = [&](const char* kind, const char* numbers) {
    return s.extruded(s.line("IFC{}PROFILEDEF(.AREA.,$,{},{})", kind, s.flat_axes(), numbers), 10);
  };
  const auto wall_along = [&](const std::string& line) {
    return s.extruded(s.line("IFCCENTERLINEPROFILEDEF(.CURVE.,$,{},1.)", line), 10);
  };
  const auto segment = [&](const std::string& curve, const char* sense) {
    return s.line("IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,{},{})", sense, curve);
  };
  const auto loop = [&](double x, double y, double to_x, double to_y) {
    return s.polyline({{x, y}, {to_x, y}, {to_x, to_y}, {x, to_y}}, true);
  };
  const std::string brick = s.extruded(s.rectangle(4, 3), 10), map = s.map_of(s.shown(brick));
  const std::string x = s.direction({1, 0, 0}), y = s.direction({0, 1, 0}), z = s.direction({0, 0, 1}),
                    diagonal = s.direction({1, 1, 0});
  const std::string circle = s.line("IFCCIRCLE({},2.)", s.flat_axes(10, 2, s.line("IFCDIRECTION((0.,-1.))")));
  const std::string quarter =
      s.line("IFCTRIMMEDCURVE({},(IFCPARAMETERVALUE(0.)),({}),.T.,.UNSPECIFIED.)", circle, s.point(12, 2));
  const std::string arc =
      s.line("IFCCARTESIANPOINTLIST2D(((0.,0.),(10.,0.),(11.414213562373096,0.585786437626904),(12.,2.),(12.,12.)))");
  const std::string plane = s.line("IFCPLANE({})", s.axes({0, 0, 4}, {0, 0, 1}, {1, 0, 0}));
  const double chords = 24 * std::sin(std::numbers::pi / 24);    // the area of 48 chords in a circle of radius 1
  const double bend = 12 * 4 * std::sin(std::numbers::pi / 48);  // 12 chords of a quarter circle of radius 2
  struct Case {
    std::string name, item;
    double volume, error;
  };
  const std::vector<Case> cases{
      {"rectangle", profile("RECTANGLE", "4.,3."), 120, 1e-5},
      {"hollow rectangle", profile("RECTANGLEHOLLOW", "4.,3.,0.5,$,$"), 60, 1e-5},
      {"circle", profile("CIRCLE", "2."), 40 * chords, 1e-3},
      {"pipe", profile("CIRCLEHOLLOW", "2.,0.5"), 17.5 * chords, 1e-3},
      {"ellipse", profile("ELLIPSE", "3.,2."), 60 * chords, 1e-3},
      {"I", profile("ISHAPE", "4.,6.,0.5,1.,$,$,$"), 10 * (8 + 4 * 0.5), 1e-5},
      {"L", profile("LSHAPE", "6.,4.,1.,$,$,$"), 10 * 9, 1e-5},
      {"U", profile("USHAPE", "6.,4.,1.,0.5,$,$,$"), 10 * (4 + 5), 1e-5},
      {"T", profile("TSHAPE", "6.,4.,1.,0.5,$,$,$,$,$"), 10 * (2 + 5.5), 1e-5},
      {"C", profile("CSHAPE", "6.,4.,0.5,1.,$"), 10 * (3 + 3 + 2 * 0.5), 1e-5},
      {"Z", profile("ZSHAPE", "6.,4.,1.,0.5,$,$"), 10 * (6 + 2 * 1.5), 1e-5},
      {"C with a radius", profile("CSHAPE", "6.,4.,0.5,1.,0.2"),
       10 * (3 + 3 + 2 * 0.5 + 4 * kCorner * (0.2 * 0.2 - 0.7 * 0.7)), 1e-5},
      {"trapezium", profile("TRAPEZIUM", "6.,4.,3.,1."), 150, 1e-5},
      {"asymmetric I", profile("ASYMMETRICISHAPE", "6.,6.,1.,0.5,$,4.,0.5,$,$,$,$,$"), 10 * (3 + 2 + 5), 1e-5},
      {"fillets of I", profile("ISHAPE", "4.,6.,0.5,1.,0.3,0.1,$"),
       10 * (8 + 4 * 0.5 + 4 * kCorner * (0.3 * 0.3 - 0.1 * 0.1)), 1e-5},
      {"fillets of asymmetric I", profile("ASYMMETRICISHAPE", "6.,6.,1.,0.5,0.2,4.,0.5,0.3,0.1,$,0.1,$"),
       10 * (3 + 2 + 5 + 2 * kCorner * (0.2 * 0.2 + 0.3 * 0.3 - 2 * 0.1 * 0.1)), 1e-5},
      {"fillets of L", profile("LSHAPE", "6.,4.,1.,0.5,0.3,$"), 10 * (9 + kCorner * (0.5 * 0.5 - 2 * 0.3 * 0.3)), 1e-5},
      {"fillets of U", profile("USHAPE", "6.,4.,1.,0.5,0.2,0.1,$"), 10 * (9 + 2 * kCorner * (0.2 * 0.2 - 0.1 * 0.1)),
       1e-5},
      {"fillets of T", profile("TSHAPE", "6.,4.,1.,0.5,0.2,0.1,0.3,$,$"),
       10 * (7.5 + 2 * kCorner * (0.2 * 0.2 - 0.1 * 0.1 - 0.3 * 0.3)), 1e-5},
      {"fillets of Z", profile("ZSHAPE", "6.,4.,1.,0.5,0.2,0.1"), 10 * (9 + 2 * kCorner * (0.2 * 0.2 - 0.1 * 0.1)),
       1e-5},
      // Sloped flanges by the means of their two ends' thicknesses; tan(0.1) a unit of length.
      {"slopes of I", profile("ISHAPE", "4.,6.,0.5,1.,$,$,0.1"),
       10 * (3 + 4 * 1.75 * (1 + (0.75 - 1) / 2 * std::tan(0.1))), 1e-5},
      {"slopes of U", profile("USHAPE", "6.,4.,1.,0.5,$,$,0.1"),
       10 * (6 + 2 * 3 * (0.5 + (1. - 2) / 2 * std::tan(0.1))), 1e-5},
      // What is beside the legs and the web, of which the inner corner is where the sloped faces meet.
      {"slopes of L", profile("LSHAPE", "6.,4.,1.,$,$,0.09966865249116203"),
       10 * (24 - area_of({{2, 3}, {-1 - 0.3, 3}, {-0.8 / 0.99, -1.9 / 0.99}, {2, -2 - 0.2}})), 1e-5},
      // X = 0.5 + Y / 10 meets Y = 2.5 + (X - 1) / 10.
      {"slopes of T", profile("TSHAPE", "6.,4.,1.,0.5,$,$,$,0.09966865249116203,0.09966865249116203"),
       10 * (24 - 2 * area_of({{2, -3}, {2, 2.6}, {0.74 / 0.99, 2.45 / 0.99}, {0.2, -3}})), 1e-5},
      {"centre line", wall_along(s.polyline({{0, 0}, {5, 0}, {5, 3}})), 10 * (5.5 + 2.5), 1e-5},
      {"centre line with an arc",
       wall_along(
           s.line("IFCINDEXEDPOLYCURVE({},(IFCLINEINDEX((1,2)),IFCARCINDEX((2,3,4)),IFCLINEINDEX((4,5))),.F.)", arc)),
       10 * (20 + bend), 1e-4},
      {"centre line of a line backwards and a trimmed circle",
       wall_along(s.line("IFCCOMPOSITECURVE(({},{},{}),.F.)", segment(s.polyline({{10, 0}, {0, 0}}), ".F."),
                         segment(quarter, ".T."), segment(s.polyline({{12, 2}, {12, 12}}), ".T."))),
       10 * (20 + bend), 1e-4},
      {"centre line that is closed", wall_along(loop(0, 0, 4, 3)), 10 * (5 * 4 - 3 * 2), 1e-5},
      {"composite",
       s.extruded(s.line("IFCCOMPOSITEPROFILEDEF(.AREA.,$,({},{}),$)",
                         s.line("IFCZSHAPEPROFILEDEF(.AREA.,$,{},6.,4.,1.,0.5,$,$)", s.flat_axes()),
                         s.line("IFCRECTANGLEPROFILEDEF(.AREA.,$,{},2.,3.)", s.flat_axes(20, 0))),
                  10),
       90 + 60, 1e-4},
      {"tapered",
       s.line("IFCEXTRUDEDAREASOLIDTAPERED({},{},{},10.,{})", s.rectangle(2, 2), s.origin, z, s.rectangle(1, 1)),
       10. / 3 * (4 + 2 + 1), 1e-4},
      {"rounded", profile("ROUNDEDRECTANGLE", "4.,3.,1."), 10 * (8 + chords), 1e-4},
      {"voids",
       s.extruded(s.line("IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,{},({}))", loop(-3, -3, 3, 3), loop(-1, -1, 1, 1)),
                  10),
       320, 1e-4},
      {"direction that is not of length 1",
       s.line("IFCEXTRUDEDAREASOLID({},{},{},10.)", s.rectangle(4, 3), s.origin, s.direction({0, 3, 4})),
       4 * 3 * 10 * 0.8, 1e-4},
      {"mapped by axes that are not at right angles", s.mapped(map, x + "," + diagonal, {}, "2.,$"), 120 * 8, 1e-3},
      {"mapped by a first axis alone", s.mapped(map, diagonal + ",$", {}, "2.,$"), 120 * 8, 1e-3},
      {"mapped by a second axis alone", s.mapped(map, "$," + x, {}, "2.,$"), 120 * 8, 1e-3},
      {"mapped by the outer axes", s.mapped(map, y + ",$", {}, "2.," + x), 120 * 8, 1e-3},
      {"derived by a first axis alone",
       s.extruded(s.line("IFCDERIVEDPROFILEDEF(.AREA.,$,{},{},$)", s.rectangle(4, 3),
                         s.line("IFCCARTESIANTRANSFORMATIONOPERATOR2D({},$,{},2.)", s.line("IFCDIRECTION((0.,2.))"),
                                s.point(1, 2))),
                  10),
       120 * 4, 1e-3},
      {"windows in one line",
       s.extruded(s.line("IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,{},({},{},{}))", loop(0, 0, 10, 5), loop(1, 1, 2, 2),
                         loop(3, 1, 4, 2), loop(6, 1, 7, 3)),
                  2),
       2 * (50 - 1 - 1 - 2), 1e-4},
      {"half space",
       s.line("IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,{},{})", brick, s.line("IFCHALFSPACESOLID({},.F.)", plane)), 48,
       1e-4},
      {"ring",
       s.line("IFCREVOLVEDAREASOLID({},{},{},6.283185307179586)",
              s.line("IFCRECTANGLEPROFILEDEF(.AREA.,$,{},1.,1.)", s.flat_axes(3, 0)), s.origin,
              s.line("IFCAXIS1PLACEMENT({},{})", s.point({0, 0, 0}), y)),
       6 * chords, 1e-2},
      {"swept disc",
       s.line("IFCSWEPTDISKSOLID({},2.,$,$,$)",
              s.line("IFCPOLYLINE(({},{}))", s.point({0, 0, 0}), s.point({0, 0, 10}))),
       40 * chords, 1e-2},
      {"facets",
       s.line("IFCTRIANGULATEDFACESET({},$,.T.,((1,3,2),(1,2,4),(2,3,4),(1,4,3)),$)",
              s.line("IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(3.,0.,0.),(0.,4.,0.),(0.,0.,5.)))")),
       10, 1e-5},
      {"minus", s.line("IFCBOOLEANRESULT(.DIFFERENCE.,{},{})", brick, s.extruded(s.rectangle(2, 1), 20)), 100, 1e-4},
  };
  for (const Case& one : cases) s.solid(one.name, one.item);
  const Model model = read_ifc(s);
  EXPECT_THAT(model.missing, IsEmpty());
  ASSERT_EQ(model.objects.size(), cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_NEAR(volume_of(model.objects[i]), cases[i].volume, cases[i].error) << cases[i].name;
    EXPECT_TRUE(is_closed(model.objects[i])) << cases[i].name;
  }
}

TEST(IfcShape, ProfilesStandWhereTheyShould) {
  IfcFile step;
  const std::string turned = step.flat_axes(10, 20, step.line("IFCDIRECTION((0.,2.))"));
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
          step.line("IFCCARTESIANTRANSFORMATIONOPERATOR2D($,$,{},2.)", step.point(1, 2)) + ",$)");
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
  IfcFile step;
  step.solid("z", step.line("IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,{},{})",
                            step.extruded(
                                step.line("IFCZSHAPEPROFILEDEF(.AREA.,$,{},6.,4.,1.,0.5,$,$)", step.flat_axes()), 10),
                            step.line("IFCHALFSPACESOLID({},.F.)",
                                      step.line("IFCPLANE({})", step.axes({0, 0, 0}, {0, 1, 0}, {1, 0, 0})))));
  const Model model = read_ifc(step);
  ASSERT_EQ(model.objects.size(), 1u);
  expect_box(model.objects[0], {{-0.5, -3, 0}, {3.5, 0, 10}}, 1e-6);
}

TEST(IfcShape, RadiiThatDoNotFitAreSaid) {
  IfcFile step;
  const std::string solid =
      step.extruded(step.line("IFCISHAPEPROFILEDEF(.AREA.,$,{},4.,6.,0.5,1.,3.,$,$)", step.flat_axes()), 10);
  step.solid("plain", solid);
  step.solid("cut",
             step.line("IFCBOOLEANRESULT(.DIFFERENCE.,{},{})", solid, step.extruded(step.rectangle(0.5, 9), 10)));
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
    IfcFile s("IFC4", scenes::kMetre, 0, degrees);
    const auto angle = [&](double of) { return scenes::step_number(degrees ? of : of * std::numbers::pi / 180); };
    std::vector<double> volumes;
    const std::string square = s.line("IFCRECTANGLEPROFILEDEF(.AREA.,$,{},1.,1.)", s.flat_axes(30, 0));
    const std::string axis = s.line("IFCAXIS1PLACEMENT({},{})", s.point({0, 0, 0}), s.direction({0, 1, 0}));
    for (const double of : {0.5, 3., 5.}) {
      s.solid("turned", s.line("IFCREVOLVEDAREASOLID({},{},{},{})", square, s.origin, axis, angle(of)));
      volumes.push_back(30 * of * std::numbers::pi / 180);
    }
    // Sectors of a circle of radius 100.
    const std::string circle = s.line("IFCCIRCLE({},100.)", s.flat_axes());
    for (const auto& [from, to] : {std::pair(0., 3.), {1., 6.}, {88., 91.}, {300., 420.}}) {
      const auto on = [&](double of) {
        return std::array{100 * std::cos(of * std::numbers::pi / 180), 100 * std::sin(of * std::numbers::pi / 180)};
      };
      const std::string arc =
          s.line("IFCTRIMMEDCURVE({},(IFCPARAMETERVALUE({})),(IFCPARAMETERVALUE({})),.T.,.PARAMETER.)", circle,
                 angle(from), angle(to));
      const std::string back = s.polyline({on(to), {0, 0}, on(from)});
      const auto segment = [&](const std::string& curve) {
        return s.line("IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,{})", curve);
      };
      s.solid("sector", s.extruded(s.line("IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,{})",
                                          s.line("IFCCOMPOSITECURVE(({},{}),.F.)", segment(arc), segment(back))),
                                   1));
      volumes.push_back(5000 * (to - from) * std::numbers::pi / 180);
    }
    s.solid("slopes",
            s.extruded(s.line("IFCUSHAPEPROFILEDEF(.AREA.,$,{},6.,4.,1.,0.5,$,$,{})", s.flat_axes(), angle(5)), 10));
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
  IfcFile s;
  const auto circle = [&](double z) { return s.line("IFCCIRCLE({},2.)", s.axes({0, 0, z})); };
  const auto vertex = [&](const Point& at) { return s.line("IFCVERTEXPOINT({})", s.point(at)); };
  const auto edge = [&](const std::string& from, const std::string& to, const std::string& curve) {
    return s.line("IFCEDGECURVE({},{},{},.T.)", from, to, curve);
  };
  const auto face = [&](const std::vector<std::pair<std::string, bool>>& edges, const std::string& surface) {
    std::vector<std::string> loop;
    for (const auto& [line, forward] : edges)
      loop.push_back(s.line("IFCORIENTEDEDGE(*,*,{},.{}.)", line, forward ? 'T' : 'F'));
    return s.line("IFCADVANCEDFACE(({}),{},.T.)",
                  s.line("IFCFACEOUTERBOUND({},.T.)", s.line("IFCEDGELOOP(({}))", fmt::join(loop, ","))), surface);
  };
  const auto brep = [&](const std::string& faces) {
    return s.line("IFCADVANCEDBREP({})", s.line("IFCCLOSEDSHELL(({}))", faces));
  };
  const std::string low = vertex({2, 0, 0}), high = vertex({2, 0, 5}), other = vertex({-2, 0, 0});
  const std::string bottom = edge(low, low, circle(0)), top = edge(high, high, circle(5));
  const std::string seam =
      edge(low, high, s.line("IFCLINE({},{})", s.point({2, 0, 0}), s.line("IFCVECTOR({},1.)", s.direction({0, 0, 1}))));
  const std::string down = s.line("IFCPLANE({})", s.axes({0, 0, 0}, {0, 0, -1}, {1, 0, 0}));
  s.solid("cylinder", brep(face({{bottom, false}}, down) + "," +
                           face({{top, true}}, s.line("IFCPLANE({})", s.axes({0, 0, 5}))) + "," +
                           face({{bottom, true}, {seam, true}, {top, false}, {seam, false}},
                                s.line("IFCCYLINDRICALSURFACE({},2.)", s.origin))));
  const std::string front = edge(low, other, circle(0)), back = edge(other, low, circle(0));
  s.solid("dome", brep(face({{back, false}, {front, false}}, down) + "," +
                       face({{front, true}, {back, true}}, s.line("IFCSPHERICALSURFACE({},2.)", s.origin))));
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
  IfcFile s;
  std::vector<std::string> points;
  for (const Point& p : {Point{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {0, 0, 5}, {1, 0, 0}, {2, 0, 0}})
    points.push_back(s.point(p));
  for (const char* name : {"closed", "open"}) {
    std::vector<std::string> faces;
    for (const std::vector<std::size_t>& loop :
         {std::vector<std::size_t>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 4, 5, 1}, {0, 3, 2}}) {
      if (name == std::string("open") && loop.back() == 2) continue;
      std::vector<std::string> corners;
      for (const std::size_t i : loop) corners.push_back(points[i]);
      const std::string bound = s.line("IFCPOLYLOOP(({}))", fmt::join(corners, ","));
      faces.push_back(s.line("IFCFACE(({}))", s.line("IFCFACEOUTERBOUND({},.T.)", bound)));
    }
    s.solid(name, s.line("IFCFACETEDBREP({})", s.line("IFCCLOSEDSHELL(({}))", fmt::join(faces, ","))));
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
  IfcFile s;
  const std::string points = s.line(
      "IFCCARTESIANPOINTLIST3D(((1000.,0.,0.),(1010.,0.0001,0.),(1020.,0.,0.),(1030.,0.,0.),(1005.,5000.,0.),"
      "(1005.,0.,5000.)))");
  s.solid("sliver", s.line("IFCTRIANGULATEDFACESET({},$,$,((1,2,4),(1,3,5),(1,4,6)),$)", points));
  const Model model = read_ifc(s);
  ASSERT_EQ(model.objects.size(), 1u);
  EXPECT_FALSE(is_closed(model.objects[0]));
}

TEST(IfcShape, PlacesMayBeLeftOut) {
  IfcFile step;
  step.solid("p", step.line("IFCEXTRUDEDAREASOLID({},$,{},5.)", step.line("IFCRECTANGLEPROFILEDEF(.AREA.,$,$,4.,3.)"),
                            step.direction({0, 0, 1})));
  const Model model = read_ifc(step);
  ASSERT_EQ(model.objects.size(), 1u);
  expect_box(model.objects[0], {{-2, -1.5, 0}, {2, 1.5, 5}}, 1e-6);
  EXPECT_THAT(model.missing, IsEmpty());
}

}  // namespace
}  // namespace impinge::io
