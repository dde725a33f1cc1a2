// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Pictures and archives, drawn and written by impinge and read by libpng and libzip.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "impinge/mesh.hpp"
#include "read_back.hpp"
#include "report/bcf/snapshot.hpp"
#include "report/bcf/zip.hpp"
#include "tests/cli/program.hpp"

namespace impinge::report {
namespace {

TEST(Png, IsReadBackPixelByPixel) {
  std::mt19937 random(7);
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 5}, {640, 480}}) {
    Picture picture{static_cast<std::size_t>(width), static_cast<std::size_t>(height), {}};
    for (int i = 0; i < 3 * width * height; ++i) picture.rgb.push_back(static_cast<unsigned char>(random() & 0xFF));
    const test::Pixels pixels = test::read_png(png_of(picture));
    EXPECT_EQ(pixels.width, picture.width);
    EXPECT_EQ(pixels.height, picture.height);
    EXPECT_EQ(pixels.rgb, picture.rgb);
  }
}

/// A square of side 2 around the origin, at height z.
Placed square(double z, double half = 1) {
  static const std::array<std::array<std::uint32_t, 3>, 2> kTriangles{{{0, 1, 2}, {0, 2, 3}}};
  return {{{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}}, kTriangles};
}

/// From above, so far away that the picture is 4 high.
View from_above() {
  View view;
  view.distance = 2 * std::sqrt(3.0);
  view.eye = {0, 0, view.distance};
  view.right = {1, 0, 0};
  view.up = {0, 1, 0};
  view.forward = {0, 0, -1};
  return view;
}

TEST(Raster, FillsASquareOnceWithoutGaps) {
  const View view = from_above();
  const Lens lens{view, 160, 120};
  const Layer layer = layer_of(square(0), lens);
  // 60 by 60 pixels in the middle, also along the diagonal that both triangles share.
  for (std::size_t y = 0; y < 120; ++y)
    for (std::size_t x = 0; x < 160; ++x)
      EXPECT_EQ(layer.nearness[160 * y + x] > 0, x >= 50 && x < 110 && y >= 30 && y < 90) << x << ' ' << y;
  EXPECT_NEAR(layer.nearness[160 * 60 + 80], 1 / view.distance, 1e-6);
}

TEST(Raster, TheNearerTriangleHidesTheOther) {
  const View view = from_above();
  const Lens lens{view, 160, 120};
  for (const bool nearer_first : {true, false}) {
    Placed both = square(nearer_first ? 1 : 0);
    const Placed other = square(nearer_first ? 0 : 1);
    static const std::array<std::array<std::uint32_t, 3>, 4> kTriangles{{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}};
    both.vertices.insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
    both.triangles = kTriangles;
    EXPECT_NEAR(layer_of(both, lens).nearness[160 * 60 + 80], 1 / (view.distance - 1), 1e-6);
  }
}

TEST(Raster, WhatReachesBehindTheEyeIsCut) {
  const View view = from_above();
  const Lens lens{view, 160, 120};
  // A strip that leads from the middle of the picture past the eye.
  static const std::array<std::array<std::uint32_t, 3>, 1> kTriangle{{{0, 1, 2}}};
  const Placed strip{{{-1, 0.5, 0}, {1, 0.5, 0}, {0, 1, 100}}, kTriangle};
  const Layer layer = layer_of(strip, lens);
  EXPECT_GT(layer.nearness[160 * 40 + 80], 0);
  EXPECT_EQ(layer.nearness[160 * 61 + 80], 0) << "nothing is seen below it";
  const Placed behind{{{-1, 0, 9}, {1, 0, 9}, {0, 1, 9}}, kTriangle};
  const Layer nothing = layer_of(behind, lens);
  EXPECT_TRUE(std::all_of(nothing.nearness.begin(), nothing.nearness.end(), [](float n) { return n == 0; }));
}

TEST(Raster, WhatIsCutOpenIsSeenInto) {
  const View view = from_above();
  const Lens lens{view, 160, 120};
  const HalfSpace below{{0, 0, 1}, 0.5};
  const std::array<Placed, 2> lid_and_floor{square(1, 5), square(-1, 5)};
  const Layer layer = layer_of(lid_and_floor, std::span(&below, 1), lens);
  for (const float nearness : layer.nearness) EXPECT_NEAR(nearness, 1 / (view.distance + 1), 1e-6) << "the floor";
  EXPECT_GT(layer.shading.front(), 0);
  // A slope, z = x, is cut at x = 0.5, where the picture has it at 0.5 distance / (distance - 0.5).
  static const std::array<std::array<std::uint32_t, 3>, 2> kTriangles{{{0, 2, 1}, {0, 3, 2}}};
  const Placed slope{{{-1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, -1}}, kTriangles};
  const Layer cut = layer_of(std::span(&slope, 1), std::span(&below, 1), lens);
  const double end = 80 + 30 * 0.5 * view.distance / (view.distance - 0.5);
  for (std::size_t x = 80; x < 160; ++x)
    EXPECT_EQ(cut.nearness[160 * 60 + x] > 0, static_cast<double>(x) + 0.5 < end) << x;
  EXPECT_EQ(cut.shading[160 * 60 + 85], 0) << "it is seen from its back";
}

