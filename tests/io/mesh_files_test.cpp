// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "support.hpp"

namespace impinge::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Obj, ReadsEveryFormOfACornerAndNegativeIndices) {
  const Model model =
      model_of(read_obj("# a comment\n"
                        "v 0 0 0 1\n"         // a weight
                        "v 1 0 0 .5 .5 .5\n"  // a colour
                        "vt 0 0\nvn 0 0 1\n"
                        "v +1.5 -2e-1 3 # behind\n"
                        "v 0 1 0\n"
                        "f 1 2 3\nf 1/1 2/1 3/1\nf 2//1 3//1 4//1\nf 1/1/1 3/1/1 4/1/1\nf -4 -2 -1\n",
                        "part"));
  ASSERT_EQ(model.objects.size(), 1u);
  EXPECT_EQ(model.objects[0].name, "part");
  EXPECT_EQ(points_of(model.objects[0]), (Points{{0, 0, 0}, {1, 0, 0}, {1.5, -0.2, 3}, {0, 1, 0}}));
  EXPECT_EQ(triangles_of(model.objects[0]), (Triangles{{0, 1, 2}, {0, 1, 2}, {1, 2, 3}, {0, 2, 3}, {0, 2, 3}}));
  EXPECT_TRUE(model.warnings.empty());
}

