// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

struct aiScene;

/// Parts that a file shows in another shape than their meshes have: bones and morph targets are not applied.
namespace impinge::importer {

/// Some parts that have something in common.
struct SomeParts {
  std::uint64_t count = 0;
  std::string first;  ///< its name

  void add(std::string_view name) {
    if (count++ == 0) first = name;
  }
};

/// Those that bones bend which are not where they were bound.
SomeParts bent_parts(const aiScene& scene);

/// Of nodes that their file hides.
std::string hidden_sentence(const SomeParts& nodes);

std::string reshaped_sentence(const SomeParts& parts, std::string_view by_what, std::string_view mend);

}  // namespace impinge::importer
