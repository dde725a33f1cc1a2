// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string_view>
#include <system_error>
#include <utility>

#include "report/conventions.hpp"
#include "report/share.hpp"
#include "report/text.hpp"
#include "report/units.hpp"

namespace impinge::report {
namespace {

std::optional<double> scale_of(const SceneOptions& options, const std::string& file) {
  for (const auto& [name, factor] : options.scales)
    if (name == file) return factor;
  return std::nullopt;
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

/// Turns the models of files whose format says that another axis is up than in the first one's, read or
/// skipped, so that places stay from run to run; and says so.
std::vector<std::string> bring_to_first_axes(const std::vector<std::string>& files, std::vector<io::Model>& models) {
  std::vector<std::string> sentences;
  std::optional<bool> first;
  std::string first_file;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::optional<bool> is_y_up = has_y_up(files[i]);
    if (!first) first = is_y_up, first_file = files[i];
    if (!is_y_up || is_y_up == first || models[i].objects.empty()) continue;  // empty: or skipped
    for (io::Object& object : models[i].objects) object.pose = turned(object.pose, *first);
    for (io::Grid& grid : models[i].grids)
      for (io::GridAxis& axis : grid.axes)
        for (Point& p : axis.points) {
          const auto& t = turned(Pose{.t = {p.x, p.y, p.z}}, *first).t;
          p = {t[0], t[1], t[2]};
        }
    sentences.push_back(fmt::format("{} was turned so that {} is up, as in {}", printable(files[i]), *first ? 'Y' : 'Z',
                                    printable(first_file)));
  }
  return sentences;
}

Bounds bounds_of(const io::Model& model) {
  Bounds bounds;
  for (const io::Object& object : model.objects)
    for (const Point& vertex : object.mesh.vertices()) bounds.add(world_vertex(object.pose, vertex));
  return bounds;
}

/// What is said of units where some file does not tell its own.
std::vector<std::string> check_units(const SceneOptions& options, const std::vector<io::Model>& models,
                                     const std::optional<double>& unit) {
  std::vector<FileUnit> units;
  for (std::size_t i = 0; i < models.size(); ++i)
    if (!models[i].objects.empty())  // or else it was skipped
      units.push_back({options.files[i], models[i].unit_in_metres || scale_of(options, options.files[i]), {}});
  if (units.size() < 2 || std::ranges::all_of(units, &FileUnit::is_known)) return {};
  auto next = units.begin();
  for (const io::Model& model : models)
    if (!model.objects.empty()) (next++)->box = bounds_of(model);
  return unit_warnings(units, unit);
}

/// The models, each in its own unit. After an error that is not skipped later files may be `cancelled`, but none
/// before.
std::vector<Result<io::Model>> read_files(const SceneOptions& options, const FileProgress& progress) {
  const std::size_t count = options.files.size();
  std::vector<Result<io::Model>> readings(count, interrupted());
  std::vector<std::stop_source> stops(count);
  const auto stop_from = [&](std::size_t first) {
    for (std::size_t i = first; i < count; ++i) stops[i].request_stop();
  };
  const std::stop_callback stop_all(options.stop, [&] { stop_from(0); });
  std::mutex one_call;
  share(count, options.threads, [&](std::size_t i) {
    const auto tell = [&](bool is_read) {
      const std::scoped_lock lock(one_call);
      progress(i, is_read);
    };
    if (stops[i].stop_requested()) return;
    tell(false);
    io::ReadOptions read;
    read.max_file_bytes = options.max_file_bytes;
    read.scale = scale_of(options, options.files[i]).value_or(1);
    read.property_sets = options.property_sets;
    read.stop = stops[i].get_token();
    readings[i] = io::read(options.files[i], read);
    if (!readings[i] && !options.skip_unreadable) stop_from(i + 1);
    tell(true);
  });
  return readings;
}

/// Says so of every file, of many the first ones.
Error none_is_readable(const std::vector<Result<io::Model>>& readings) {
  constexpr std::size_t kMostNamed = 10;
  std::string text = fmt::format("none of the {} files can be read", readings.size());
  for (std::size_t i = 0; i < std::min(readings.size(), kMostNamed); ++i)
    text += fmt::format("{} {}", i == 0 ? ':' : ';', readings[i].error().message);
  if (readings.size() > kMostNamed) text += fmt::format("; and {} more", readings.size() - kMostNamed);
  return {readings.front().error().code, text};
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
    for (io::Grid& grid : models[i].grids) assembly.grids.push_back(std::move(grid));
    if (!assembly.unit_in_metres) assembly.unit_in_metres = models[i].unit_in_metres;
    for (std::string& warning : models[i].warnings) assembly.warnings.push_back(std::move(warning));
    for (const std::string& sentence : models[i].missing) assembly.missing.push_back(files[i] + ": " + sentence);
  }
  assembly.labels = labels_of(assembly);
  return assembly;
}

Result<Assembly> read_assembly(const SceneOptions& options, const FileProgress& progress) {
  std::vector<Result<io::Model>> readings = read_files(options, progress);
  if (options.stop.stop_requested()) return interrupted();
  std::optional<double> unit = options.unit_in_metres;
  for (const Result<io::Model>& model : readings)
    if (!unit && model) unit = model->unit_in_metres;
  if (unit)
    share(readings.size(), options.threads, [&](std::size_t i) {
      if (!readings[i]) return;
      if (const auto brought = io::bring_to_unit(*readings[i], *unit, options.files[i]); !brought)
        readings[i] = brought.error();
    });
  if (options.skip_unreadable && readings.size() > 1 && std::ranges::none_of(readings, &Result<io::Model>::has_value))
    return none_is_readable(readings);
  std::vector<io::Model> models;
  std::vector<std::string> skipped, missing;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!readings[i]) {
      const Error& error = readings[i].error();
      if (!options.skip_unreadable || readings.size() == 1) return error;
      skipped.push_back(options.files[i]), missing.push_back("skipped: " + error.message);
    }
    models.push_back(readings[i] ? *std::move(readings[i]) : io::Model());
  }
  std::vector<std::string> alignment = bring_to_first_axes(options.files, models);
  for (std::string& warning : check_units(options, models, unit)) alignment.push_back(std::move(warning));
  Assembly assembly = assemble(options.files, std::move(models));
  assembly.unit_in_metres = unit;
  assembly.alignment = std::move(alignment);
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

std::string_view property_of(const io::Object& object, std::string_view property) {
  for (const auto& [name, value] : object.properties)
    if (name == property) return value;
  return {};
}

Error with_skipped(Error error, const Assembly& assembly) {
  if (assembly.skipped.empty()) return error;
  error.message += "; " + assembly.missing[assembly.missing.size() - assembly.skipped.size()];
  if (const std::size_t others = assembly.skipped.size() - 1; others > 0)
    error.message += fmt::format(" (and {})", counted(others, "other file"));
  return error;
}

Error with_label(Error error, const Assembly& assembly) {
  constexpr std::string_view kObject = "object ";
  if (!error.message.starts_with(kObject)) return error;
  std::size_t object = assembly.labels.size();
  const char* const number = error.message.data() + kObject.size();
  const auto read = std::from_chars(number, error.message.data() + error.message.size(), object);
  if (read.ec == std::errc() && object < assembly.labels.size())
    error.message.replace(0, static_cast<std::size_t>(read.ptr - error.message.data()),
                          fmt::format("'{}'", assembly.labels[object]));
  return error;
}

Error interrupted() { return {Code::cancelled, "interrupted; there is no result"}; }

}  // namespace impinge::report
