// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "impinge/impacts.hpp"
#include "impinge/io.hpp"

namespace impinge {
namespace {

namespace fs = std::filesystem;
using Ids = std::set<std::pair<std::uint32_t, std::uint32_t>>;

nlohmann::json json_of(const fs::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

/// Steps of the "Sample Scalable CCD Ground Truth Data" (Wang et al. 2021): folders frames, boxes and mma_bool, where
/// ids are those of vertices, then of edges, then of faces.
TEST(GroundTruth, OfPublicScenesIsFoundWhole) {
  const char* const folder = std::getenv("IMPINGE_CCD_DIR");
  if (folder == nullptr) GTEST_SKIP() << "set IMPINGE_CCD_DIR to a folder of scenes of the ground truth";
  int steps = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    std::smatch number;
    const std::string name = entry.path().filename().string();
    if (!std::regex_match(name, number, std::regex(R"((\d+)(vf)\.json)"))) continue;
    const fs::path scene = entry.path().parent_path().parent_path();
    SCOPED_TRACE(scene.string() + " " + number[1].str());
    const auto frame = [&](int n) {
      auto model = io::read(scene / "frames" / (std::to_string(n) + ".ply"));
      EXPECT_TRUE(model) << model.error().message;
      return model->objects.at(0).mesh;
    };
    const int n = std::stoi(number[1]);
    const Moving mesh{frame(n), frame(n + 1)};
    Ids truth, found;
    for (const std::string kind : {"vf", "ee"}) {
      const auto boxes = json_of(scene / "boxes" / (number[1].str() + kind + ".json")),
                 meet = json_of(scene / "mma_bool" / (number[1].str() + kind + "_mma_bool.json"));
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const auto a = boxes[i][0].get<std::uint32_t>(), b = boxes[i][1].get<std::uint32_t>();
        if (meet[i].get<bool>()) truth.emplace(std::min(a, b), std::max(a, b));
      }
    }
    const auto impacts = find_impacts(mesh);
    ASSERT_TRUE(impacts) << impacts.error().message;
    const auto vertices = static_cast<std::uint32_t>(mesh.from.vertex_count()),
               edges = static_cast<std::uint32_t>(mesh.from.edges().size());
    std::size_t faces = 0;
    for (const Impact& x : impacts->impacts) {
      const bool on_edges = x.feature == Feature::edge_edge;
      found.emplace(on_edges ? vertices + x.a : x.a, on_edges ? vertices + x.b : vertices + edges + x.b);
      faces += std::size_t{!on_edges};
    }
    EXPECT_EQ(truth, found);
    std::cout << scene.filename().string() << ": " << faces << " of a vertex and a face, "
              << impacts->impacts.size() - faces << " of two edges, the first at " << impacts->earliest->lo << '\n';
    ++steps;
  }
  EXPECT_GT(steps, 0);
}

}  // namespace
}  // namespace impinge
