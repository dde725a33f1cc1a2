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

}  // namespace

std::optional<bool> has_y_up(const std::string& file) {
  const std::string ending = ending_of(file);
  if (is_any_of(ending, {".obj", ".off", ".ply", ".stl", ".amf"})) return std::nullopt;
  return !is_any_of(ending, {".ifc", ".ifczip", ".3mf", ".blend"});
}

bool is_y_up(const std::vector<std::string>& files, std::optional<bool> said) {
  if (said) return *said;
  // What has no rules was made to fit what has them: all files are in one system of coordinates.
  for (const std::string& file : files)
    if (const std::optional<bool> ruled = has_y_up(file)) return *ruled;
  return false;
}

Conventions conventions_of(const ReportOptions& options, const Assembly& assembly) {
  const std::optional<double>& metres = assembly.unit_in_metres;
  return {metres.value_or(1), is_y_up(options.files, options.y_up), metres.has_value()};
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
