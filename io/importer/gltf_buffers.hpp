// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace impinge::importer {

/// The numbers that accessors of a glTF file (1 or 2) hold, from its own binary chunk, files beside it or base64.
class GltfBuffers {
 public:
  /// Both outlive this.
  GltfBuffers(const char* file, const nlohmann::json& root);

  /// All numbers of an accessor with so many components an element; none if it is not such a one, or not all there.
  std::vector<double> read(const nlohmann::json& accessor, std::size_t components);

 private:
  /// The bytes of a buffer; each is read once.
  const std::string& bytes_of(const nlohmann::json& buffer);
  [[nodiscard]] std::string load(const nlohmann::json& buffer) const;
  [[nodiscard]] std::string binary_chunk() const;

  std::filesystem::path file_;
  const nlohmann::json& root_;
  std::map<const nlohmann::json*, std::string> loaded_;
};

}  // namespace impinge::importer