TEST(Obj, JoinsContinuedLinesAndTakesEveryLineEnd) {
  for (const std::string_view end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const std::string_view line : {"v 0 0 0", "v 1 \\", "0 \\", "0", "v 0 1 0", "f 1 2\\", " 3"})
      text += std::string(line) + std::string(end);
    const Model model = model_of(read_obj(text, "part"));
    ASSERT_EQ(model.objects.size(), 1u);
    EXPECT_EQ(points_of(model.objects[0]), (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(triangles_of(model.objects[0]), (Triangles{{0, 1, 2}}));
  }
}

constexpr std::string_view kFour = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

TEST(Obj, ObjectsShareTheFilesVerticesAndKeepThoseTheyUse) {
  const Model model = model_of(read_obj(std::string(kFour) + "o lower # not a comment\ng ignored\nf 1 2 3\n"
                                                             "o empty\n"
                                                             "o upper\nf 2 4 3\ng also ignored\nf 4 3 2\n"
                                                             "o upper\nf 1 2 4\n",
                                        "part"));
  EXPECT_EQ(names_of(model), (std::vector<std::string>{"lower # not a comment", "upper", "upper (2)"}));
  EXPECT_EQ(points_of(model.objects[1]), (Points{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(triangles_of(model.objects[1]), (Triangles{{0, 2, 1}, {2, 1, 0}}));
  EXPECT_EQ(points_of(model.objects[2]), (Points{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}));
}

TEST(Obj, GroupsSplitAFileWithoutObjectsAndGoOnUnderTheirName) {
  const Model model =
      model_of(read_obj(std::string(kFour) + "f 1 2 3\ng a b\nf 1 2 4\ng other\nf 1 3 4\ng a b\nf 2 3 4\n", "part"));
  EXPECT_EQ(names_of(model), (std::vector<std::string>{"part", "a b", "other"}));
  EXPECT_EQ(triangles_of(model.objects[1]), (Triangles{{0, 1, 3}, {1, 2, 3}}));
}

TEST(Obj, IgnoresPointsLinesCurvesAndFacesOfTwoCorners) {
  const Model model =
      model_of(read_obj(std::string(kFour) + "p 1 2\nl 1 2 3\ncurv 0 1 1 2\nf 1 2\nf 4\nf 3 2 1\n", "part"));
  ASSERT_EQ(model.objects.size(), 1u);
  EXPECT_EQ(triangles_of(model.objects[0]), (Triangles{{2, 1, 0}}));
}

TEST(Obj, FacesMayNameVerticesThatFollow) {
  const Model model = model_of(read_obj("f 1 2 3\n" + std::string(kFour), "part"));
  EXPECT_EQ(triangles_of(model.objects.at(0)), (Triangles{{0, 1, 2}}));
}

TEST(Obj, ErrorsNameTheLine) {
  const auto error = [](std::string_view text) { return error_of(read_obj(text, "a.obj")); };
  const std::string four(kFour);
  EXPECT_THAT(error(four + "f 1 2 3\nf 1 9 2\nf 1 2 7\n"), HasSubstr("a.obj, line 6: the face names vertex 9"));
  EXPECT_THAT(error(four + "f 1 2 0\n"), HasSubstr("line 5: the face names vertex 0"));
  EXPECT_THAT(error(four + "f 1 2 -5\n"), HasSubstr("line 5: the face names vertex -5"));
  EXPECT_THAT(error(four + "f 1 2 3.5\n"), HasSubstr("line 5: the face's corner '3.5'"));
  EXPECT_THAT(error(four + "f 1 2 3/x\n"), HasSubstr("line 5"));
  EXPECT_THAT(error(four + "f 1 2 99999999999999999999\n"), HasSubstr("line 5"));
  EXPECT_THAT(error("v 1 2\n"), HasSubstr("line 1: a vertex needs three coordinates"));
  EXPECT_THAT(error("v 1 2 \\\n\nv nan 0 0\n"), HasSubstr("line 1: a vertex needs three coordinates"));
  EXPECT_THAT(error("\nv 0 nan 0\n"), HasSubstr("line 2: 'nan' is not a finite number"));
  EXPECT_THAT(error("v 0 0 -inf\n"), HasSubstr("'-inf' is not a finite number"));
  EXPECT_THAT(error("v 0 0 1e400\n"), HasSubstr("'1e400' is outside the range of a double"));
  EXPECT_THAT(error("v 0 0 1,5\n"), HasSubstr("'1,5' is not a number"));
  EXPECT_THAT(error("\xFF\xFEv"), HasSubstr("UTF-16"));
}

TEST(Obj, AFileWithoutTrianglesIsAnError) {
  for (const std::string_view text :
       {std::string_view(""), std::string_view("# nothing\n"), kFour, std::string_view("garbage\x01\x02\nmore")}) {
    EXPECT_THAT(error_of(read_obj(text, "a.obj")), HasSubstr("a.obj: the file holds no triangles"));
  }
}

TEST(Obj, NumbersAreTheNearestDoubles) {
  const Model model =
      model_of(read_obj("v 0.1 1e-400 4.9e-324\nv 3e-324 -1e-400 1e308\nv 0.30000000000000004 +2 1E2\nf 1 2 3\n", "a"));
  const Points points = points_of(model.objects.at(0));
  EXPECT_EQ(points, (Points{{0.1, 0, 0x1p-1074}, {0x1p-1074, 0, 1e308}, {0.1 + 0.2, 2, 100}}));
}

const Points kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}};

TEST(Off, ReadsVerticesAndPolygonsWithColours) {
  for (const std::string_view head :
       {"OFF\n4 3 0\n", "OFF 4 3 0\n", "# first\nOFF # kind\n\n4 3\n", "4 3 5\n", "\xEF\xBB\xBFOFF\n4 3 0\n"}) {
    const Model model = model_of(read_off(std::string(head) + "0 0 0\n1 0 0 # corner\n\n1 1 0\n0 1 0.5\n"
                                                              "4 0 1 2 3 255 0 0\n"
                                                              "3 0 2 1\n2 0 1\n",
                                          "sheet"));
    ASSERT_EQ(model.objects.size(), 1u);
    EXPECT_EQ(model.objects[0].name, "sheet");
    EXPECT_EQ(points_of(model.objects[0]), kSquare);
    EXPECT_EQ(triangles_of(model.objects[0]), (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 2, 1}}));
  }
}

TEST(Off, PassesOverNormalsColoursAndTextureCoordinates) {
  for (const std::string_view keyword : {"COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF"}) {
    const Model model =
        model_of(read_off(std::string(keyword) + "\r\n4 1 0\r\n0 0 0 9 9 9 9\r\n1 0 0 9 9 9 9\r\n1 1 0 9 9 9 9\r\n"
                                                 "0 1 0.5 9 9 9 9\r\n3 3 2 1 0.5 0.5 0.5 1\r\n",
                          "sheet"));
    EXPECT_EQ(points_of(model.objects.at(0)), kSquare);
    EXPECT_EQ(triangles_of(model.objects[0]), (Triangles{{3, 2, 1}}));
  }
}

