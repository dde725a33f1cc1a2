// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "report/decisions.hpp"
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

/// Where the first row of a table says that each column is.
std::map<std::string, std::size_t> columns_of(Table& table) {
  std::map<std::string, std::size_t> columns;
  const std::optional<Table::Row> names = table.next();
  for (std::size_t i = 0; names && i < names->cells.size(); ++i) columns[names->cells[i]] = i;
  return columns;
}

bool are_of_decisions(const std::map<std::string, std::size_t>& columns) {
  const auto is_there = [&](const auto& field) { return columns.contains(field.first); };
  return columns.contains("id") && std::ranges::any_of(kDecisionFields, is_there);
}

}  // namespace

Result<Decisions> parse_decided_table(const std::string& name, const std::string& text) {
  Table table(text);
  const auto columns = columns_of(table);
  if (!are_of_decisions(columns)) {
    std::string fields;
    for (const auto& [field_name, field] : kDecisionFields)
      fields += fmt::format("{}'{}'", fields.empty() ? "" : ", ", field_name);
    return Error{Code::bad_file,
                 fmt::format("{}:1: a table of decisions needs the column 'id' and at least one of {}", name, fields)};
  }
  Decisions decisions;
  while (const std::optional<Table::Row> row = table.next()) {
    const auto cell = [&](const char* column) {
      const auto at = columns.find(column);
      return at != columns.end() && at->second < row->cells.size() ? without_defusing(row->cells[at->second]) : "";
    };
    Decision decision;
    for (const auto& [field_name, field] : kDecisionFields) decision.*field = cell(field_name);
    if (is_empty(decision)) continue;
    const std::string id = cell("id");
    if (!is_pair_id(id))
      return Error{Code::bad_file,
                   fmt::format("{}:{}: the cell under 'id' is no id of a pair: '{}'", name, row->line, printable(id))};
    if (!decision.due.empty() && !is_day(decision.due))
      return Error{Code::bad_file, fmt::format("{}:{}: the cell under 'due' is no day such as 2024-06-14: '{}'", name,
                                               row->line, printable(decision.due))};
    if (!decisions.add(id, decision))
      return Error{Code::bad_file,
                   fmt::format("{}:{}: another row decides otherwise about the pair {}", name, row->line, id)};
  }
  return decisions;
}

bool is_decided_table(const std::string& text) {
  Table table(text);
  return are_of_decisions(columns_of(table));
}

}  // namespace impinge::report
