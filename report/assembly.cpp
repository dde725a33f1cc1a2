// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "report/conventions.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

double scale_of(const SceneOptions& options, const std::string& file) {
  for (const auto& [name, factor] : options.scales)
    if (name == file) return factor;
  return 1;
}

/// The same place where Z is up instead of Y, or Y instead of Z: exact, as entries only change places and signs.
Pose turned(const Pose& pose, bool to_y_up) {
  Pose result = pose;
  const auto turn = [&](const double* from, double* to, std::size_t stride) {
    const double y = from[stride], z = from[2 * stride];
    to[stride] = to_y_up ? z : -z, to[2 * stride] = to_y_up ? -y : y;
  };
  for (std::size_t column = 0; column < 3; ++column) turn(pose.R.data() + column, result.R.data() + column, 3);
  turn(pose.t.data(), result.t.data(), 1);
  return result;
}

/// Turns the models of files whose format says that another axis is up than in the first one's.
void bring_to_first_axes(const std::vector<std::string>& files, std::vector<io::Model>& models) {
  std::optional<bool> first;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::optional<bool> is_y_up = has_y_up(files[i]);
    if (!first) first = is_y_up;
    if (!is_y_up || is_y_up == first) continue;
    for (io::Object& object : models[i].objects) object.pose = turned(object.pose, *first);
    models[i].warnings.push_back(fmt::format("{} was turned so that {} is up, as in the files before it.",
                                             printable(files[i]), *first ? 'Y' : 'Z'));
  }
}

}  // namespace

Assembly assemble(const std::vector<std::string>& files, std::vector<io::Model> models) {
  Assembly assembly;
  assembly.files = files;
  std::vector<std::optional<double>> units;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const auto groups_before = static_cast<std::uint32_t>(assembly.groups.size());
    for (io::Group& group : models[i].groups) {
      if (group.parent) *group.parent += groups_before;
      assembly.groups.push_back(std::move(group));
    }
    for (io::Object& object : models[i].objects) {
      if (object.group) *object.group += groups_before;
      assembly.triangles += object.mesh.triangle_count();
      assembly.file_of.push_back(static_cast<std::uint32_t>(i));
      assembly.objects.push_back(std::move(object));
    }
    if (!models[i].objects.empty()) units.push_back(models[i].unit_in_metres);  // or else it was skipped
    for (std::string& warning : models[i].warnings) assembly.warnings.push_back(std::move(warning));
    for (const std::string& sentence : models[i].missing) assembly.missing.push_back(files[i] + ": " + sentence);
  }
  if (!units.empty() && std::count(units.begin(), units.end(), units[0]) == std::ssize(units))
    assembly.unit_in_metres = units[0];
  assembly.labels = labels_of(assembly);
  return assembly;
}

Result<Assembly> read_assembly(const SceneOptions& options, const std::function<void(std::size_t file)>& begin_file) {
  std::vector<io::Model> models;
  std::vector<std::string> skipped, missing;
  for (const std::string& file : options.files) {
    begin_file(models.size());
    io::ReadOptions read;
    read.max_file_bytes = options.max_file_bytes;
    read.scale = scale_of(options, file);
    read.property_sets = options.property_sets;
    read.stop = options.stop;
    for (const io::Model& earlier : models)
      if (!read.unit_in_metres) read.unit_in_metres = earlier.unit_in_metres;
    Result<io::Model> model = io::read(file, read);
    if (options.stop.stop_requested()) return interrupted();
    if (!model) {
      if (!options.skip_unreadable || skipped.size() + 1 == options.files.size()) return model.error();
      skipped.push_back(file), missing.push_back("skipped: " + model.error().message);
      model = io::Model();
    }
    models.push_back(*std::move(model));
  }
  bring_to_first_axes(options.files, models);
  Assembly assembly = assemble(options.files, std::move(models));
  assembly.skipped = std::move(skipped);
  assembly.missing.insert(assembly.missing.end(), missing.begin(), missing.end());
  return assembly;
}

std::vector<std::string> labels_of(const Assembly& assembly) {
  constexpr std::uint32_t kSeveral = 0xFFFFFFFF;
  std::unordered_map<std::string_view, std::uint32_t> file_with;
  for (std::size_t i = 0; i < assembly.objects.size(); ++i) {
    const auto [known, fresh] = file_with.try_emplace(assembly.objects[i].name, assembly.file_of[i]);
    if (!fresh && known->second != assembly.file_of[i]) known->second = kSeveral;
  }
  std::vector<std::string> labels;
  labels.reserve(assembly.objects.size());
  for (std::size_t i = 0; i < assembly.objects.size(); ++i) {
    std::string label = printable(assembly.objects[i].name);
    if (file_with.at(assembly.objects[i].name) == kSeveral)
      label += fmt::format(" ({})", printable(assembly.files[assembly.file_of[i]]));
    labels.push_back(std::move(label));
  }
  return labels;
}

std::vector<std::uint32_t> products_of(const Assembly& assembly) {
  std::map<std::pair<std::uint32_t, std::string_view>, std::uint32_t> numbers;
  std::vector<std::uint32_t> products;
  products.reserve(assembly.objects.size());
  for (std::size_t i = 0; i < assembly.objects.size(); ++i) {
    const std::string& product = assembly.objects[i].product;
    const auto next = static_cast<std::uint32_t>(numbers.size() + 1);
    products.push_back(product.empty() ? 0 : numbers.try_emplace({assembly.file_of[i], product}, next).first->second);
  }
  return products;
}

Error interrupted() { return {Code::cancelled, "interrupted; there is no result"}; }

}  // namespace impinge::report
