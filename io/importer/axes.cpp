// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/axes.hpp"

#include <assimp/commonMetaData.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "io/text.hpp"

namespace impinge::importer {
namespace {

using io::sentence;

/// The largest error of a float rotation by a right angle, with room.
constexpr double kTurnError = 1e-6;

/// What became of (x, y, z), such as "(x, z, -y)", if the matrix divided by its scale only swaps and mirrors axes.
std::optional<std::string> swapped_axes(const aiMatrix4x4& m, double scale) {
  const std::array<std::array<double, 3>, 3> rows{{{m.a1, m.a2, m.a3}, {m.b1, m.b2, m.b3}, {m.c1, m.c2, m.c3}}};
  std::string out = "(";
  for (const auto& row : rows) {
    int axis = -1;
    for (int i = 0; i < 3; ++i) {
      const double entry = row[static_cast<std::size_t>(i)] / scale;
      if (std::abs(entry) <= kTurnError) continue;
      if (axis >= 0 || std::abs(std::abs(entry) - 1) > kTurnError) return std::nullopt;
      axis = i;
      if (entry < 0) out += '-';
    }
    if (axis < 0) return std::nullopt;
    out += static_cast<char>('x' + axis);
    out += &row == &rows.back() ? ")" : ", ";
  }
  return out;
}

bool keeps_the_files_root(std::string_view reader) {
  static constexpr std::array<std::string_view, 5> kReaders{"glTF", "FBX", "XFile", "LightWave", "Quick3D"};
  return std::any_of(kReaders.begin(), kReaders.end(), [&](auto name) { return reader.find(name) != reader.npos; });
}

}  // namespace

std::string reader_of(const aiScene& scene) {
  aiString name;
  if (scene.mMetaData) scene.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, name);
  return {name.data, name.length};
}

std::optional<double> unit_in_metres(const aiScene& scene) {
  const std::string reader = reader_of(scene);
  if (reader.find("glTF") != reader.npos || reader.find("Collada") != reader.npos) return 1;
  float centimetres = 0;
  if (reader.find("FBX") == reader.npos || !scene.mMetaData->Get("UnitScaleFactor", centimetres)) return std::nullopt;
  // The decimal number that was written, such as 2.54, not the float nearest to it.
  double written = 0;
  std::string problem;
  if (!io::parse_real(sentence(centimetres), written, problem) || !(written > 0)) return std::nullopt;
  return written / 100;
}

std::vector<std::string> axis_warnings(const aiScene& scene) {
  const std::string reader = reader_of(scene);
  const aiMatrix4x4& root = scene.mRootNode->mTransformation;
  if (keeps_the_files_root(reader)) return {};
  const double scale = std::cbrt(std::abs(static_cast<double>(root.Determinant())));
  if (!std::isfinite(scale) || scale == 0) return {};
  const std::string who = sentence("assimp's ", reader.empty() ? "reader" : reader);
  std::vector<std::string> warnings;
  const std::optional<std::string> axes = swapped_axes(root, scale);
  if (axes && *axes != "(x, y, z)")
    warnings.push_back(sentence(who, " turned the axes: the file's (x, y, z) became ", *axes, "."));
  if (std::abs(scale - 1) > kTurnError) {
    warnings.push_back(sentence(who, " changed the unit", unit_in_metres(scene) == 1 ? " to metres" : "",
                                ": the file's lengths were multiplied by ", scale, "."));
  }
  return warnings;
}

}  // namespace impinge::importer