TEST(Off, ErrorsNameTheLine) {
  const auto error = [](std::string_view text) { return error_of(read_off(text, "a.off")); };
  const std::string head = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_THAT(error("OFF BINARY\n"), HasSubstr("a.off, line 1: binary OFF is not supported"));
  EXPECT_THAT(error("4OFF\n3 1 0\n"), HasSubstr("another dimension"));
  EXPECT_THAT(error("nOFF\n3\n3 1 0\n"), HasSubstr("another dimension"));
  EXPECT_THAT(error("solid x\n"), HasSubstr("line 1: an OFF file begins with 'OFF'"));
  EXPECT_THAT(error("OFF\n-3 1 0\n"), HasSubstr("negative"));
  EXPECT_THAT(error("OFF\n3"), HasSubstr("the number of faces is missing"));
  EXPECT_THAT(error(head + "3 0 1 3\n"), HasSubstr("line 6: face 0 names vertex 3"));
  EXPECT_THAT(error(head + "3 0 1 4294967298\n"), HasSubstr("face 0 names vertex 4294967298"));
  EXPECT_THAT(error(head + "3 0 1 -1\n"), HasSubstr("line 6: face 0 names vertex -1"));
  EXPECT_THAT(error(head + "3 0 1\n"), HasSubstr("the file ends in face 0"));
  EXPECT_THAT(error("OFF\n3 1 0\n0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n"), HasSubstr("line 4: vertex 1: 'inf'"));
  EXPECT_THAT(error("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"), HasSubstr("no triangles"));
}

