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
  std::string cut = binary_stl("", {{0, 0, 0, 1, 0, 0, 0, 1, 0}});
  cut.pop_back();
  EXPECT_THAT(error_of(read_stl(cut, "a.stl")),
              HasSubstr("a.stl, byte 80: the header promises 1 triangles, but the file holds only 0"));
  // Many programs have few bits at byte 80, and what follows are floats of some kind.
  EXPECT_THAT(error_of(read_stl("\x7f"
                                "ELF" +
                                    std::string(300, '\0'),
                                "a.stl")),
              HasSubstr("byte 80: the header promises 0 triangles, but there is room for 4"));
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