TEST(Snapshot, ShowsWhatIsAroundBehindBothParts) {
  Scenery scenery;
  scenery.parts = {square(0, 0.5), square(0, 0.5)};
  const Picture alone = draw(scenery, from_above());
  scenery.around = {square(1, 1)};  // nearer than they are
  const Picture both = draw(scenery, from_above());
  const auto at = [](const Picture& picture, std::size_t x, std::size_t y) {
    const std::size_t first = 3 * (picture.width * y + x);
    return std::array{picture.rgb[first], picture.rgb[first + 1], picture.rgb[first + 2]};
  };
  EXPECT_EQ(at(alone, 320, 240), at(both, 320, 240));
  EXPECT_NE(at(alone, 320 + 100, 240), at(both, 320 + 100, 240));
  EXPECT_EQ(at(alone, 10, 10), at(both, 10, 10));
}

TEST(Raster, LinesAreHiddenBehindParts) {
  const View view = from_above();
  const Lens lens{view, 160, 120};
  const std::array<Layer, 2> layers{layer_of(square(0), lens), layer_of(square(0), lens)};
  const auto mark = [&](double z) {
    const auto marks = marks_of({{{-1.5, 0, z}, {0.5, 0, z}}}, layers, lens, 2);
    EXPECT_EQ(marks[160 * 60 + 100], kNone);
    return marks[160 * 60 + 80];
  };
  EXPECT_EQ(mark(0.5), kVisible);
  EXPECT_EQ(mark(0), kVisible) << "it lies on the part";
  EXPECT_EQ(mark(-0.5), kHidden);
  const auto beside = marks_of({{{-1.5, 0, -0.5}, {0.5, 0, -0.5}}}, layers, lens, 2);
  EXPECT_EQ(beside[160 * 60 + 45], kVisible) << "no part is before it there";
  const auto dots = marks_of({{{0, 0, 0}}}, layers, lens, 4);
  EXPECT_NEAR(static_cast<double>(std::count(dots.begin(), dots.end(), kVisible)), 36 * 3.1416, 10);
}

TEST(Raster, AnyNumbersAreDrawnOrLeftOut) {
  const View view = from_above();
  const Lens lens{view, 16, 12};
  static const std::array<std::array<std::uint32_t, 3>, 1> kTriangle{{{0, 1, 2}}};
  std::mt19937 random(11);
  const std::array<double, 9> numbers{0, 1, -1, 1e-300, -1e-300, 1e90, -1e90, 3.46, 1e-9};
  for (int i = 0; i < 2000; ++i) {
    const auto point = [&] {
      const auto pick = [&] { return numbers[random() % numbers.size()]; };
      return Point{pick(), pick(), pick()};
    };
    const Placed triangle{{point(), point(), point()}, kTriangle};
    const std::array<Layer, 2> layers{layer_of(triangle, lens), layer_of(triangle, lens)};
    EXPECT_EQ(marks_of({triangle.vertices}, layers, lens, 2).size(), 16U * 12U);
  }
}

TEST(Snapshot, LooksFromWhereTheLinesAreSeen) {
  // A lid over the line: it is seen from below alone.
  Scenery scenery;
  scenery.parts = {square(0.1, 5), square(0.1, 5)};
  scenery.lines = {{{-0.2, 0, 0}, {0.2, 0, 0}}};
  Place place;
  for (const Point& p : scenery.lines[0]) place.box.add(p);
  for (const bool y_up : {false, true}) {
    const auto views = views_of(place, {7, 7}, y_up);
    for (const View& view : views) {
      EXPECT_NEAR(length(view.forward), 1, 1e-12);
      EXPECT_NEAR(length(view.up), 1, 1e-12);
      EXPECT_NEAR(dot(view.forward, view.up), 0, 1e-12);
      EXPECT_NEAR(length(cross(view.forward, view.up) - view.right), 0, 1e-12);
      EXPECT_GT(y_up ? view.up.y : view.up.z, 0.5);
    }
    EXPECT_LT(clearest(scenery, views).eye.z, 0) << y_up;
  }
}

TEST(Zip, IsReadBackByAnother) {
  const test::Folder folder;
  std::string large;
  std::mt19937 random(3);
  for (int i = 0; i < 300'000; ++i) large += static_cast<char>(random() % 7);
  std::vector<Member> members;
  for (const bool packed : {true, false})
    for (const std::string& bytes : {std::string(), std::string("x"), large})
      members.push_back({(packed ? "a/" : "b/") + std::to_string(bytes.size()), bytes, packed});
  const auto write = [&](const std::string& name) {
    const Result<Target> target = Target::check((folder.path() / name).string(), kBcf);
    ASSERT_TRUE(target);
    Result<Written> written = target->write([&](Sink& sink) { return write_zip(sink, members, {}); });
    ASSERT_TRUE(written);
    EXPECT_TRUE(written->put());
  };
  write("one.zip");
  const std::string archive = folder.read("one.zip");
  EXPECT_LT(archive.size(), 2 * large.size());
  const std::vector<test::Member> found = test::unzip(archive);
  ASSERT_EQ(found.size(), members.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].name, members[i].name);
    EXPECT_EQ(found[i].bytes, members[i].bytes);
    EXPECT_EQ(found[i].date, "1980-01-01 00:00");
  }
  write("two.zip");
  EXPECT_EQ(folder.read("two.zip"), archive);
}

TEST(Zip, StopsWhenAsked) {
  const Result<Target> target = Target::check("/dev/null", kBcf);
  ASSERT_TRUE(target);
  std::stop_source stopped;
  stopped.request_stop();
  const std::vector<Member> members{{"a", "bytes"}};
  const auto written = target->write([&](Sink& sink) { return write_zip(sink, members, stopped.get_token()); });
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Code::cancelled);
}

}  // namespace
}  // namespace impinge::report
