// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// `impinge clash --gltf`, read back as glTF 2.0 says it and by assimp.
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/cli/meshes.hpp"
#include "tests/cli/program.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;
using Vec = std::array<double, 3>;

/// A binary glTF taken apart, with what the format demands held against it.
struct Glb {
  json document;
  std::string data;

  explicit Glb(const std::string& bytes) {
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      if (at + 4 <= bytes.size()) std::memcpy(&value, &bytes[at], 4);
      return value;
    };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(4), 2U);
    EXPECT_EQ(word(8), bytes.size());
    const std::uint32_t length = word(12);
    EXPECT_EQ(length % 4, 0U);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    document = json::parse(bytes.substr(20, length));
    const std::size_t next = 20 + length;
    if (next == bytes.size()) return;
    EXPECT_EQ(bytes.substr(next + 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(word(next) % 4, 0U);
    data = bytes.substr(next + 8);
    EXPECT_EQ(word(next), data.size());
    EXPECT_EQ(document.at("buffers").at(0).at("byteLength"), data.size());
  }

  template <class T>
  [[nodiscard]] std::vector<T> numbers(std::size_t accessor, std::size_t each) const {
    const json& about = document.at("accessors").at(accessor);
    const json& view = document.at("bufferViews").at(about.at("bufferView").get<std::size_t>());
    const std::size_t inside = about.at("byteOffset").get<std::size_t>();
    const std::size_t from = view.value("byteOffset", std::size_t{0}) + inside;
    std::vector<T> values(each * about.at("count").get<std::size_t>());
    EXPECT_EQ(from % 4, 0U);
    EXPECT_LE(inside + values.size() * sizeof(T), view.at("byteLength").get<std::size_t>());
    EXPECT_LE(from + values.size() * sizeof(T), data.size());
    std::memcpy(values.data(), data.data() + from, values.size() * sizeof(T));
    return values;
  }

  /// Positions, whose bounds must be exactly those that the accessor says.
  [[nodiscard]] std::vector<Vec> positions(std::size_t accessor) const {
    const json& about = document.at("accessors").at(accessor);
    EXPECT_EQ(about.at("componentType"), 5126);
    EXPECT_EQ(about.at("type"), "VEC3");
    const std::vector<float> xyz = numbers<float>(accessor, 3);
    std::vector<Vec> points;
    for (std::size_t i = 0; i < xyz.size(); i += 3) points.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
    for (std::size_t k = 0; k < 3; ++k) {
      double least = points.at(0)[k], most = least;
      for (const Vec& p : points) least = std::min(least, p[k]), most = std::max(most, p[k]);
      EXPECT_EQ(about.at("min").at(k).get<double>(), least);
      EXPECT_EQ(about.at("max").at(k).get<double>(), most);
    }
    return points;
  }
  [[nodiscard]] const json& node(const json& number) const {
    return document.at("nodes").at(number.get<std::size_t>());
  }
  [[nodiscard]] const json& root() const { return node(document.at("scenes").at(0).at("nodes").at(0)); }
  [[nodiscard]] const json& mesh(const json& of_node) const {
    return document.at("meshes").at(of_node.at("mesh").get<std::size_t>());
  }
};

class Gltf : public testing::Test {
 protected:
  void make(int far) {
    folder.write("a.off", off(box({far, 0, 0}, {far + 2, 2, 2})));
    folder.write("b.off", off(box({far + 1, 1, 1}, {far + 3, 3, 3})));
    folder.write("bar.off", off(box({far - 2, 0, 1}, {far + 9, 1, 4})));  // goes through a
    folder.write("f.off", off(box({far + 80, 0, 0}, {far + 82, 2, 2})));
    folder.write("g.off", off(box({far + 85, 4, 0}, {far + 87, 6, 2})));
  }
  void run(const std::vector<std::string>& more) {
    const Ended ended = impinge(folder, joined({"clash", "a.off", "b.off", "bar.off", "f.off", "g.off", "--clearance",
                                                "3.7", "--gltf", "out.glb", "--json", "out.json", "--quiet"},
                                               more));
    EXPECT_EQ(ended.code, 1) << ended.err;
    answer = json::parse(folder.read("out.json"));
  }
  [[nodiscard]] json pair(const json& id) const {
    for (const json& one : answer.at("pairs"))
      if (one.at("id") == id) return one;
    ADD_FAILURE() << "the JSON has no pair " << id;
    return {};
  }
  Folder folder;
  json answer;
};

