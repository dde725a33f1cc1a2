// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "numbers.hpp"

namespace impinge::cli {
namespace {

Result<void> take_scales(const std::vector<std::string>& raw, SceneArguments& to, bool may_name_others) {
  for (const std::string& text : raw) {
    const std::size_t at = text.rfind('=');
    if (at == std::string::npos)
      return bad_option(fmt::format("--scale takes FILE=S, such as plate.stl=25.4, not '{}'", text));
    const std::string file = text.substr(0, at);
    const auto factor = parse_positive(std::string_view(text).substr(at + 1));
    if (!factor)
      return bad_option(
          fmt::format("--scale {}: '{}' is not a positive number such as 25.4", text, text.substr(at + 1)));
    // A configuration may name it, which is read later.
    if (!may_name_others && std::find(to.files.begin(), to.files.end(), file) == to.files.end())
      return bad_option(
          fmt::format("--scale {}: '{}' is none of the files to read; write it as it stands among them", text, file));
    for (const auto& [other, _] : to.scales)
      if (other == file) return bad_option(fmt::format("--scale is given twice for '{}'", file));
    to.scales.emplace_back(file, *factor);
  }
  return {};
}

}  // namespace

Result<void> take_max_file(const std::string& text, std::uint64_t& to) {
  if (text.empty()) return {};
  const auto bytes = parse_bytes(text);
  if (!bytes) return bad_option(fmt::format("--max-file takes a number of bytes such as 500M or 2G, not '{}'", text));
  to = *bytes;
  return {};
}

Result<void> take_limit(const std::string& text, std::uint64_t& to) {
  if (text.empty()) return {};
  const auto limit = parse_whole(text);
  if (!limit) return bad_option(fmt::format("--limit takes a whole number from 0 up, not '{}'", text));
  to = *limit;
  return {};
}

Result<void> take_threads(const std::string& text, int& to) {
  if (text.empty()) return {};
  const auto threads = parse_whole(text);
  if (!threads || *threads > 1024)
    return bad_option(fmt::format("--threads takes a whole number from 0 to 1024, not '{}'", text));
  to = static_cast<int>(*threads);
  return {};
}

Result<void> take_page(const Raw& raw, PageArguments& to) {
  if (!raw.html.empty()) to.html = raw.html;
  if (!raw.up.empty() && raw.up != "y" && raw.up != "z")
    return bad_option(fmt::format("--up is y or z, not '{}'", raw.up));
  if (!raw.up.empty()) to.y_up = raw.up == "y";
  if (raw.page_triangles.empty()) return {};
  const auto triangles = parse_whole(raw.page_triangles);
  if (!triangles)
    return bad_option(fmt::format("--page-triangles takes a whole number from 0 up, not '{}'", raw.page_triangles));
  if (!to.html) return bad_option("--page-triangles is for the page: name its file with --html FILE");
  to.page_triangles = *triangles;
  return {};
}

Result<void> take_scene(const Raw& raw, SceneArguments& to) {
  if (!raw.json.empty()) to.json = raw.json;
  for (std::size_t i = 0; i + 1 < raw.ignored.size(); i += 2)
    to.ignored.emplace_back(raw.ignored[i], raw.ignored[i + 1]);
  if (auto taken = take_scales(raw.scales, to, !raw.config.empty()); !taken) return taken;
  return take_max_file(raw.max_file, to.max_file_bytes);
}

}  // namespace impinge::cli
