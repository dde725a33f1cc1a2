// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// The page that `clash --html` and `view` write: its three blocks, whatever names are in them. What the page's program
// does with them is tested beside that program.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>

#include "models.hpp"
#include "read_back.hpp"
#include "scenes/shapes.hpp"
#include "tests/cli/meshes.hpp"
#include "tests/cli/program.hpp"
#include "tests/io/animated_gltf.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;

std::string unpacked(const std::string& base64, std::size_t size) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : base64.substr(0, base64.find('='))) {
    EXPECT_NE(kDigits.find(c), std::string_view::npos);
    bits = bits << 6U | static_cast<unsigned>(kDigits.find(c));
    held += 6;
    if (held >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 0xFFU);
  }
  std::string out(size, '\0');
  uLongf length = size;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(out.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
                       bytes.size()),
            Z_OK);
  EXPECT_EQ(length, size);
  return out;
}

/// A page taken apart.
struct Page {
  json report, scene;
  std::string before, after;
  std::vector<std::vector<float>> xyz;
  std::vector<std::vector<std::uint32_t>> triangles;

  explicit Page(std::string text) {
    before = text.substr(0, text.find("<script"));
    report = json::parse(block(text, "<script type=\"application/json\" id=\"report\">\n"));
    scene = json::parse(block(text, "<script type=\"application/json\" id=\"scene\">\n"));
    const std::string packed = block(text, "<script type=\"text/plain\" id=\"geometry\">\n");
    after = text;
    std::size_t size = 0;
    for (const json& mesh : scene.at("meshes"))
      size += 12 * (mesh.at("vertices").get<std::size_t>() + mesh.at("triangles").get<std::size_t>());
    const std::string bytes = unpacked(packed.substr(0, packed.find('\n')), size);
    std::size_t at = 0;
    for (const json& mesh : scene.at("meshes")) {
      const auto take = [&](auto& values, std::size_t count) {
        values.resize(count);
        std::memcpy(values.data(), bytes.data() + at, 4 * count);
        at += 4 * count;
      };
      take(xyz.emplace_back(), 3 * mesh.at("vertices").get<std::size_t>());
      take(triangles.emplace_back(), 3 * mesh.at("triangles").get<std::size_t>());
      for (const std::uint32_t corner : triangles.back()) EXPECT_LT(3 * corner, xyz.back().size());
    }
  }

  /// The world corners of an object's triangles, rounded to whole numbers, sorted.
  [[nodiscard]] std::vector<std::array<long, 3>> corners(std::size_t object) const {
    const json& about = scene.at("objects").at(object);
    const auto mesh = about.at("mesh").get<std::size_t>();
    const auto pose = about.at("pose").get<std::array<double, 12>>();
    std::vector<std::array<long, 3>> points;
    for (const std::uint32_t corner : triangles.at(mesh)) {
      const float* p = &xyz.at(mesh)[3 * corner];
      std::array<long, 3> at{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double value = pose[4 * k] * p[0] + pose[4 * k + 1] * p[1] + pose[4 * k + 2] * p[2] + pose[4 * k + 3];
        at[k] = std::lround(value);
        EXPECT_NEAR(value, static_cast<double>(at[k]), 1e-6);
      }
      points.push_back(at);
    }
    std::sort(points.begin(), points.end());
    return points;
  }

 private:
  /// As a browser ends an element: at the next "</script". Cuts it off the text.
  static std::string block(std::string& text, const std::string& start) {
    const std::size_t at = text.find(start);
    EXPECT_NE(at, std::string::npos) << start;
    const std::size_t from = at + start.size(), end = text.find("</script", from);
    std::string inner = text.substr(from, end - from);
    // Within a script "<!--" and "<script" change what ends it.
    EXPECT_EQ(inner.find('<'), std::string::npos);
    text = text.substr(end + std::string("</script>").size());
    return inner;
  }
};

std::vector<std::array<long, 3>> corners(const Solid& solid) {
  std::vector<std::array<long, 3>> points;
  for (const auto& triangle : solid.triangles)
    for (const int corner : triangle) {
      const auto& v = solid.vertices[static_cast<std::size_t>(corner)];
      points.push_back({v[0], v[1], v[2]});
    }
  std::sort(points.begin(), points.end());
  return points;
}