/// The region's node holds its lines, piece by piece, and its centroid.
void expect_region(const Glb& glb, const json& node, const json& region) {
  const json& primitives = glb.mesh(node).at("primitives");
  ASSERT_EQ(primitives.size(), region.at("lines").empty() ? 1U : 2U);
  const Vec origin = node.at("translation").get<Vec>();
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k)
    extent = std::max(extent, region.at("box").at(1).at(k).get<double>() - region.at("box").at(0).at(k).get<double>());
  const auto expect_at = [&](const Vec& offset, const json& point) {
    // The offsets are floats of half the extent; adding them rounds once more.
    for (std::size_t k = 0; k < 3; ++k) {
      const double is = point.at(k).get<double>();
      EXPECT_NEAR(origin[k] + offset[k], is, extent * 0x1p-24 + std::abs(is) * 0x1p-51);
    }
  };
  if (!region.at("lines").empty()) {
    EXPECT_EQ(primitives.at(0).at("mode"), 1);
    const std::vector<Vec> points = glb.positions(primitives.at(0).at("attributes").at("POSITION"));
    const std::vector<std::uint32_t> ends = glb.numbers<std::uint32_t>(primitives.at(0).at("indices"), 1);
    std::size_t at = 0;
    for (const json& line : region.at("lines"))
      for (std::size_t i = 1; i < line.size(); ++i, at += 2) {
        ASSERT_LT(at + 1, ends.size());
        expect_at(points.at(ends[at]), line.at(i - 1));
        expect_at(points.at(ends[at + 1]), line.at(i));
      }
    EXPECT_EQ(at, ends.size());
  }
  const json& dot = primitives.back();
  EXPECT_EQ(dot.at("mode"), 0);
  const std::vector<Vec> points = glb.positions(dot.at("attributes").at("POSITION"));
  ASSERT_EQ(points.size(), 1U);
  expect_at(points[0], region.at("centroid"));
  for (const char* key : {"pairs", "area", "length", "centroid", "normal"})
    EXPECT_EQ(node.at("extras").at(key), region.at(key)) << key;
}

TEST_F(Gltf, HoldsTheRegionsOfTheJson) {
  for (const int far : {0, 1'000'000}) {
    make(far);
    run({});
    const Glb glb(folder.read("out.glb"));
    EXPECT_EQ(glb.document.at("asset").at("version"), "2.0");
    const json& clashes = glb.root().at("children");
    ASSERT_EQ(clashes.size(), answer.at("pairs").size());
    std::size_t rank = 0;
    for (const json& number : clashes) {
      const json& node = glb.node(number);
      const json& extras = node.at("extras");
      const json about = pair(extras.at("id"));
      EXPECT_EQ(extras.at("rank"), ++rank);
      EXPECT_EQ(extras.at("verdict"), about.at("verdict"));
      EXPECT_EQ(extras.at("fails"), about.at("fails"));
      EXPECT_EQ(extras.at("distance"), about.at("distance"));
      EXPECT_EQ(extras.at("a").at("id"), about.at("a"));
      EXPECT_EQ(extras.at("b").at("name"), answer.at("objects").at(about.at("b").get<std::size_t>()).at("name"));
      EXPECT_EQ(extras.at("depth").is_null(), about.at("overlap_depth").is_null());
      const json& regions = about.at("regions");
      const bool has_nearest = !about.at("nearest").is_null();
      ASSERT_EQ(node.at("children").size(), regions.size() + (has_nearest ? 1 : 0));
      for (std::size_t i = 0; i < regions.size(); ++i)
        expect_region(glb, glb.node(node.at("children").at(i)), regions[i]);
      if (!has_nearest) continue;
      const json& nearest = glb.node(node.at("children").back());
      const std::vector<Vec> ends =
          glb.positions(glb.mesh(nearest).at("primitives").at(0).at("attributes").at("POSITION"));
      ASSERT_EQ(ends.size(), 2U);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(nearest.at("translation").at(k).get<double>() + ends[1][k],
                    about.at("nearest").at(1).at(k).get<double>(), 1e-6);
    }
    EXPECT_EQ(glb.node(clashes.at(0)).at("extras").at("verdict"), "penetrating");
    EXPECT_EQ(glb.node(clashes.back()).at("extras").at("verdict"), "apart");
  }
}