TEST(Off, CountsBeyondTheFileAreRefusedBeforeAllocation) {
  EXPECT_THAT(error_of(read_off("OFF\n9000000000000000000 1 0\n0 0 0\n", "a.off")), HasSubstr("the header promises"));
  EXPECT_THAT(error_of(read_off("OFF\n1 9000000000000000000 0\n0 0 0\n", "a.off")), HasSubstr("the header promises"));
  EXPECT_THAT(error_of(read_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n999999999999 0 1 2\n", "a.off")),
              HasSubstr("face 0 has too many corners"));
  EXPECT_THAT(error_of(read_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", "a.off")),
              HasSubstr("the file ends in face 0"));
}

TEST(Ply, TextWithAnyOrderOfElementsAndProperties) {
  const Model model = model_of(read_ply(
      "ply\nformat ascii 1.0\ncomment made by hand\nobj_info none\n"
      "element face 2\n"
      "property uchar red\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
      "element empty 99999999999\n"
      "element odd 2\nproperty list int short stuff\nproperty double other\n"
      "element vertex 4\n"
      "property uchar flag\nproperty double z\nproperty float x\nproperty list uchar int extra\nproperty int y\n"
      "end_header\n"
      "255 4 0 1 2 3 2 0.5 0.5\n0 3 2 1 0 0\n"
      "3 7 8 9 1.5\n0 nan\n"
      "1 0.5 0 0 0\n1 0.25 0.1 2 7 7 0\n1 0 1 0 1\n1 0 0 1 4 +1\n",
      "sheet"));
  ASSERT_EQ(model.objects.size(), 1u);
  EXPECT_EQ(model.objects[0].name, "sheet");
  EXPECT_EQ(points_of(model.objects[0]), (Points{{0, 0, 0.5}, {0.1, 0, 0.25}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(triangles_of(model.objects[0]), (Triangles{{0, 1, 2}, {0, 2, 3}, {2, 1, 0}}));
}

/// A triangle whose rows use every scalar type; x is a float, y a double, z a signed byte.
std::string binary_ply(bool big, std::string_view end) {
  std::string out;
  for (const std::string& line :
       {std::string("ply"), std::string(big ? "format binary_big_endian 1.0" : "format binary_little_endian 1.0"),
        std::string("element skipped 2"), std::string("property list ushort uint32 a"),
        std::string("property uint16 b"), std::string("element vertex 3"), std::string("property float32 x"),
        std::string("property int16 ignored"), std::string("property float64 y"), std::string("property char z"),
        std::string("element face 2"), std::string("property list uint8 uint32 vertex_index"),
        std::string("property short s"), std::string("end_header")}) {
    out += line + std::string(end);
  }
  append_bytes(out, std::uint16_t{2}, big);
  append_bytes(out, std::uint32_t{5}, big);
  append_bytes(out, std::uint32_t{6}, big);
  append_bytes(out, std::uint16_t{1}, big);
  append_bytes(out, std::uint16_t{0}, big);
  append_bytes(out, std::uint16_t{1}, big);
  const std::array<Point, 3> points{{{double{0.1f}, 0.1, -128}, {1, -2.5, 127}, {-3, 4e-300, 0}}};
  for (const Point& p : points) {
    append_bytes(out, static_cast<float>(p.x), big);
    append_bytes(out, std::int16_t{-1}, big);
    append_bytes(out, p.y, big);
    append_bytes(out, static_cast<std::int8_t>(p.z), big);
  }
  for (const auto& face : std::vector<std::vector<std::uint32_t>>{{2, 1, 0}, {0, 1}}) {
    append_bytes(out, static_cast<std::uint8_t>(face.size()), big);
    for (const std::uint32_t corner : face) append_bytes(out, corner, big);
    append_bytes(out, std::int16_t{-2}, big);
  }
  return out;
}

TEST(Ply, BinaryOfBothByteOrdersAndEveryLineEnd) {
  for (const bool big : {false, true})
    for (const std::string_view end : {"\n", "\r\n", "\r"}) {
      const Model model = model_of(read_ply(binary_ply(big, end), "part"));
      ASSERT_EQ(model.objects.size(), 1u);
      EXPECT_EQ(points_of(model.objects[0]), (Points{{double{0.1f}, 0.1, -128}, {1, -2.5, 127}, {-3, 4e-300, 0}}));
      EXPECT_EQ(triangles_of(model.objects[0]), (Triangles{{2, 1, 0}}));
    }
}

constexpr std::string_view kVertices =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n";
constexpr std::string_view kRows = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";

std::string text_ply(std::string_view element, std::string_view rows) {
  return std::string(kVertices) + std::string(element) + "end_header\n" + std::string(kRows) + std::string(rows);
}

TEST(Ply, TriangleStripsTurnEverySecondTriangle) {
  const Model model = model_of(read_ply(
      text_ply("element tristrips 1\nproperty list int int vertex_indices\n", "9 0 1 2 3 -1 3 2 1 -1\n"), "strip"));
  EXPECT_EQ(triangles_of(model.objects.at(0)), (Triangles{{0, 1, 2}, {2, 1, 3}, {3, 2, 1}}));
}

TEST(Ply, UnknownHeaderLinesArePassedOverWithAWarning) {
  const Model model = model_of(
      read_ply("ply\nformat ascii 1.0\nCreated by a program\n" +
                   text_ply("element face 1\nproperty list uchar int vertex_indices\n", "3 0 1 2\n").substr(21),
               "a.ply"));
  EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("Line 3 of the header of a.ply begins with 'Created'")));
}

TEST(Ply, WarnsWhereFloatsAreTooCoarseForThePart) {
  std::string text = text_ply("element face 1\nproperty list uchar int vertex_indices\n", "3 0 1 2\n");
  text.replace(text.find("0 0 0\n"), 5, "1e9 0 0");
  text.replace(text.find("1 0 0\n"), 5, "1e9 1 0");
  text.replace(text.find("0 1 0\n"), 5, "1e9 0 1");
  text.replace(text.find("1 1 0\n"), 5, "1e9 1 1");
  EXPECT_TRUE(model_of(read_ply(text, "part")).warnings.empty()) << "doubles";
  text.replace(text.find("property double z"), 17, "property float z");
  EXPECT_EQ(model_of(read_ply(text, "part")).warnings.size(), 1u) << "floats";
}

TEST(Ply, ErrorsNameThePlace) {
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  const auto error = [](const std::string& text) { return error_of(read_ply(text, "a.ply")); };
  EXPECT_THAT(error("off\n"), HasSubstr("a.ply, line 1: a PLY file begins with a line 'ply'"));
  EXPECT_THAT(error("ply\nformat binary 1.0\nend_header\n"), HasSubstr("line 2: the format 'binary'"));
  EXPECT_THAT(error("ply\nend_header\n"), HasSubstr("no 'format' line"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nelement vertex 3\n"), HasSubstr("no 'end_header' line"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nproperty int x\n"), HasSubstr("line 3: a property stands before"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nelement vertex -3\n"),
              HasSubstr("line 3: element 'vertex' has no proper count"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nelement vertex 3\nproperty half x\n"), HasSubstr("of type 'half'"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nelement face 3\nproperty list float int vertex_index\n"),
              HasSubstr("counted by 'float'"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nend_header\n"),
              HasSubstr("lacks one of the properties x, y and z"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nend_header\n"), HasSubstr("no element 'vertex'"));
  EXPECT_THAT(error(text_ply(faces, "3 0 1 4\n")),
              HasSubstr("a.ply, line 14: element 'face', row 0: it names vertex 4"));
  EXPECT_THAT(error(text_ply(faces, "3 0 1 -1\n")), HasSubstr("it names vertex -1"));
  EXPECT_THAT(error(text_ply(faces, "3 0 1 1.5\n")), HasSubstr("'1.5' is not a whole number"));
  EXPECT_THAT(error(text_ply(faces, "-3 0 1 2\n")), HasSubstr("negative length"));
  EXPECT_THAT(error(text_ply(faces, "3 0 1\n")), HasSubstr("it is cut short"));
  EXPECT_THAT(error(text_ply("element face 1\nproperty list uchar float vertex_indices\n", "3 0 1 2\n")),
              HasSubstr("no whole numbers"));
  EXPECT_THAT(
      error(text_ply("element face 9000000000000000000\nproperty list uchar int vertex_indices\n", "3 0 1 2\n")),
      HasSubstr("the header promises 9000000000000000000 rows"));
  EXPECT_THAT(error(text_ply(faces, "0\n")), HasSubstr("no triangles"));
  std::string binary = binary_ply(false, "\n");
  const std::size_t body = binary.find("end_header\n") + 11;
  binary.replace(body + 16 + 15, 4, std::string("\0\0\x80\x7F", 4));  // the second vertex's x, after two skipped rows
  EXPECT_THAT(error(binary),
              HasSubstr("byte " + std::to_string(body + 31) + ": element 'vertex', row 1: the number is not finite"));
}

std::string facet(std::string_view a, std::string_view b, std::string_view c) {
  std::string out = "facet normal nan nan nan\n outer loop\n";
  for (const std::string_view vertex : {a, b, c}) out += "  vertex " + std::string(vertex) + "\n";
  return out + " endloop\nendfacet\n";
}

/// Binary STL of the triangles' 9 floats each.
std::string binary_stl(std::string header, const std::vector<std::array<float, 9>>& triangles) {
  header.resize(80);
  append_bytes(header, static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    header.append(12, '\xFF');  // a normal of NaNs
    for (const float x : triangle) append_bytes(header, x);
    append_bytes(header, std::uint16_t{7});
  }
  return header;
}

TEST(Stl, EachSolidOfATextIsAnObjectAndEqualVerticesAreOne) {
  const Model model = model_of(
      read_stl("solid left part\n" + facet("0 0 0", "1 0 0", "0 1 0") + facet("1 0 0", "-0 0 -0.0", "0 -1 0") +
                   "endsolid left part\nsolid\nendsolid\nSOLID left part\n" + facet("0 0 0", "0.1 0 0", "0 1e-3 0") +
                   "endsolid\nsolid\n" + facet("0 0 0", "0 0 0", "5 0 0") + "endsolid\n",
               "file"));
  EXPECT_EQ(names_of(model), (std::vector<std::string>{"left part", "left part (2)", "file"}));
  EXPECT_EQ(points_of(model.objects[0]), (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}));
  EXPECT_EQ(triangles_of(model.objects[0]), (Triangles{{0, 1, 2}, {1, 0, 3}}));
  EXPECT_EQ(points_of(model.objects[1]), (Points{{0, 0, 0}, {0.1, 0, 0}, {0, 0.001, 0}}));
  EXPECT_EQ(triangles_of(model.objects[2]), (Triangles{{0, 0, 1}})) << "degenerate triangles are kept";
}

TEST(Stl, BinaryIsToldByItsSizeEvenIfItBeginsWithSolid) {
  for (const std::string_view header : {"", "solid from a program", "COLOR=abcd"}) {
    const Model model = model_of(read_stl(
        binary_stl(std::string(header), {{0, 0, 0, 0.1f, 0, 0, 0, 1, 0}, {-0.0f, 0, 0, 0, 1, 0, 2, 2, 2}}), "file"));
    ASSERT_EQ(model.objects.size(), 1u);
    EXPECT_EQ(model.objects[0].name, "file");
    EXPECT_EQ(points_of(model.objects[0]), (Points{{0, 0, 0}, {double{0.1f}, 0, 0}, {0, 1, 0}, {2, 2, 2}}));
    EXPECT_EQ(triangles_of(model.objects[0]), (Triangles{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_TRUE(model.warnings.empty());
  }
}

TEST(Stl, BinaryWarnsWhereFloatsAreTooCoarseForThePart) {
  // Floats at 2^20 are 2^-3 apart; the part is of size 4.
  const Model model = model_of(read_stl(binary_stl("", {{0x1p20f, 0, 0, 0x1p20f + 4, 0, 0, 0x1p20f, 1, 0}}), "file"));
  EXPECT_THAT(model.warnings,
              ElementsAre(HasSubstr("1 of 1 object; worst is 'file', of size 4 with a spacing of 0.125")));
  // At 1 they are 2^-23 apart: a part of size 1/8 is at the border's good side, one of 1/16 is not: 2^-23 / 2^-4
  // = 1.9e-6.
  EXPECT_TRUE(model_of(read_stl(binary_stl("", {{1, 0, 0, 1.125f, 0, 0, 1, 0.125f, 0}}), "file")).warnings.empty());
  EXPECT_EQ(model_of(read_stl(binary_stl("", {{1, 0, 0, 1.0625f, 0, 0, 1, 0.0625f, 0}}), "file")).warnings.size(), 1u);
}

TEST(Stl, BytesAfterTheLastTriangleAreReported) {
  const Model model = model_of(read_stl(binary_stl("", {{0, 0, 0, 1, 0, 0, 0, 1, 0}}) + "tail", "file"));
  EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("4 bytes")));
}

TEST(Stl, PointsMadeToCollideTakeNoQuadraticTime) {
  // All points fall on one another under x -> (h ^ x) * k, h ^ h >> 29, which can be undone: z = h(x, y).
  constexpr std::uint64_t kFactor = 0x9E3779B97F4A7C15;
  const unsigned seed = 5;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::vector<std::string> points;
  while (points.size() < 60'000) {
    const std::array<double, 2> xy{static_cast<double>(random()) * 0x1p-32, static_cast<double>(random()) * 0x1p-32};
    std::uint64_t hash = 0;
    for (const double x : xy) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * kFactor;
      hash ^= hash >> 29;
    }
    const auto z = std::bit_cast<double>(hash);
    if (!(std::abs(z) < 1e100 && std::abs(z) > 1e-100)) continue;
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "%.17g %.17g %.17g", xy[0], xy[1], z);
    points.emplace_back(text.data());
  }
  std::string file = "solid\n";
  for (std::size_t i = 0; i < points.size(); i += 3) file += facet(points[i], points[i + 1], points[i + 2]);
  const auto start = std::chrono::steady_clock::now();
  const Model model = model_of(read_stl(file + "endsolid\n", "file"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(8));
  EXPECT_EQ(points_of(model.objects.at(0)).size(), points.size());
  EXPECT_EQ(triangles_of(model.objects[0]).back(), (std::array<std::uint32_t, 3>{59'997, 59'998, 59'999}));
}

TEST(Stl, ErrorsNameThePlace) {
  const auto error = [](std::string_view text) { return error_of(read_stl(text, "a.stl")); };
  std::string cut = binary_stl("", {{0, 0, 0, 1, 0, 0, 0, 1, 0}});
  cut.pop_back();
  EXPECT_THAT(error(cut), HasSubstr("a.stl, byte 80: the header promises 1 triangles, but the file holds only 0"));
  // Many programs have few bits at byte 80, and what follows are floats of some kind.
  EXPECT_THAT(error("\x7f"
                    "ELF" +
                    std::string(300, '\0')),
              HasSubstr("byte 80: the header promises 0 triangles, but there is room for 4"));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(error(binary_stl("", {{0, 0, 0, 1, 0, 0, 0, nan, 0}})), HasSubstr("byte 124: triangle 0"));
  EXPECT_THAT(error(""), HasSubstr("neither"));
  EXPECT_THAT(error("soli"), HasSubstr("neither"));
  EXPECT_THAT(error("solid a\nendsolid a\n"), HasSubstr("no triangles"));
  EXPECT_THAT(error("solid a\n" + facet("0 0 0", "1 0 inf", "0 1 0")), HasSubstr("line 5: 'inf' is not a finite"));
  EXPECT_THAT(error("solid a\n" + facet("0 0 0", "1 0 0", "0 1 0")), HasSubstr("'endsolid' is missing"));
  EXPECT_THAT(error("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop"),
              HasSubstr("line 5: 'endloop' stands where 'vertex' should"));
  EXPECT_THAT(error("solid a\nendsolid\nrubbish"), HasSubstr("line 3: 'rubbish' stands where 'solid' should"));
}

}  // namespace
}  // namespace impinge::io
