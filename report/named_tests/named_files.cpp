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

class FileAdder {
 public:
  FileAdder(const Configuration& configuration, ReportOptions& options)
      : configuration_(configuration), options_(options) {}

  Result<void> add(const NamedFile& file) {
    const fs::path place = from_folder(configuration_, file.file.text);
    auto known = std::find_if(options_.files.begin(), options_.files.end(),
                              [&](const std::string& other) { return is_same_file(place, other); });
    if (known == options_.files.end()) {
      if (auto added = add_new(file.file); !added) return added;
      known = options_.files.end() - 1;
    }
    if (!file.scale) return {};
    for (const auto& [scaled, factor] : options_.scales)
      if (scaled == *known)
        return configuration_.error_at(file.file.place, fmt::format("'{}' has a scale already", printable(*known)));
    options_.scales.emplace_back(*known, *file.scale);
    return {};
  }

  Result<void> add_all_of(const Group& group) {
    for (const Word& word : group.files)
      if (!has_wildcard(word.text) && files_named(configuration_, word.text, options_.files).empty())
        if (auto added = add_new(word); !added) return added;
    return {};
  }

 private:
  Result<void> add_new(const Word& word) {
    const fs::path place = from_folder(configuration_, word.text);
    std::error_code unknown;
    if (!options_.skip_unreadable && !fs::exists(place, unknown))
      return configuration_.error_at(word.place, fmt::format("there is no file '{}'{}", printable(place.string()),
                                                             nearest_file(options_.files, word.text)));
    options_.files.push_back(place.string());
    return {};
  }

  const Configuration& configuration_;
  ReportOptions& options_;
};

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
  FileAdder adder(configuration, options);
  for (const NamedFile& file : configuration.files)
    if (auto added = adder.add(file); !added) return added;
  const auto add_all_of = [&](const Group& group) { return adder.add_all_of(group); };
  if (auto added = for_each_group(configuration, add_all_of); !added) return added;
  for (const auto& [file, factor] : asked)
    if (auto added = add_scale(configuration, file, factor, options); !added) return added;
  return {};
}

}  // namespace impinge::report
