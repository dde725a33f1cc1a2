// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/assembly.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "report/text.hpp"

namespace impinge::report {
namespace {

double scale_of(const SceneOptions& options, const std::string& file) {
  for (const auto& [name, factor] : options.scales)
    if (name == file) return factor;
  return 1;
}

}  // namespace

Assembly assemble(const std::vector<std::string>& files, std::vector<io::Model> models) {
  Assembly assembly;
  assembly.files = files;
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
    for (std::string& warning : models[i].warnings) assembly.warnings.push_back(std::move(warning));
    for (const std::string& sentence : models[i].missing) assembly.missing.push_back(files[i] + ": " + sentence);
  }
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
    read.stop = options.stop;
    Result<io::Model> model = io::read(file, read);
    if (options.stop.stop_requested()) return interrupted();
    if (!model) {
      if (!options.skip_unreadable || skipped.size() + 1 == options.files.size()) return model.error();
      skipped.push_back(file), missing.push_back("skipped: " + model.error().message);
      model = io::Model();
    }
    models.push_back(*std::move(model));
  }
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
