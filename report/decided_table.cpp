// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <vector>

#include "report/decisions.hpp"
#include "report/json_file.hpp"
#include "report/text.hpp"
#include "report/writers.hpp"

namespace impinge::report {
namespace {

/// A table as spreadsheets save it (RFC 4180), with commas, semicolons or tabs between the cells.
class Table {
 public:
  struct Row {
    std::size_t line = 0;
    std::vector<std::string> cells;
  };

  explicit Table(std::string_view text) : text_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF", kSeparators = ";\t";
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
    const std::string_view header = text_.substr(0, text_.find_first_of("\r\n"));
    for (const char c : kSeparators)
      if (std::count(header.begin(), header.end(), c) > std::count(header.begin(), header.end(), separator_))
        separator_ = c;
  }

  /// Nothing at the end. A quote that nobody closes goes on to the end.
  std::optional<Row> next() {
    if (at_ >= text_.size()) return std::nullopt;
    Row row{line_, {}};
    std::string cell;
    bool is_quoted = false;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      line_ += c == '\n' ? 1 : 0;
      if (is_quoted) {
        if (c != '"') {
          cell += c;
        } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
          cell += text_[++at_];
        } else {
          is_quoted = false;
        }
      } else if (c == '"' && cell.empty()) {
        is_quoted = true;
      } else if (c == separator_) {
        row.cells.push_back(std::move(cell)), cell.clear();
      } else if (c == '\n') {
        ++at_;
        break;
      } else if (c != '\r') {
        cell += c;
      }
    }
    row.cells.push_back(std::move(cell));
    return row;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
  char separator_ = ',';
};

/// Where the first row of a table says that ids and decisions are.
struct Columns {
  std::optional<std::size_t> id, status, comment, assignee;

  explicit Columns(Table& table) {
    const std::optional<Table::Row> names = table.next();
    for (std::size_t i = 0; names && i < names->cells.size(); ++i) {
      if (names->cells[i] == "id") id = i;
      if (names->cells[i] == "status") status = i;
      if (names->cells[i] == "comment") comment = i;
      if (names->cells[i] == "assignee") assignee = i;
    }
  }
  [[nodiscard]] bool are_there() const { return id && (status || comment || assignee); }
};

bool is_same(const Decision& p, const Decision& q) {
  return printable(p.status) == printable(q.status) && printable(p.comment) == printable(q.comment) &&
         printable(p.assignee) == printable(q.assignee);
}

}  // namespace

Result<Decisions> parse_decided_table(const std::string& name, const std::string& text) {
  Table table(text);
  const Columns columns(table);
  if (!columns.are_there())
    return Error{Code::bad_file, fmt::format("{}:1: a table of decisions has the columns 'id', 'status', 'comment' and "
                                             "'assignee', as the CSV of impinge clash has them",
                                             name)};
  Decisions decisions;
  while (const std::optional<Table::Row> row = table.next()) {
    const auto cell = [&](const std::optional<std::size_t>& at) {
      return at && *at < row->cells.size() ? without_defusing(row->cells[*at]) : std::string();
    };
    const Decision decision{cell(columns.status), cell(columns.comment), cell(columns.assignee)};
    if (is_same(decision, {})) continue;
    const std::string id = cell(columns.id);
    if (!is_pair_id(id))
      return Error{Code::bad_file,
                   fmt::format("{}:{}: the cell under 'id' is no id of a pair: '{}'", name, row->line, printable(id))};
    const auto [there, is_new] = decisions.by_id.emplace(id, decision);
    if (!is_new && !is_same(there->second, decision))
      return Error{Code::bad_file,
                   fmt::format("{}:{}: another row decides otherwise about the pair {}", name, row->line, id)};
  }
  return decisions;
}

Result<void> check_replaced_table(const std::string& name, const Decisions& given, const Review& review) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(name, unknown)) return {};
  const Result<std::string> text = read_text_file(name, kMostBytesOfTable);
  if (!text) return text.error();
  Table table(*text);
  if (!Columns(table).are_there()) return {};
  const Result<Decisions> earlier = parse_decided_table(name, *text);
  if (!earlier) return earlier.error();

  std::unordered_map<std::string_view, const Decision*> shown;
  for (std::size_t i = 0; i < review.ids.size(); ++i) shown.emplace(review.ids[i], &review.standings[i].decision);
  // Of a pair that is gone the new table has no row: what only the earlier one says would be lost.
  const auto is_given = [&](const std::string& id, const Decision& decision) {
    const auto same_id = given.by_id.find(id);
    if (same_id != given.by_id.end() && is_same(same_id->second, decision)) return true;
    return std::any_of(given.by_names.begin(), given.by_names.end(),
                       [&](const Decisions::ByNames& entry) { return is_same(entry.decision, decision); });
  };
  std::size_t lost = 0;
  std::string first;
  for (const auto& [id, decision] : earlier->by_id) {
    const auto pair = shown.find(id);
    if (pair != shown.end() ? is_same(*pair->second, decision) : is_given(id, decision)) continue;
    if (lost++ == 0) first = id;
  }
  if (lost == 0) return {};
  return Error{Code::bad_file,
               fmt::format("{} holds {} that would be lost, the first about the pair {}; write to another file and "
                           "give this one to --decisions, or replace it with --force",
                           name, counted(lost, "decision"), first)};
}

}  // namespace impinge::report
