// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/assembly.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

#include "report/text.hpp"

namespace impinge::report {
namespace {

std::uint64_t bytes_of(const std::string& file) {
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(file, unknown);
  return unknown ? 0 : bytes;
}

double scale_of(const SceneArguments& arguments, const std::string& file) {
  for (const auto& [name, factor] : arguments.scales)
    if (name == file) return factor;
  return 1;
}

}  // namespace

Result<Assembly> read_assembly(const SceneArguments& arguments, ProgressLine& progress, const std::stop_token& stop) {
  std::uint64_t all_bytes = 0, bytes_read = 0;
  for (const std::string& file : arguments.files) all_bytes += bytes_of(file);

  Assembly assembly;
  assembly.files = arguments.files;
  for (std::size_t i = 0; i < arguments.files.size(); ++i) {
    const std::string& file = arguments.files[i];
    // Of a single file nobody knows how far it is read.
    constexpr double kMega = 1e6;
    const Work work = arguments.files.size() > 1
                          ? Work{static_cast<double>(bytes_read) / kMega, static_cast<double>(all_bytes) / kMega}
                          : Work();
    progress.phase(
        fmt::format("reading {} ({} of {})", printable(file), i + 1, arguments.files.size()), [work] { return work; },
        "MB");
    io::ReadOptions options;
    options.max_file_bytes = arguments.max_file_bytes;
    options.scale = scale_of(arguments, file);
    options.stop = stop;
    Result<io::Model> model = io::read(file, options);
    if (stop.stop_requested()) return interrupted();
    if (!model) return model.error();
    const auto groups_before = static_cast<std::uint32_t>(assembly.groups.size());
    for (io::Group& group : model->groups) {
      if (group.parent) *group.parent += groups_before;
      assembly.groups.push_back(std::move(group));
    }
    for (io::Object& object : model->objects) {
      if (object.group) *object.group += groups_before;
      assembly.triangles += object.mesh.triangle_count();
      assembly.file_of.push_back(static_cast<std::uint32_t>(i));
      assembly.objects.push_back(std::move(object));
    }
    for (std::string& warning : model->warnings) assembly.warnings.push_back(std::move(warning));
    for (const std::string& sentence : model->missing) assembly.missing.push_back(file + ": " + sentence);
    bytes_read += bytes_of(file);
  }
  assembly.labels = labels_of(assembly);
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
