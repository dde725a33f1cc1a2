// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "report/named_tests/configuration.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

namespace fs = std::filesystem;

fs::path from_folder(const Configuration& configuration, const std::string& word) {
  return (fs::path(configuration.name).parent_path() / word).lexically_normal();
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code unknown;
  return a.lexically_normal() == b.lexically_normal() || fs::equivalent(a, b, unknown);
}

bool has_wildcard(const std::string& word) { return word.find_first_of("*?") != std::string::npos; }

std::string nearest_file(const std::vector<std::string>& files, const std::string& word) {
  const auto distance = [&](const std::string& file) {
    return edit_distance(fs::path(word).filename().string(), fs::path(file).filename().string());
  };
  const auto nearest = std::min_element(files.begin(), files.end(), [&](const std::string& a, const std::string& b) {
    return distance(a) < distance(b);
  });
  return nearest == files.end() ? "" : fmt::format("; the nearest name is '{}'", printable(*nearest));
}

/// Adds a file that is not among those to read. Errors: `bad_file` (there is none).
Result<void> add_new(const Configuration& configuration, const Word& word, ReportOptions& options) {
  const fs::path place = from_folder(configuration, word.text);
  std::error_code unknown;
  if (!options.skip_unreadable && !fs::exists(place, unknown))
    return configuration.error_at(word.place, fmt::format("there is no file '{}'{}", printable(place.string()),
                                                          nearest_file(options.files, word.text)));
  options.files.push_back(place.string());
  return {};
}

Result<void> add(const Configuration& configuration, const NamedFile& file, ReportOptions& options) {
  const fs::path place = from_folder(configuration, file.file.text);
  const auto is_it = [&](const std::string& other) { return is_same_file(place, other); };
  auto known = std::ranges::find_if(options.files, is_it);
  if (known == options.files.end()) {
    if (auto added = add_new(configuration, file.file, options); !added) return added;
    known = options.files.end() - 1;
  }
  if (!file.scale) return {};
  for (const auto& [scaled, factor] : options.scales)
    if (scaled == *known)
      return configuration.error_at(file.file.place, fmt::format("'{}' has a scale already", printable(*known)));
  options.scales.emplace_back(*known, *file.scale);
  return {};
}

/// `--scale FILE=S`, where FILE is one on the command line or in the configuration, as either of them writes it.
Result<void> add_scale(const Configuration& configuration, const std::string& file, double factor,
                       ReportOptions& options) {
  const auto bad = [&](const std::string& what) {
    return Error{Code::bad_option, fmt::format("--scale {}={}: {}", printable(file), factor, what)};
  };
  auto known = std::find(options.files.begin(), options.files.end(), file);
  if (known == options.files.end())
    known = std::find_if(options.files.begin(), options.files.end(), [&](const std::string& other) {
      return is_same_file(file, other) || is_same_file(from_folder(configuration, file), other);
    });
  if (known == options.files.end())
    return bad(fmt::format("it is none of the files to read, on the command line or in {}{}",
                           printable(configuration.name), nearest_file(options.files, file)));
  for (const auto& [scaled, other] : options.scales)
    if (scaled == *known)
      return bad(fmt::format("this file has a scale already, {}, here or in {}; leave one out", other,
                             printable(configuration.name)));
  options.scales.emplace_back(*known, factor);
  return {};
}

}  // namespace

std::vector<std::uint32_t> files_named(const Configuration& configuration, const std::string& word,
                                       const std::vector<std::string>& files) {
  const auto all_where = [&](auto says) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < files.size(); ++i)
      if (says(files[i])) found.push_back(i);
    return found;
  };
  const fs::path place = from_folder(configuration, word);
  auto found = all_where([&](const std::string& file) { return is_same_file(place, file); });
  if (found.empty())
    found = all_where([&](const std::string& file) { return file == word || fs::path(file).filename() == word; });
  if (found.empty() && has_wildcard(word))
    found = all_where([&](const std::string& file) {
      return matches_pattern(word, file) ||
             matches_pattern(place.string(), fs::path(file).lexically_normal().string()) ||
             matches_pattern(word, fs::path(file).filename().string());
    });
  return found;
}

Result<void> add_files(const Configuration& configuration, ReportOptions& options) {
  const std::vector<std::pair<std::string, double>> asked = std::exchange(options.scales, {});
  for (const NamedFile& file : configuration.files)
    if (auto added = add(configuration, file, options); !added) return added;
  for (const Group* const group : groups_in(configuration))
    for (const Word& word : group->files)
      if (!has_wildcard(word.text) && files_named(configuration, word.text, options.files).empty())
        if (auto added = add_new(configuration, word, options); !added) return added;
  for (const auto& [file, factor] : asked)
    if (auto added = add_scale(configuration, file, factor, options); !added) return added;
  return {};
}

}  // namespace impinge::report
