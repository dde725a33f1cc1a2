// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "frame_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>

#include "numbers.hpp"

namespace impinge::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDigits = "0123456789";

/// A name around one number.
struct Numbered {
  std::string before, after;
  std::string digits;
};

/// Behind the folders; npos + 1 is 0.
std::size_t start_of_name(const std::string& file) { return file.rfind('/') + 1; }

/// By the last number of the file's name, the folder and the ending aside; nothing without one.
std::optional<Numbered> numbered(const std::string& name) {
  const std::size_t folder = start_of_name(name);
  const std::size_t dot = name.rfind('.');
  const std::size_t end = dot == std::string::npos || dot <= folder ? name.size() : dot;
  const std::size_t last = name.find_last_of(kDigits, end - (end > 0 ? 1 : 0));
  if (last == std::string::npos || last < folder) return {};
  const std::size_t other = name.find_last_not_of(kDigits, last);
  const std::size_t first = std::max(other == std::string::npos ? 0 : other + 1, folder);
  return Numbered{name.substr(0, first), name.substr(last + 1), name.substr(first, last + 1 - first)};
}

Error bad_option(std::string sentence) { return {Code::bad_option, std::move(sentence)}; }

Result<std::vector<std::string>> files_of(const std::string& pattern) {
  const std::size_t first = pattern.find('#', start_of_name(pattern));
  const std::size_t end = std::min(pattern.find_first_not_of('#', first), pattern.size());
  if (pattern.find('#', end) != std::string::npos)
    return bad_option(fmt::format(
        "{}: a sequence has one number, in the name of the file: write # for its digits once, as in frame_####.ply",
        pattern));
  const fs::path folder = fs::path(pattern).parent_path();
  const std::string before = fs::path(pattern.substr(0, first)).filename().native();
  const std::string after = pattern.substr(end);
  std::map<std::uint64_t, std::string> found;
  std::error_code unknown;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, unknown), none; !unknown && entry != none;
       entry.increment(unknown)) {
    const std::string name = entry->path().filename().native();
    if (!name.starts_with(before) || !name.ends_with(after) || name.size() < before.size() + after.size() + end - first)
      continue;
    const std::string digits = name.substr(before.size(), name.size() - before.size() - after.size());
    const auto number = parse_number<std::uint64_t>(digits);
    // Written as a number of this width is: 0010 for ####, and 10000.
    if (number && digits == fmt::format("{:0{}}", *number, end - first))
      found.emplace(*number, (folder / name).native());
  }
  if (unknown)
    return Error{Code::bad_file, fmt::format("{}: its folder cannot be listed: {}", pattern, unknown.message())};
  std::vector<std::string> files;
  for (const auto& [number, name] : found) {
    const std::uint64_t expected = found.begin()->first + files.size();
    if (number != expected)
      return Error{Code::bad_file,
                   fmt::format("{}{:0{}}{} is missing: after {} comes {}; a sequence of states needs "
                               "every number from its first to its last",
                               pattern.substr(0, first), expected, end - first, after, files.back(), name)};
    files.push_back(name);
  }
  if (files.size() < 2)
    return Error{
        Code::bad_file,
        fmt::format("{}: {} of that name, and a sequence needs two or more, with a digit for each #, as {}{:0{}}{}",
                    pattern, files.empty() ? "there is no file" : "there is one file", pattern.substr(0, first), 1,
                    end - first, after)};
  return files;
}

/// Of names that differ in one number alone, whether it goes on evenly.
Result<void> check_numbers(const std::vector<std::string>& files) {
  std::vector<double> numbers;
  const std::optional<Numbered> first = numbered(files.front());
  for (const std::string& file : files) {
    const std::optional<Numbered> each = numbered(file);
    if (!first || !each || each->before != first->before || each->after != first->after) return {};
    const auto number = parse_number<double>(each->digits);
    if (!number) return {};
    numbers.push_back(*number);
  }
  for (std::size_t i = 2; i < files.size(); ++i)
    if (numbers[i] - numbers[i - 1] != numbers[1] - numbers[0])
      return bad_option(fmt::format(
          "{} does not follow {} as {} follows {}: a file is missing, or they are not in order; {}{}{} stands for all "
          "of them in order of their numbers",
          files[i], files[i - 1], files[1], files[0], first->before, std::string(first->digits.size(), '#'),
          first->after));
  return {};
}

}  // namespace

Result<std::vector<std::string>> frame_files(const std::vector<std::string>& given) {
  std::error_code unknown;
  for (const std::string& file : given) {
    if (fs::is_directory(file, unknown))
      return Error{Code::bad_file, fmt::format("{} is a folder; name the files in it, as {}", file,
                                               (fs::path(file) / "frame_####.ply").native())};
    if (file.find('#', start_of_name(file)) == std::string::npos || fs::exists(file, unknown)) continue;
    if (given.size() == 1) return files_of(file);
    return bad_option(fmt::format("{} stands for a sequence, which is given alone", file));
  }
  if (given.size() < 2)
    return bad_option(fmt::format(
        "{} is one state, and nothing moves in it; name a second file, or a sequence such as frame_####.ply",
        given.front()));
  if (auto even = check_numbers(given); !even) return even.error();
  return given;
}

}  // namespace impinge::cli
