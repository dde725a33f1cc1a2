// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "impinge/result.hpp"
#include "io/text.hpp"

namespace impinge::io {

/// Whether there is a regular file that may be read, not empty and at most so large; nothing of it is read.
/// Errors: `bad_file`.
Result<void> check_file(const std::filesystem::path& file, std::uint64_t max_bytes, const Source& source);

/// The file's bytes, with the same checks. Copied, not mapped: a mapped file that another program cuts short ends this
/// one. Errors: `bad_file`.
Result<std::string> read_file(const std::filesystem::path& file, std::uint64_t max_bytes, const Source& source);

}  // namespace impinge::io
