// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <limits>

#include "support.hpp"

namespace impinge::io {
namespace {

using testing::HasSubstr;

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
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_THAT(model.warnings[0], HasSubstr("1 of 1 object; worst is 'file', of size 4 with a spacing of 0.125"));
  // At 1 they are 2^-23 apart: a part of size 1/8 is at the border's good side, one of 1/16 is not: 2^-23 / 2^-4
  // = 1.9e-6.
  EXPECT_TRUE(model_of(read_stl(binary_stl("", {{1, 0, 0, 1.125f, 0, 0, 1, 0.125f, 0}}), "file")).warnings.empty());
  EXPECT_EQ(model_of(read_stl(binary_stl("", {{1, 0, 0, 1.0625f, 0, 0, 1, 0.0625f, 0}}), "file")).warnings.size(), 1u);
}

TEST(Stl, BytesAfterTheLastTriangleAreReported) {
  const Model model = model_of(read_stl(binary_stl("", {{0, 0, 0, 1, 0, 0, 0, 1, 0}}) + "tail", "file"));
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_THAT(model.warnings[0], HasSubstr("4 bytes"));
}

TEST(Stl, ErrorsNameThePlace) {
  std::string cut = binary_stl("", {{0, 0, 0, 1, 0, 0, 0, 1, 0}});
  cut.pop_back();
  EXPECT_THAT(error_of(read_stl(cut, "a.stl")),
              HasSubstr("a.stl, byte 80: the header promises 1 triangles, but the file holds only 0"));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(error_of(read_stl(binary_stl("", {{0, 0, 0, 1, 0, 0, 0, nan, 0}}), "a.stl")),
              HasSubstr("byte 124: triangle 0"));
  EXPECT_THAT(error_of(read_stl("", "a.stl")), HasSubstr("neither"));
  EXPECT_THAT(error_of(read_stl("soli", "a.stl")), HasSubstr("neither"));
  EXPECT_THAT(error_of(read_stl("solid a\nendsolid a\n", "a.stl")), HasSubstr("no triangles"));
  EXPECT_THAT(error_of(read_stl("solid a\n" + facet("0 0 0", "1 0 inf", "0 1 0"), "a.stl")),
              HasSubstr("line 5: 'inf' is not a finite"));
  EXPECT_THAT(error_of(read_stl("solid a\n" + facet("0 0 0", "1 0 0", "0 1 0"), "a.stl")),
              HasSubstr("'endsolid' is missing"));
  EXPECT_THAT(error_of(read_stl("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop", "a.stl")),
              HasSubstr("line 5: 'endloop' stands where 'vertex' should"));
  EXPECT_THAT(error_of(read_stl("solid a\nendsolid\nrubbish", "a.stl")),
              HasSubstr("line 3: 'rubbish' stands where 'solid' should"));
}

}  // namespace
}  // namespace impinge::io
