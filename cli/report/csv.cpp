// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/csv.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "report/place.hpp"
#include "text.hpp"

namespace impinge::cli {
namespace {

/// What a formula begins with, also in the wide forms that some spreadsheets take for the same; and the apostrophe that
/// defuses it, so that it can be taken away again.
bool needs_defusing(std::string_view text) {
  constexpr std::array<std::string_view, 9> kBeginnings{
      "=", "+", "-", "@", "'", "\xEF\xBC\x9D", "\xEF\xBC\x8B", "\xEF\xBC\x8D", "\xEF\xBC\xA0"};
  for (const std::string_view beginning : kBeginnings)
    if (text.starts_with(beginning)) return true;
  return false;
}

/// What a row is about.
struct Row {
  const Review& review;
  const Clash& pair;
  std::size_t rank;
  const std::string& id;
  bool fails;
  Point at;
};

/// An empty cell stands where there is no such number.
std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value == 0 ? 0.0 : value) : ""; }
std::string whole(std::uint64_t value) { return fmt::format("{}", value); }

const io::Object& part(const Row& row, std::size_t side) { return row.review.assembly.objects[row.pair.objects[side]]; }
const std::string& file(const Row& row, std::size_t side) {
  return row.review.assembly.files[row.review.assembly.file_of[row.pair.objects[side]]];
}
std::string inner(const Row& row) {
  if (row.pair.verdict != Verdict::inside || row.pair.inner < 0) return "";
  return row.pair.inner == 0 ? "a" : "b";
}
std::string depth(const Row& row, double (*pick)(const OverlapDepth&)) {
  return row.pair.overlap_depth ? number(pick(*row.pair.overlap_depth)) : "";
}
std::string normal(const Row& row, double Point::*axis) {
  return row.pair.regions.empty() ? "" : number(row.pair.regions.front().normal.*axis);
}
std::string sum(const Row& row, double Region::*measure) {
  double all = 0;
  for (const Region& region : row.pair.regions) all += region.*measure;
  return number(all);
}

struct Column {
  std::string_view name;
  std::string (*text)(const Row& row);
};

/// Others may be added at the end; these keep their names and places (docs/reports.md).
constexpr std::array kColumns{
    Column{"rank", [](const Row& row) { return whole(row.rank); }},
    Column{"verdict", [](const Row& row) { return std::string(name(row.pair.verdict)); }},
    Column{"fails", [](const Row& row) { return std::string(row.fails ? "true" : "false"); }},
    Column{"id", [](const Row& row) { return row.id; }},
    Column{"a", [](const Row& row) { return csv_cell(part(row, 0).name); }},
    Column{"b", [](const Row& row) { return csv_cell(part(row, 1).name); }},
    Column{"a_path", [](const Row& row) { return csv_cell(part(row, 0).path); }},
    Column{"b_path", [](const Row& row) { return csv_cell(part(row, 1).path); }},
    Column{"a_product", [](const Row& row) { return csv_cell(part(row, 0).product); }},
    Column{"b_product", [](const Row& row) { return csv_cell(part(row, 1).product); }},
    Column{"a_file", [](const Row& row) { return csv_cell(file(row, 0)); }},
    Column{"b_file", [](const Row& row) { return csv_cell(file(row, 1)); }},
    Column{"inner", inner},
    Column{"depth", [](const Row& row) { return row.pair.overlap_depth ? number(depth_of(row.pair)) : ""; }},
    Column{"a_in_b_least", [](const Row& row) { return depth(row, [](const auto& d) { return d.a_in_b.lo; }); }},
    Column{"a_in_b_most", [](const Row& row) { return depth(row, [](const auto& d) { return d.a_in_b.hi; }); }},
    Column{"b_in_a_least", [](const Row& row) { return depth(row, [](const auto& d) { return d.b_in_a.lo; }); }},
    Column{"b_in_a_most", [](const Row& row) { return depth(row, [](const auto& d) { return d.b_in_a.hi; }); }},
    Column{"distance", [](const Row& row) { return row.pair.nearest ? number(row.pair.nearest->distance) : ""; }},
    Column{"distance_error", [](const Row& row) { return row.pair.nearest ? number(row.pair.nearest->error) : ""; }},
    Column{"regions", [](const Row& row) { return whole(row.pair.regions.size()); }},
    Column{"area", [](const Row& row) { return sum(row, &Region::area); }},
    Column{"length", [](const Row& row) { return sum(row, &Region::length); }},
    Column{"x", [](const Row& row) { return number(row.at.x); }},
    Column{"y", [](const Row& row) { return number(row.at.y); }},
    Column{"z", [](const Row& row) { return number(row.at.z); }},
    Column{"normal_x", [](const Row& row) { return normal(row, &Point::x); }},
    Column{"normal_y", [](const Row& row) { return normal(row, &Point::y); }},
    Column{"normal_z", [](const Row& row) { return normal(row, &Point::z); }},
    Column{"crossing", [](const Row& row) { return whole(row.pair.contacts[0]); }},
    Column{"touching", [](const Row& row) { return whole(row.pair.contacts[1]); }},
    Column{"coplanar", [](const Row& row) { return whole(row.pair.contacts[2]); }},
    Column{"tolerance", [](const Row& row) { return number(row.pair.tolerance); }},
    Column{"note", [](const Row& row) { return csv_cell(sentence(row.pair.note)); }},
};

/// Cells with commas between them, and the end of the line.
std::string line(auto text_of) {
  std::string text;
  for (const Column& column : kColumns) {
    if (&column != kColumns.data()) text += ',';
    text += text_of(column);
  }
  return text += "\r\n";
}

}  // namespace

std::string csv_cell(std::string_view text) {
  const std::string cell = (needs_defusing(text) ? "'" : "") + printable(text);
  if (cell.find_first_of("\",") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

Result<void> write_csv(Sink& sink, const Review& review, const std::stop_token& stop) {
  sink.write(line([](const Column& column) { return column.name; }));
  std::size_t rank = 0;
  for (const std::size_t i : ranked(review.clashes.pairs)) {
    if (stop.stop_requested()) return interrupted();
    if (sink.failed()) break;
    const Clash& pair = review.clashes.pairs[i];
    const Row row{review, pair, ++rank, review.ids[i], review.standings[i].fails, place_of(review, i).at};
    sink.write(line([&](const Column& column) { return column.text(row); }));
  }
  return {};
}

}  // namespace impinge::cli
