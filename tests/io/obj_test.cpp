// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "support.hpp"

namespace impinge::io {
namespace {

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
    for (const std::string_view line : {"v 0 0 0", "v 1 \\", "0 \\", "0", "v 0 1 0", "f 1 2\\", " 3"}) {
      text += std::string(line) + std::string(end);
    }
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
  const std::string four(kFour);
  EXPECT_THAT(error_of(read_obj(four + "f 1 2 3\nf 1 9 2\nf 1 2 7\n", "a.obj")),
              HasSubstr("a.obj, line 6: the face names vertex 9"));
  EXPECT_THAT(error_of(read_obj(four + "f 1 2 0\n", "a.obj")), HasSubstr("line 5: the face names vertex 0"));
  EXPECT_THAT(error_of(read_obj(four + "f 1 2 -5\n", "a.obj")), HasSubstr("line 5: the face names vertex -5"));
  EXPECT_THAT(error_of(read_obj(four + "f 1 2 3.5\n", "a.obj")), HasSubstr("line 5: the face's corner '3.5'"));
  EXPECT_THAT(error_of(read_obj(four + "f 1 2 3/x\n", "a.obj")), HasSubstr("line 5"));
  EXPECT_THAT(error_of(read_obj(four + "f 1 2 99999999999999999999\n", "a.obj")), HasSubstr("line 5"));
  EXPECT_THAT(error_of(read_obj("v 1 2\n", "a.obj")), HasSubstr("line 1: a vertex needs three coordinates"));
  EXPECT_THAT(error_of(read_obj("v 1 2 \\\n\nv nan 0 0\n", "a.obj")),
              HasSubstr("line 1: a vertex needs three coordinates"));
  EXPECT_THAT(error_of(read_obj("\nv 0 nan 0\n", "a.obj")), HasSubstr("line 2: 'nan' is not a finite number"));
  EXPECT_THAT(error_of(read_obj("v 0 0 -inf\n", "a.obj")), HasSubstr("'-inf' is not a finite number"));
  EXPECT_THAT(error_of(read_obj("v 0 0 1e400\n", "a.obj")), HasSubstr("'1e400' is outside the range of a double"));
  EXPECT_THAT(error_of(read_obj("v 0 0 1,5\n", "a.obj")), HasSubstr("'1,5' is not a number"));
  EXPECT_THAT(error_of(read_obj("\xFF\xFEv", "a.obj")), HasSubstr("UTF-16"));
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

}  // namespace
}  // namespace impinge::io
