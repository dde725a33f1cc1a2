// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/comparison/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "documents.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// No place, or no file there, has none.
bool holds_remarks(const std::optional<std::string>& name) {
  std::error_code unknown;
  if (!name || *name == "-" || !std::filesystem::is_regular_file(*name, unknown)) return false;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name->c_str(), "rb"), &std::fclose);
  if (file == nullptr) return false;
  RemarkSearch search;
  std::vector<char> piece(1 << 16);
  while (const std::size_t count = std::fread(piece.data(), 1, piece.size(), file.get()))
    if (search.look({piece.data(), count})) return true;
  return false;
}

/// The character of a number in hexadecimal digits; one that is no letter if that is no ASCII.
char ascii_of(const std::string& digits) {
  unsigned code = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
  return error == std::errc() && code < 0x80 ? static_cast<char>(code) : '\\';
}

/// What was written about what: the id of a pair or region, status and comment.
using Remarks = std::set<std::tuple<std::string, std::string, std::string>>;

void add(const std::string& id, const Remark& remark, Remarks& to) {
  if (!remark.is_empty()) to.emplace(id, remark.status, remark.comment);
}

Remarks remarks_of(const Previous& report) {
  Remarks remarks;
  for (const Previous::Pair& pair : report.pairs) {
    add(pair.id, pair.remark, remarks);
    for (const Previous::OldRegion& region : pair.regions) add(region.id, region.remark, remarks);
  }
  for (const Resolved& resolved : report.resolved) {
    add(resolved.region.empty() ? resolved.id : resolved.region, resolved.remark, remarks);
    for (const Resolved& region : resolved.regions) add(region.region, region.remark, remarks);
  }
  return remarks;
}

Error would_lose(const std::string& name, std::string_view mend) {
  return {Code::bad_file,
          fmt::format("'{}' holds a status or comment that somebody wrote and that this run would lose, "
                      "so it is not replaced; {}",
                      printable(name), mend)};
}

}  // namespace

bool RemarkSearch::look(std::string_view piece) {
  for (std::size_t i = 0; i < piece.size(); ++i) {
    // Most of a report is numbers: only a text matters from here.
    if (at_ == At::outside && text_.empty()) i = piece.find('"', i);
    if (i == std::string_view::npos) return false;
    if (step(piece[i])) return true;
  }
  return false;
}

void RemarkSearch::add(char c) {
  constexpr std::size_t kEnough = 8;  // tells both keys from any other
  if (text_.size() < kEnough) text_ += c;
}

bool RemarkSearch::step(char c) {
  switch (at_) {
    case At::outside:
      if (is_blank(c)) return false;
      if (c == '"') at_ = At::text;
      if (c == ':' && (text_ == "status" || text_ == "comment")) at_ = At::value;
      text_.clear();
      return false;
    case At::text:
      if (c == '"') {
        at_ = At::outside;
      } else {
        if (c == '\\') at_ = At::escape;
        if (c != '\\') add(c);
      }
      return false;
    case At::escape:
      at_ = c == 'u' ? At::code : At::text;
      code_.clear();
      if (c != 'u') add('\\');  // no letter is written so
      return false;
    case At::code:
      code_ += c;
      if (code_.size() < 4) return false;
      at_ = At::text;
      add(ascii_of(code_));
      return false;
    case At::value:
      if (is_blank(c)) return false;
      at_ = c == '"' ? At::remark : At::outside;
      return c != '"' && c != 'n';  // null; what is no text at all, somebody wrote as well
    case At::remark:
      at_ = At::outside;
      return c != '"';
  }
  return false;
}

Result<void> keep_remarks(const std::optional<std::string>& json) {
  if (holds_remarks(json)) return would_lose(*json, "let --json name another file");
  return {};
}

Result<void> keep_remarks(const ClashArguments& arguments, const Previous& previous) {
  if (arguments.json && arguments.previous && is_one_place(*arguments.json, *arguments.previous)) return {};
  if (!holds_remarks(arguments.json)) return {};
  if (arguments.previous) {
    const Result<Previous> old = read_previous(*arguments.json, arguments.max_file_bytes);
    if (old) {
      const Remarks theirs = remarks_of(*old), known = remarks_of(previous);
      if (std::includes(known.begin(), known.end(), theirs.begin(), theirs.end())) return {};
    }
  }
  return would_lose(*arguments.json, fmt::format("--previous {} takes it over, or let --json name another file",
                                                 printable(*arguments.json)));
}

}  // namespace impinge::report