class PageFile : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("page.html", kPageHead + "<title>t</title>\n<!-- impinge: data -->\n<script>run()</script>\n");
    launch.environment["IMPINGE_PAGE"] = (folder.path() / "page.html").string();
    folder.write("a.off", off(box({0, 0, 0}, {2, 2, 2})));
    folder.write("b.off", off(box({1, 1, 1}, {3, 3, 3})));
    folder.write("far.off", off(box({10'000'000, 0, 0}, {10'000'002, 4, 6})));
  }
  [[nodiscard]] Ended run(std::vector<std::string> words) const { return impinge(folder, words, launch); }
  [[nodiscard]] Page page() const { return Page(folder.read("out.html")); }
  Folder folder;
  Launch launch;
};

TEST_F(PageFile, HoldsTheReportAndWhatIsDrawn) {
  const Ended ended = run({"clash", "a.off", "b.off", "far.off", "--html", "out.html", "--json", "out.json"});
  EXPECT_EQ(ended.code, 1) << ended.err;
  const Page out = page();
  EXPECT_EQ(out.before, kPageHead + "<title>t</title>\n");
  EXPECT_EQ(out.after, "\n<script>run()</script>\n");
  EXPECT_EQ(out.report, json::parse(folder.read("out.json")));
  EXPECT_EQ(out.report.at("settings").at("depth_precision"), 0.05);
  EXPECT_TRUE(out.report.at("settings").at("regions"));
  EXPECT_EQ(out.scene.at("version"), 1);
  EXPECT_EQ(out.scene.at("title"), "a.off, b.off, far.off");
  EXPECT_EQ(out.scene.at("triangles"), 36);
  EXPECT_EQ(out.scene.at("shown"), 36);
  ASSERT_EQ(out.scene.at("objects").size(), 3U);
  EXPECT_EQ(out.corners(0), corners(box({0, 0, 0}, {2, 2, 2})));
  EXPECT_EQ(out.corners(1), corners(box({1, 1, 1}, {3, 3, 3})));
  EXPECT_EQ(out.corners(2), corners(box({10'000'000, 0, 0}, {10'000'002, 4, 6})));
}

TEST_F(PageFile, InstancesShareAMesh) {
  folder.write("many.gltf", gltf({{"left", {0, 0, 0}}, {"right", {20, 0, 0}}, {"up", {0, 0, 40}}}));
  EXPECT_EQ(run({"view", "many.gltf", "--html", "out.html"}).code, 0);
  const Page out = page();
  EXPECT_EQ(out.scene.at("meshes").size(), 1U);
  ASSERT_EQ(out.scene.at("objects").size(), 3U);
  EXPECT_EQ(out.corners(1), corners(cube(20, 0, 0)));
  EXPECT_EQ(out.corners(2), corners(cube(0, 0, 40)));
}

TEST_F(PageFile, SaysWhichAxisIsUp) {
  folder.write("a.obj", obj(cube(0, 0, 0)));
  folder.write("b.stl", stl(cube(3, 0, 0)));
  folder.write("c.gltf", gltf({{"one", {6, 0, 0}}}));
  folder.write("house.ifc", ifc_of_two_walls());
  folder.write("HOUSE.IFC", ifc_of_two_walls());
  folder.write("duck.dae", collada_of_two_walls());
  const auto up = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--html", "out.html", "--quiet"});
    const Ended ended = run(words);
    EXPECT_NE(ended.code, 2) << ended.err;
    return page().scene.at("up").get<std::string>();
  };
  for (const std::string command : {"view", "clash"}) {
    SCOPED_TRACE(command);
    EXPECT_EQ(up({command, "c.gltf"}), "y");
    EXPECT_EQ(up({command, "HOUSE.IFC"}), "z");
    EXPECT_EQ(up({command, "a.obj", "duck.dae"}), "y");
    EXPECT_EQ(up({command, "a.obj", "b.stl"}), "z");
    EXPECT_EQ(up({command, "house.ifc", "--up", "y"}), "y");
  }
}

