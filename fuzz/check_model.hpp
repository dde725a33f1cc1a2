// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>

#include "impinge/io.hpp"

namespace impinge::fuzz {

/// Aborts unless a reader's result is what it promises: objects with triangles and names of their own, or a sentence
/// that begins with the file's name.
inline void check(const Result<io::Model>& result, std::string_view file) {
  if (!result) {
    if (result.error().code != Code::bad_file || !result.error().message.starts_with(file)) std::abort();
    return;
  }
  if (result->objects.empty()) std::abort();
  std::set<std::string_view> names;
  for (const io::Object& object : result->objects) {
    if (object.mesh.triangle_count() == 0 || !names.insert(object.name).second) std::abort();
    for (const auto& triangle : object.mesh.triangles()) {
      for (const std::uint32_t corner : triangle) {
        if (corner >= object.mesh.vertex_count()) std::abort();
      }
    }
  }
}

}  // namespace impinge::fuzz
