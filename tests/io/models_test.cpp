// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <chrono>
#include <random>

#include "support.hpp"

namespace impinge::io {
namespace {

using namespace std::chrono_literals;

/// A sound model or a sentence about the file, in time.
void expect_answer(const std::filesystem::path& file, std::chrono::seconds limit) {
  ReadOptions options;
  options.time_limit = limit;
  options.memory_limit_bytes = std::uint64_t{2} << 30;
  const auto start = std::chrono::steady_clock::now();
  expect_sound_or_error(read(file, options), file.string());
  EXPECT_LT(std::chrono::steady_clock::now() - start, limit + 10s);
}

std::vector<std::filesystem::path> models() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kModels))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Models, EveryFileOfAssimpsCollectionHasAnAnswer) {
  const auto files = models();
  ASSERT_GT(files.size(), 500u) << "install assimp-testmodels";
  for (const auto& file : files) {
    SCOPED_TRACE(file.string());
    expect_answer(file, 5s);
  }
}

TEST(Models, BrokenFilesAreErrors) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kModels / "invalid")) {
    ++count;
    if (entry.path().filename() == "malformed2.obj") {  // one face has no corners at all, the others are good
      EXPECT_EQ(model_of(read(entry.path())).objects.at(0).mesh.triangle_count(), 10u);
      continue;
    }
    EXPECT_FALSE(read(entry.path()).has_value()) << entry.path();
  }
  EXPECT_GT(count, 5);
}

TEST(Models, MutatedAndTruncatedFilesHaveAnAnswer) {
  const TemporaryFolder folder;
  const unsigned seed = 20250612;
  std::mt19937 random(seed);
  for (const char* name :
       {"glTF2/BoxTextured-glTF-Binary/BoxTextured.glb", "glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf",
        "3MF/box.3mf", "Collada/cube_UTF8BOM.dae", "FBX/box.fbx", "FBX/cubes_with_names.fbx", "3DS/fels.3ds",
        "X/test_cube_binary.x", "LWO/LWO2/box_2uv_1unused.lwo", "AMF/test1.amf", "BLEND/box.blend", "DXF/wuson.dxf",
        "MS3D/twospheres.ms3d", "IFC/AC14-FZK-Haus.ifc"}) {
    const std::string bytes = bytes_of_file(kModels / name);
    ASSERT_FALSE(bytes.empty()) << name;
    for (int round = 0; round < 4; ++round) {
      SCOPED_TRACE(std::string(name) + " seed " + std::to_string(seed) + " round " + std::to_string(round));
      std::string mutated = bytes;
      if (round == 0) mutated.resize(bytes.size() / 2);
      for (int edit = 0; edit < 5 * round; ++edit) mutated[random() % mutated.size()] = static_cast<char>(random());
      expect_answer(folder.write("mutated" + std::filesystem::path(name).extension().string(), mutated), 2s);
    }
  }
}

}  // namespace
}  // namespace impinge::io
