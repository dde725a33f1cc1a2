// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "report/assembly.hpp"
#include "report/named_tests/ifc_classes.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

constexpr std::array<std::string_view, 3> kKinds{"class:", "file:", "storey:"};

/// The objects of a class with what is derived from it, or whose file or storey a pattern describes.
Result<std::vector<std::uint32_t>> objects_of(const Assembly& assembly, std::string_view kind, std::string_view word) {
  const bool by_class = kind == kKinds[0], by_file = kind == kKinds[1];
  std::set<std::string> known;
  std::vector<std::uint32_t> found;
  const auto look_at = [&](std::uint32_t object, const std::string& text) {
    known.insert(text);
    if (by_class ? is_of_ifc_class(text, word) : matches_pattern(word, text)) found.push_back(object);
  };
  for (std::uint32_t i = 0; i < assembly.objects.size(); ++i) {
    const io::Object& object = assembly.objects[i];
    const std::filesystem::path file = assembly.files[assembly.file_of[i]];
    if (by_file) look_at(i, matches_pattern(word, file.string()) ? file.string() : file.filename().string());
    for (const auto& [name, value] : object.properties)
      if (!by_file && name == kind.substr(0, kind.size() - 1)) look_at(i, value);
  }
  if (!found.empty()) return found;
  return Error{Code::bad_option,
               fmt::format("no part is of '{}{}'{}", kind, word,
                           known.empty() ? "; only IFC files say this"
                                         : fmt::format("; the nearest is '{}{}'", kind, nearest_text(word, known)))};
}

}  // namespace

Result<std::vector<std::uint32_t>> objects_named(const Assembly& assembly, std::string_view word) {
  const auto all_where = [&](auto says) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < assembly.objects.size(); ++i)
      if (says(assembly.objects[i].name) || says(assembly.labels[i])) found.push_back(i);
    return found;
  };
  std::vector<std::uint32_t> found = all_where([&](std::string_view name) { return name == word; });
  if (found.empty())
    if (const auto kind = std::ranges::find_if(kKinds, [&](auto begin) { return word.starts_with(begin); });
        kind != kKinds.end())
      return objects_of(assembly, *kind, word.substr(kind->size()));
  if (found.empty() && word.find_first_of("*?") != std::string_view::npos)
    found = all_where([&](std::string_view name) { return matches_pattern(word, name); });
  if (!found.empty()) return found;
  if (assembly.objects.empty())
    return Error{Code::bad_option, fmt::format("nothing is named '{}'; the files hold no objects", word)};
  return Error{Code::bad_option, fmt::format("nothing is named '{}'; the nearest name is '{}'", word,
                                             nearest_text(word, assembly.labels))};
}

namespace {

// A scene keeps ignored pairs one by one. Ten million take about half a gigabyte.
constexpr std::uint64_t kMostPairs = 10'000'000;

/// Leaves out of the scene every pair that `ignored` names; `ids` are the scene's ids of the assembly's objects.
Result<void> ignore_pairs(const Assembly& assembly, std::span<const std::pair<std::string, std::string>> ignored,
                          std::span<const ObjectId> ids, Scene& scene) {
  std::uint64_t total = 0;
  for (const auto& [a, b] : ignored) {
    const auto first = objects_named(assembly, a);
    if (!first) return Error{first.error().code, "--ignore: " + first.error().message};
    const auto second = objects_named(assembly, b);
    if (!second) return Error{second.error().code, "--ignore: " + second.error().message};
    total += std::uint64_t{first->size()} * second->size();
    if (total > kMostPairs)
      return Error{Code::bad_option,
                   fmt::format("--ignore '{}' '{}' names too many pairs of objects: at most {} can be "
                               "left out",
                               a, b, grouped(kMostPairs))};
    bool any = false;
    for (const std::uint32_t x : *first)
      for (const std::uint32_t y : *second) {
        if (x == y) continue;
        any = true;
        if (auto left_out = scene.ignore(ids[x], ids[y]); !left_out) return left_out.error();
      }
    if (!any)
      return Error{Code::bad_option, fmt::format("--ignore '{}' '{}' names only one object, and leaves out pairs "
                                                 "of two",
                                                 a, b)};
  }
  return {};
}

}  // namespace

Result<Scene> scene_of(const Assembly& assembly, const SceneOptions& options, std::span<const std::uint32_t> groups) {
  Scene scene;
  std::vector<ObjectId> ids;
  ids.reserve(assembly.objects.size());
  for (std::size_t i = 0; i < assembly.objects.size(); ++i) {
    const io::Object& object = assembly.objects[i];
    Result<ObjectId> id = scene.add(object.mesh, object.pose, groups.empty() ? 0 : groups[i]);
    if (!id)
      return Error{id.error().code, fmt::format("{}: object '{}': {}", assembly.files[assembly.file_of[i]],
                                                assembly.labels[i], id.error().message)};
    ids.push_back(*id);
  }
  if (auto ignored = ignore_pairs(assembly, options.ignored, ids, scene); !ignored)
    return with_skipped(ignored.error(), assembly);
  if (auto updated = scene.update(); !updated) return updated.error();
  return scene;
}

}  // namespace impinge::report
