// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

#include "support.hpp"

namespace impinge::io {
namespace {

using testing::HasSubstr;

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
  for (const bool big : {false, true}) {
    for (const std::string_view end : {"\n", "\r\n", "\r"}) {
      const Model model = model_of(read_ply(binary_ply(big, end), "part"));
      ASSERT_EQ(model.objects.size(), 1u);
      EXPECT_EQ(points_of(model.objects[0]), (Points{{double{0.1f}, 0.1, -128}, {1, -2.5, 127}, {-3, 4e-300, 0}}));
      EXPECT_EQ(triangles_of(model.objects[0]), (Triangles{{2, 1, 0}}));
    }
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
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_THAT(model.warnings[0], HasSubstr("Line 3 of the header of a.ply begins with 'Created'"));
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

}  // namespace
}  // namespace impinge::io
