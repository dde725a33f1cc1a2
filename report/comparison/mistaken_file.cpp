// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/comparison/mistaken_file.hpp"

#include <fmt/format.h>

#include "report/sink.hpp"

namespace impinge::report {

std::string what_it_is_instead(std::string_view text) {
  constexpr std::size_t kHead = 256;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return "it is empty";
  if (text[first] == '{' || text[first] == '[') return {};
  for (const DocumentKind* kind : {&kPage, &kCsv, &kBcf, &kGltf})
    if (kind->begins_one(text.substr(0, kHead)))
      return fmt::format("it is a {}, as {} writes it", kind->noun, kind->option);
  return "it is no JSON object";
}

bool is_gltf(const std::set<std::string>& keys) { return keys.contains("asset"); }

}  // namespace impinge::report
