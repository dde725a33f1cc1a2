// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "report/sink.hpp"

namespace impinge::cli {
using namespace report;

struct Column {
  enum class Kind {
    name,    ///< to the left; gives way where the terminal is narrow
    number,  ///< to the right, never cut
    text,    ///< to the left, never cut
  };
  std::string heading;
  Kind kind;
  /// A row's cell, printable. It is called twice for each row, so that a table of a million rows need not be held in
  /// memory.
  std::function<std::string(std::size_t row)> text_of;
};

struct Table {
  std::size_t rows = 0;
  std::vector<Column> columns;
};

/// Prints headings and rows. With a width, names are cut so that lines fit it, but never below 8 columns.
/// Stops early, in the middle of the table, when writing fails or a stop is asked for.
void print(const Table& table, Sink& sink, std::optional<std::size_t> width, const std::stop_token& stop = {});

}  // namespace impinge::cli
