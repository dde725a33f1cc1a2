// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "table.hpp"

#include <algorithm>

#include "report/text.hpp"

namespace impinge::cli {
namespace {

constexpr std::size_t kGap = 2;
constexpr std::size_t kNarrowestName = 8;

std::vector<std::size_t> natural_widths(const Table& table, const std::stop_token& stop) {
  std::vector<std::size_t> widths;
  for (const Column& column : table.columns) widths.push_back(columns(column.heading));
  for (std::size_t row = 0; row < table.rows && !stop.stop_requested(); ++row)
    for (std::size_t column = 0; column < widths.size(); ++column)
      widths[column] = std::max(widths[column], columns(table.columns[column].text_of(row)));
  return widths;
}

/// Shares what the other columns leave among the names: short ones keep what they need, long ones get the same.
void narrow_names(const Table& table, std::size_t line, std::vector<std::size_t>& widths) {
  std::vector<std::size_t> names;
  std::size_t others = kGap * (widths.size() - 1);
  for (std::size_t column = 0; column < widths.size(); ++column) {
    if (table.columns[column].kind == Column::Kind::name) {
      names.push_back(column);
    } else {
      others += widths[column];
    }
  }
  std::size_t left = line > others ? line - others : 0;
  std::sort(names.begin(), names.end(), [&](std::size_t a, std::size_t b) { return widths[a] < widths[b]; });
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t share = std::max(left / (names.size() - i), kNarrowestName);
    widths[names[i]] = std::min(widths[names[i]], share);
    left -= std::min(left, widths[names[i]]);
  }
}

void print_line(const Table& table, Sink& sink, const std::vector<std::size_t>& widths, auto cell) {
  std::string line;
  for (std::size_t column = 0; column < widths.size(); ++column) {
    const std::string text = fit(cell(table.columns[column]), widths[column]);
    const std::size_t padding = widths[column] - std::min(widths[column], columns(text));
    if (column > 0) line.append(kGap, ' ');
    if (table.columns[column].kind == Column::Kind::number) line.append(padding, ' ');
    line += text;
    if (table.columns[column].kind != Column::Kind::number && column + 1 < widths.size()) line.append(padding, ' ');
  }
  sink.write(line += '\n');
}

}  // namespace

void print(const Table& table, Sink& sink, std::optional<std::size_t> width, const std::stop_token& stop) {
  std::vector<std::size_t> widths = natural_widths(table, stop);
  if (width) narrow_names(table, *width, widths);
  print_line(table, sink, widths, [](const Column& column) { return column.heading; });
  for (std::size_t row = 0; row < table.rows && !sink.failed() && !stop.stop_requested(); ++row)
    print_line(table, sink, widths, [&](const Column& column) { return column.text_of(row); });
}

}  // namespace impinge::cli
