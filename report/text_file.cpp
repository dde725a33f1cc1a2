// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/text_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "report/text.hpp"

namespace impinge::report {

Result<std::string> read_text_file(const std::string& name, std::uint64_t most_bytes) {
  const auto bad = [&](const std::string& why) {
    return Error{Code::bad_file, fmt::format("{} cannot be read: {}", printable(name), why)};
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name.c_str(), "rb"), &std::fclose);
  if (file == nullptr) return bad(std::strerror(errno));
  std::string text;
  // Not by the size that the system tells: a pipe has none.
  char buffer[1 << 16];
  while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file.get())) {
    text.append(buffer, count);
    if (text.size() > most_bytes) return bad(fmt::format("it is larger than {} bytes", grouped(most_bytes)));
  }
  if (std::ferror(file.get()) != 0) return bad(std::strerror(errno));
  return text;
}

}  // namespace impinge::report
