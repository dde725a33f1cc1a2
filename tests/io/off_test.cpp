// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "support.hpp"

namespace impinge::io {
namespace {

using testing::HasSubstr;

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
  const std::string head = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_THAT(error_of(read_off("OFF BINARY\n", "a.off")), HasSubstr("a.off, line 1: binary OFF is not supported"));
  EXPECT_THAT(error_of(read_off("4OFF\n3 1 0\n", "a.off")), HasSubstr("another dimension"));
  EXPECT_THAT(error_of(read_off("nOFF\n3\n3 1 0\n", "a.off")), HasSubstr("another dimension"));
  EXPECT_THAT(error_of(read_off("solid x\n", "a.off")), HasSubstr("line 1: an OFF file begins with 'OFF'"));
  EXPECT_THAT(error_of(read_off("OFF\n-3 1 0\n", "a.off")), HasSubstr("negative"));
  EXPECT_THAT(error_of(read_off("OFF\n3", "a.off")), HasSubstr("the number of faces is missing"));
  EXPECT_THAT(error_of(read_off(head + "3 0 1 3\n", "a.off")), HasSubstr("line 6: face 0 names vertex 3"));
  EXPECT_THAT(error_of(read_off(head + "3 0 1 4294967298\n", "a.off")), HasSubstr("face 0 names vertex 4294967298"));
  EXPECT_THAT(error_of(read_off(head + "3 0 1 -1\n", "a.off")), HasSubstr("line 6: face 0 names vertex -1"));
  EXPECT_THAT(error_of(read_off(head + "3 0 1\n", "a.off")), HasSubstr("the file ends in face 0"));
  EXPECT_THAT(error_of(read_off("OFF\n3 1 0\n0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n", "a.off")),
              HasSubstr("line 4: vertex 1: 'inf'"));
  EXPECT_THAT(error_of(read_off("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "a.off")), HasSubstr("no triangles"));
}

TEST(Off, CountsBeyondTheFileAreRefusedBeforeAllocation) {
  EXPECT_THAT(error_of(read_off("OFF\n9000000000000000000 1 0\n0 0 0\n", "a.off")), HasSubstr("the header promises"));
  EXPECT_THAT(error_of(read_off("OFF\n1 9000000000000000000 0\n0 0 0\n", "a.off")), HasSubstr("the header promises"));
  EXPECT_THAT(error_of(read_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n999999999999 0 1 2\n", "a.off")),
              HasSubstr("face 0 has too many corners"));
  EXPECT_THAT(error_of(read_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", "a.off")),
              HasSubstr("the file ends in face 0"));
}

}  // namespace
}  // namespace impinge::io
