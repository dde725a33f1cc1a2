// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene_command.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "ignore.hpp"
#include "report/text.hpp"

namespace impinge::cli {

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Result<Scene> scene_of(const Assembly& assembly, const SceneArguments& arguments,
                       std::span<const std::uint32_t> groups) {
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
  if (auto ignored = ignore_pairs(assembly, arguments.ignored, ids, scene); !ignored) return ignored.error();
  if (auto updated = scene.update(); !updated) return updated.error();
  return scene;
}

Work work_of(const Progress& progress) {
  return {static_cast<double>(progress.done.load()), static_cast<double>(progress.total.load())};
}

void mention_missing(const Assembly& assembly) {
  for (const std::string& sentence : assembly.missing) complain(sentence);
}

void mention_warnings(const Assembly& assembly) {
  if (assembly.warnings.empty()) return;
  complain(fmt::format("{} about these files, listed by impinge info", counted(assembly.warnings.size(), "warning")));
}

}  // namespace impinge::cli