TEST_F(PageFile, HasTheSameUpAsOtherOutputs) {
  folder.write("a.obj", obj(cube(0, 0, 0)));
  folder.write("house.ifc", ifc_of_two_walls());
  for (const std::string up : {"", "y", "z"}) {
    std::vector<std::string> words{"clash", "a.obj", "house.ifc", "--html", "out.html", "--csv", "out.csv"};
    words.insert(words.end(), {"--unit", "m", "--quiet"});
    if (!up.empty()) words.insert(words.end(), {"--up", up});
    EXPECT_EQ(run(words).code, 1);
    const auto rows = read_csv(folder.read("out.csv"));
    ASSERT_GT(rows.size(), 1U);
    const auto number = [&](const std::string& column) {
      const auto at = std::find(rows[0].begin(), rows[0].end(), column) - rows[0].begin();
      return std::stod(rows.at(1).at(static_cast<std::size_t>(at)));
    };
    EXPECT_EQ(number("z_m"), number(page().scene.at("up"))) << up;
    EXPECT_NE(number("y"), number("z"));
  }
}

TEST_F(PageFile, TellsWhichGroupsPartsAreIn) {
  for (const char* const name : {"one.glb", "two.glb"}) {
    AnimatedGltf file;
    const auto part = [&](const char* part_name, double x) {
      return file.node({{"name", part_name}, {"mesh", 0}, {"translation", {x, 0, 0}}});
    };
    const int left = file.node({{"name", "asm"}, {"children", {part("bolt", 0), part("bolt", 10)}}});
    const int unnamed = file.node({{"children", {part("DN 1/2", 20)}}});
    const int right = file.node({{"name", "asm"}, {"children", {unnamed}}});
    file.roots({file.node({{"name", "a/b"}, {"children", {left, right}}}), part("lid", 30)});
    folder.write(name, file.glb());
  }
  EXPECT_EQ(run({"view", "one.glb", "a.off", "two.glb", "--html", "out.html"}).code, 0);
  const Page out = page();
  EXPECT_EQ(out.scene.at("groups"), json::parse(R"([{"name":"a/b"},{"name":"asm","parent":0},{"name":"asm","parent":0},
                            {"name":"a/b"},{"name":"asm","parent":3},{"name":"asm","parent":3}])"));
  std::vector<std::string> ways;
  for (const json& object : out.report.at("objects")) {
    const json& drawn = out.scene.at("objects").at(object.at("id").get<std::size_t>());
    ways.push_back(object.at("name").get<std::string>() + " " + drawn.value("group", json("-")).dump());
  }
  EXPECT_EQ(ways, (std::vector<std::string>{"bolt 1", "bolt (2) 1", "DN 1/2 2", "lid \"-\"", "a \"-\"", "bolt 4",
                                            "bolt (2) 4", "DN 1/2 5", "lid \"-\""}));
}

TEST_F(PageFile, NoNameEndsItsBlock) {
  for (const std::string name :
       {"<_script><!--", "<script>alert(1)", "<!-- impinge: data -->", "\xff\x1b\"\\\n\xE2\x80\xAE"}) {
    std::string file = name;
    folder.write(file + ".off", off(box({1, 1, 1}, {3, 3, 3})));
    EXPECT_EQ(run({"clash", "a.off", file + ".off", "--html", "out.html", "--quiet"}).code, 1);
    const Page out = page();
    EXPECT_EQ(out.after, "\n<script>run()</script>\n") << name;
  }
  // A file's name holds no slash, but a node's may.
  folder.write("odd.gltf", gltf({{"</script><!--<script>", {0, 0, 0}}, {"two", {1, 1, 1}}}));
  EXPECT_EQ(run({"clash", "odd.gltf", "--html", "out.html", "--quiet"}).code, 1);
  const Page out = page();
  EXPECT_EQ(out.after, "\n<script>run()</script>\n");
  EXPECT_EQ(out.report.at("objects").at(0).at("name"), "</script><!--<script>");
}

/// A sphere around the origin, of 6,400 triangles.
std::string sphere() {
  const scenes::MeshData mesh = scenes::uv_sphere(80, 41);
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertex_count(), mesh.triangle_count());
  const auto add = [&](const char* before, const auto& threes) {
    for (std::size_t i = 0; i < threes.size(); i += 3)
      text += fmt::format("{}{}\n", before, fmt::join(std::span(threes).subspan(i, 3), " "));
  };
  add("", mesh.xyz), add("3 ", mesh.triangles);
  return text;
}

