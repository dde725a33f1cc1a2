// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "impinge/result.hpp"
#include "io/text.hpp"

namespace impinge::io {

/// A whole file in memory. Copied, not mapped: a mapped file that another program cuts short ends this one.
class FileBytes {
 public:
  explicit FileBytes(std::size_t capacity) : bytes_(std::make_unique_for_overwrite<char[]>(capacity)) {}
  [[nodiscard]] char* data() { return bytes_.get(); }
  void set_size(std::size_t size) { size_ = size; }
  [[nodiscard]] std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// Whether there is a regular file that may be read, not empty and at most so large; nothing of it is read.
/// Errors: `bad_file`.
Result<void> check_file(const std::filesystem::path& file, std::uint64_t max_bytes, const Source& source);

/// The file's bytes, with the same checks. Errors: `bad_file`.
Result<FileBytes> read_file(const std::filesystem::path& file, std::uint64_t max_bytes, const Source& source);

}  // namespace impinge::io
