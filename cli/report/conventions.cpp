// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/conventions.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "report/vector.hpp"

namespace impinge::cli {
namespace {

bool is_mostly_z_up(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::string_view, 5> kZUp{".obj", ".off", ".ply", ".stl", ".3mf"};
  return std::find(kZUp.begin(), kZUp.end(), ending) != kZUp.end();
}

}  // namespace

Conventions conventions_of(const ClashArguments& arguments) {
  return {arguments.metres, arguments.y_up ? *arguments.y_up : !is_mostly_z_up(arguments.files.front())};
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

}  // namespace impinge::cli
