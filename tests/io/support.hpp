// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "impinge/io.hpp"
#include "tests/core/folder.hpp"

namespace impinge::io {

using TemporaryFolder = test::Folder;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Points = std::vector<Point>;

inline Triangles triangles_of(const Object& object) {
  return {object.mesh.triangles().begin(), object.mesh.triangles().end()};
}
inline Points points_of(const Object& object) { return {object.mesh.vertices().begin(), object.mesh.vertices().end()}; }
inline std::vector<std::string> names_of(const Model& model) {
  std::vector<std::string> names;
  for (const Object& object : model.objects) names.push_back(object.name);
  return names;
}

/// The message of the error that must be there.
template <class T>
std::string error_of(const Result<T>& result, Code code = Code::bad_file) {
  EXPECT_FALSE(result.has_value());
  if (result.has_value()) return "(no error)";
  EXPECT_EQ(result.error().code, code) << result.error().message;
  return result.error().message;
}

/// The model that must be there.
inline Model model_of(Result<Model> result) {
  EXPECT_TRUE(result.has_value()) << (result.has_value() ? "" : result.error().message);
  return result.has_value() ? std::move(*result) : Model{};
}

/// What `read` and the readers promise of every model.
inline void expect_sound(const Model& model) {
  EXPECT_FALSE(model.objects.empty());
  std::vector<std::string> names = names_of(model);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end()) << "a name comes twice";
  for (const Object& object : model.objects) EXPECT_GT(object.mesh.triangle_count(), 0u) << object.name;
}

/// Whether it is a model, which is sound then; else an error that says something of the file of this name.
inline bool expect_sound_or_error(const Result<Model>& model, const std::string& file) {
  if (model)
    expect_sound(*model);
  else
    EXPECT_THAT(error_of(model), testing::StartsWith(file));
  return model.has_value();
}

inline std::string bytes_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file << " is missing; install what ./dev test installs";
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Debian's package assimp-testmodels.
inline const std::filesystem::path kModels = "/usr/share/assimp/models";

/// Appends a number's bytes, the lowest or the highest first.
template <class T>
void append_bytes(std::string& out, T value, bool big_endian = false) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.size());
}

/// A ZIP archive of these members, by their names.
inline void write_zip(const std::filesystem::path& file, const std::map<std::string, std::string>& members) {
  int problem = 0;
  zip_t* const archive = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &problem);
  for (const auto& [name, text] : members)
    zip_file_add(archive, name.c_str(), zip_source_buffer(archive, text.data(), text.size(), 0), ZIP_FL_ENC_UTF_8);
  EXPECT_EQ(zip_close(archive), 0) << file;
}

/// Of a file with this text.
inline Model read_text(const std::string& text, const std::string& name = "case.gltf") {
  const TemporaryFolder folder;
  return model_of(read(folder.write(name, text)));
}

}  // namespace impinge::io
