// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// Documents read by programs other than the one that wrote them.
namespace impinge::test {

struct Member {
  std::string name, bytes;
  std::string date;  ///< "1980-01-01 00:00"
};
/// The members of a zip archive in their order, by libzip, which checks the archive's consistency and each checksum.
/// Throws where it finds a fault.
std::vector<Member> unzip(const std::string& archive);
/// Packs members into an archive, by libzip.
void zip(const std::filesystem::path& archive, const std::vector<Member>& members);

struct Pixels {
  std::size_t width = 0, height = 0;
  std::vector<unsigned char> rgb;
};
/// By libpng. Throws where it finds a fault.
Pixels read_png(std::string_view bytes);

/// The rows of RFC 4180. Throws where a quote stands where none may, or a row does not end in CR LF.
std::vector<std::vector<std::string>> read_csv(std::string_view text);

/// The cells of a row by the names of the columns.
using Row = std::map<std::string, std::string>;
/// The rows below the names. Fails the test where a row has another number of cells.
std::vector<Row> rows_of(std::string_view csv);
/// Fails the test where the cell is no number.
double number(const std::string& cell);

}  // namespace impinge::test