/// All ends of lines of an assimp scene, in the world; and how many lines.
void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above, std::vector<aiVector3D>& ends) {
  const aiMatrix4x4 world = above * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
      for (unsigned i = 0; mesh.mFaces[f].mNumIndices == 2 && i < 2; ++i)
        ends.push_back(world * mesh.mVertices[mesh.mFaces[f].mIndices[i]]);
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c) collect(scene, *node.mChildren[c], world, ends);
}

TEST_F(Gltf, IsReadByAssimpInMetresWithYUp) {
  make(0);
  for (const bool y_up : {false, true}) {
    run({"--unit", "mm", "--up", y_up ? "y" : "z"});
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile((folder.path() / "out.glb").string(), 0);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    std::vector<aiVector3D> ends;
    collect(*scene, *scene->mRootNode, aiMatrix4x4(), ends);
    std::vector<Vec> expected;
    const auto add = [&](const json& p) {
      const Vec v = p.get<Vec>();
      expected.push_back(y_up ? Vec{v[0] / 1000, v[1] / 1000, v[2] / 1000}
                              : Vec{v[0] / 1000, v[2] / 1000, -v[1] / 1000});
    };
    for (const json& about : answer.at("pairs")) {
      for (const json& region : about.at("regions"))
        for (const json& line : region.at("lines"))
          for (std::size_t i = 1; i < line.size(); ++i) add(line.at(i - 1)), add(line.at(i));
      if (!about.at("nearest").is_null()) add(about.at("nearest").at(0)), add(about.at("nearest").at(1));
    }
    ASSERT_EQ(ends.size(), expected.size());
    EXPECT_GT(ends.size(), 20U);
    std::vector<Vec> found;
    for (const aiVector3D& p : ends) found.push_back({p.x, p.y, p.z});
    // In whatever order; each has one near it, and the other way round.
    for (const auto& [these, those] : {std::pair{found, expected}, {expected, found}})
      for (const Vec& p : these) {
        const bool near = std::any_of(those.begin(), those.end(), [&](const Vec& q) {
          return std::abs(p[0] - q[0]) + std::abs(p[1] - q[1]) + std::abs(p[2] - q[2]) < 1e-7;
        });
        EXPECT_TRUE(near) << p[0] << ' ' << p[1] << ' ' << p[2];
      }
  }
}

TEST_F(Gltf, OfNothingIsAnEmptySceneAndNamesAreHarmless) {
  make(0);
  EXPECT_EQ(impinge(folder, {"clash", "a.off", "f.off", "--gltf", "none.glb", "--quiet"}).code, 0);
  const Glb none(folder.read("none.glb"));
  EXPECT_FALSE(none.root().contains("children"));
  EXPECT_FALSE(none.document.contains("meshes"));
  EXPECT_FALSE(none.document.contains("buffers"));
  const std::string name = "\x1b\"\\q\n\xff" + std::string(120, 'n');
  folder.write(name + ".off", off(box({1, 1, 1}, {3, 3, 3})));
  EXPECT_EQ(impinge(folder, {"clash", "a.off", name + ".off", "--gltf", "odd.glb", "--quiet"}).code, 1);
  const Glb odd(folder.read("odd.glb"));
  EXPECT_EQ(odd.node(odd.root().at("children").at(0)).at("extras").at("b").at("name"),
            "\x1b\"\\q\n\xEF\xBF\xBD" + std::string(120, 'n'));
}

}  // namespace
}  // namespace impinge::test
