// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/conventions.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "report/vector.hpp"

namespace impinge::report {
namespace {

std::string ending_of(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool is_any_of(const std::string& ending, std::initializer_list<std::string_view> endings) {
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// Whether a file has Y up when it is read, or else Z: by its format's rules, or because assimp's reader turns it so.
/// Nothing where there are no rules, and programs write either.
std::optional<bool> has_y_up(const std::string& file) {
  const std::string ending = ending_of(file);
  if (is_any_of(ending, {".obj", ".off", ".ply", ".stl", ".amf"})) return std::nullopt;
  return !is_any_of(ending, {".3mf", ".blend"});
}

/// glTF has metres; assimp's readers of IFC and COLLADA convert to them.
bool is_in_metres(const std::string& file) {
  return is_any_of(ending_of(file), {".gltf", ".glb", ".ifc", ".ifczip", ".dae"});
}

}  // namespace

bool is_y_up(const std::vector<std::string>& files, std::optional<bool> said) {
  if (said) return *said;
  // What has no rules was made to fit what has them: all files are in one system of coordinates.
  for (const std::string& file : files)
    if (const std::optional<bool> ruled = has_y_up(file)) return *ruled;
  return false;
}

Conventions conventions_of(const ReportOptions& options) {
  // A file that is scaled is brought to the unit of the others, whatever that is.
  const bool is_known = options.metres || (options.scales.empty() &&
                                           std::all_of(options.files.begin(), options.files.end(), is_in_metres));
  return {options.metres.value_or(1), is_y_up(options.files, options.y_up), is_known};
}

Point direction_in_bcf(const Conventions& conventions, const Point& direction) {
  return conventions.y_up ? Point{direction.x, -direction.z, direction.y} : direction;
}

Point place_in_bcf(const Conventions& conventions, const Point& point) {
  return conventions.metres * direction_in_bcf(conventions, point);
}

std::array<double, 16> matrix_to_gltf(const Conventions& conventions) {
  const double m = conventions.metres;
  if (conventions.y_up) return {m, 0, 0, 0, 0, m, 0, 0, 0, 0, m, 0, 0, 0, 0, 1};
  return {m, 0, 0, 0, 0, 0, -m, 0, 0, m, 0, 0, 0, 0, 0, 1};
}

}  // namespace impinge::report