TEST_F(PageFile, LargeModelsAreSimplifiedAndSaySo) {
  folder.write("ball.off", sphere());
  EXPECT_EQ(run({"view", "ball.off", "a.off", "--html", "out.html", "--page-triangles", "1000"}).code, 0);
  const Page out = page();
  EXPECT_EQ(out.scene.at("asked"), 1000);
  EXPECT_EQ(out.scene.at("triangles"), 6400 + 12);
  const auto shown = out.scene.at("shown").get<std::size_t>();
  EXPECT_EQ(shown, (out.triangles.at(0).size() + out.triangles.at(1).size()) / 3);
  EXPECT_LE(shown, 2000U);
  EXPECT_GE(shown, 500U);
  EXPECT_EQ(out.corners(1), corners(box({0, 0, 0}, {2, 2, 2}))) << "a box keeps its triangles";
  for (std::size_t i = 0; i < out.xyz[0].size(); i += 3)
    EXPECT_NEAR(std::hypot(out.xyz[0][i], out.xyz[0][i + 1], out.xyz[0][i + 2]), 1, 0.1);
}

TEST_F(PageFile, WhatIsDrawnInPlaceOfTheModelIsSaid) {
  folder.write("ball.off", sphere());
  const auto drawn = [&] { return page().scene.at("shown").get<int>(); };
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"clash", "ball.off", "a.off", "--html", "out.html"});
    return run(words).err;
  };
  EXPECT_EQ(with({}), "");
  EXPECT_EQ(with({"--page-triangles", "6412"}), "");
  // A ball of ten triangles is none, and the box has twelve.
  const std::string few = with({"--page-triangles", "10"});
  ASSERT_GT(drawn(), 10);
  EXPECT_EQ(few, "impinge: the page draws " + std::to_string(drawn()) +
                     " of 6,412 triangles: with --page-triangles 10 parts would lose their shape; verdicts and figures "
                     "are those of the full model\n");
  EXPECT_EQ(with({"--page-triangles", "10", "--quiet"}), "");
  const Ended view = run({"view", "ball.off", "--html", "out.html", "--page-triangles", "10"});
  EXPECT_NE(view.err.find("of 6,400 triangles: with --page-triangles 10 parts"), std::string::npos) << view.err;
}

TEST_F(PageFile, OfAViewHasNoClashes) {
  const Ended ended = run({"view", "a.off", "b.off"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, "a.off.html: 2 parts, 24 triangles\n");
  const Page out(folder.read("a.off.html"));
  EXPECT_TRUE(out.report.at("pairs").empty());
  EXPECT_TRUE(out.report.at("settings").is_null());
  EXPECT_TRUE(out.report.at("counts").is_null());
  ASSERT_EQ(out.report.at("objects").size(), 2U);
  EXPECT_EQ(out.report.at("objects").at(1).at("name"), "b");
  EXPECT_TRUE(out.report.at("objects").at(1).at("class").is_null());
  EXPECT_EQ(out.corners(1), corners(box({1, 1, 1}, {3, 3, 3})));
  EXPECT_EQ(run({"view", "a.off", "--quiet"}).out, "") << "it may replace its own page";
}

TEST_F(PageFile, WithoutTheProgramEverythingElseIsWritten) {
  launch.environment["IMPINGE_PAGE"] = "/missing/report.html";
  const Ended ended = run({"clash", "a.off", "b.off", "--html", "out.html", "--json", "out.json"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.out, "");
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1);
  for (const char* part : {"/missing/report.html", "IMPINGE_PAGE", "./dev page", "every output but --html"})
    EXPECT_NE(ended.err.find(part), std::string::npos) << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.html"));
  EXPECT_EQ(run({"view", "a.off"}).code, 2);
  EXPECT_EQ(run({"clash", "a.off", "b.off", "--json", "out.json", "--csv", "out.csv", "--quiet"}).code, 1);
  // A file that is no template is none.
  launch.environment["IMPINGE_PAGE"] = (folder.path() / "a.off").string();
  EXPECT_EQ(run({"view", "a.off"}).code, 2);
}

}  // namespace
}  // namespace impinge::test
