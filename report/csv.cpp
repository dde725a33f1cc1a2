// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "report/conventions.hpp"
#include "report/place.hpp"
#include "report/text.hpp"
#include "report/units.hpp"
#include "report/writers.hpp"

namespace impinge::report {
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

/// Others may be added at the end; these keep their names and places (docs/reports.md).
constexpr auto kColumns =
    std::to_array<std::string_view>({"rank",        "verdict",      "fails",       "id",          "a",
                                     "b",           "a_path",       "b_path",      "a_product",   "b_product",
                                     "a_file",      "b_file",       "inner",       "depth",       "a_in_b_least",
                                     "a_in_b_most", "b_in_a_least", "b_in_a_most", "distance",    "distance_error",
                                     "regions",     "area",         "length",      "x",           "y",
                                     "z",           "normal_x",     "normal_y",    "normal_z",    "crossing",
                                     "touching",    "coplanar",     "tolerance",   "note",        "test",
                                     "change",      "was",          "new_regions", "region",      "status",
                                     "comment",     "depth_m",      "distance_m",  "area_m2",     "length_m",
                                     "x_m",         "y_m",          "z_m",         "fails_below", "a_class",
                                     "b_class",     "a_global_id",  "b_global_id", "a_tag",       "b_tag",
                                     "a_storey",    "b_storey",     "assignee",    "unit",        "incomplete",
                                     "volume",      "volume_error", "volume_m3",   "depth_least", "due",
                                     "axes"});

/// The place of a column, which there must be. Functions below rely on those of b behind those of a, and of y
/// and z behind those of x.
consteval std::size_t column(std::string_view name) {
  const auto at = std::ranges::find(kColumns, name);
  if (at == kColumns.end()) throw name;
  return static_cast<std::size_t>(at - kColumns.begin());
}
consteval bool adjoin(std::initializer_list<std::string_view> names) {
  return std::equal(names.begin(), names.end(), kColumns.data() + column(*names.begin()));
}
static_assert(adjoin({"a", "b", "a_path", "b_path", "a_product", "b_product", "a_file", "b_file"}));
static_assert(adjoin({"a_class", "b_class", "a_global_id", "b_global_id", "a_tag", "b_tag", "a_storey", "b_storey"}));
static_assert(adjoin({"x", "y", "z", "normal_x", "normal_y", "normal_z", "crossing", "touching", "coplanar"}));
static_assert(adjoin({"x_m", "y_m", "z_m"}));

/// A row; what is not known is an empty cell.
using Cells = std::array<std::string, kColumns.size()>;

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value == 0 ? 0.0 : value) : ""; }
std::string whole(std::uint64_t value) { return fmt::format("{}", value); }

/// Nothing where nobody said what the files' unit is.
std::string in_metres(const Conventions& conventions, double value, int power = 1) {
  if (!conventions.is_known) return "";
  for (int i = 0; i < power; ++i) value *= conventions.metres;
  return number(value);
}

void put(Cells& cells, std::size_t first, const Point& point) {
  cells[first] = number(point.x), cells[first + 1] = number(point.y), cells[first + 2] = number(point.z);
}

void put_place(Cells& cells, const Conventions& conventions, const Point& place) {
  put(cells, column("x"), place);
  if (conventions.is_known) put(cells, column("x_m"), place_in_bcf(conventions, place));
}

void put_parts(Cells& cells, const Assembly& assembly, const std::array<std::uint32_t, 2>& objects) {
  for (const std::size_t side : {0, 1}) {
    const io::Object& part = assembly.objects[objects[side]];
    cells[column("a") + side] = csv_cell(part.name);
    cells[column("a_path") + side] = csv_cell(part.path);
    cells[column("a_product") + side] = csv_cell(part.product);
    cells[column("a_file") + side] = csv_cell(assembly.files[assembly.file_of[objects[side]]]);
    cells[column("a_class") + side] = csv_cell(property_of(part, "class"));
    cells[column("a_global_id") + side] = csv_cell(property_of(part, "GlobalId"));
    cells[column("a_tag") + side] = csv_cell(property_of(part, "Tag"));
    cells[column("a_storey") + side] = csv_cell(property_of(part, "storey"));
  }
}

void put_figures(Cells& cells, const Conventions& conventions, const Clash& pair) {
  if (const auto& overlap = pair.overlap_depth) {
    const auto& [a_in_b, b_in_a] = *overlap;
    cells[column("depth")] = number(depth_of(overlap).hi);
    cells[column("depth_least")] = number(depth_of(overlap).lo);
    cells[column("depth_m")] = in_metres(conventions, depth_of(overlap).hi);
    cells[column("a_in_b_least")] = number(a_in_b.lo), cells[column("a_in_b_most")] = number(a_in_b.hi);
    cells[column("b_in_a_least")] = number(b_in_a.lo), cells[column("b_in_a_most")] = number(b_in_a.hi);
  }
  if (const auto& overlap = pair.overlap_volume) {
    cells[column("volume")] = number(overlap->volume);
    cells[column("volume_error")] = number(overlap->error);
    cells[column("volume_m3")] = in_metres(conventions, overlap->volume, 3);
  }
  if (const auto& nearest = pair.nearest) {
    cells[column("distance")] = number(nearest->distance);
    cells[column("distance_error")] = number(nearest->error);
    cells[column("distance_m")] = in_metres(conventions, nearest->distance);
  }
  double length = 0;
  for (const Region& region : pair.regions) length += region.length;
  cells[column("regions")] = whole(pair.regions.size());
  cells[column("area")] = number(area_of(pair)), cells[column("area_m2")] = in_metres(conventions, area_of(pair), 2);
  cells[column("length")] = number(length), cells[column("length_m")] = in_metres(conventions, length);
  if (!pair.regions.empty()) put(cells, column("normal_x"), pair.regions.front().normal);
  for (std::size_t kind = 0; kind < pair.contacts.size(); ++kind)
    cells[column("crossing") + kind] = whole(pair.contacts[kind]);
  cells[column("tolerance")] = number(pair.tolerance);
  cells[column("fails_below")] = number(pair.fails_below);
}

void put_triage(Cells& cells, const Review& review, std::size_t pair) {
  const Standing& standing = review.standings[pair];
  const std::vector<PlannedTest>& tests = review.plan.tests();
  cells[column("fails")] = standing.fails ? "true" : "false";
  if (!tests.empty()) cells[column("test")] = csv_cell(tests[review.clashes.pairs[pair].test].name);
  cells[column("change")] = name(standing.change);
  if (standing.was) cells[column("was")] = name(*standing.was);
  if (standing.change != Change::unknown)
    cells[column("new_regions")] =
        whole(static_cast<std::uint64_t>(std::ranges::count(standing.regions, Change::fresh, &RegionStanding::change)));
  cells[column("status")] = csv_cell(standing.decision.status);
  cells[column("comment")] = csv_cell(standing.decision.comment);
  cells[column("assignee")] = csv_cell(standing.decision.assignee);
  cells[column("due")] = csv_cell(standing.decision.due);
}

Cells row_of(const Review& review, const Conventions& conventions, std::size_t pair, const Point& place) {
  const Clash& clash = review.clashes.pairs[pair];
  Cells cells;
  cells[column("verdict")] = name(clash.verdict);
  cells[column("id")] = review.ids[pair];
  if (clash.verdict == Verdict::inside && clash.inner >= 0) cells[column("inner")] = clash.inner == 0 ? "a" : "b";
  cells[column("note")] = csv_cell(sentence(clash.note));
  if (conventions.is_known) cells[column("unit")] = unit_name(conventions.metres);
  cells[column("incomplete")] = incomplete_sides(review, clash);
  cells[column("axes")] = csv_cell(review.axes[pair]);
  put_parts(cells, review.assembly, clash.objects);
  put_figures(cells, conventions, clash);
  put_place(cells, conventions, place);
  put_triage(cells, review, pair);
  return cells;
}

/// What is gone since the previous run: a pair of then, or one of its regions.
Cells row_of(const Resolved& gone, const Conventions& conventions) {
  Cells cells;
  cells[column("verdict")] = name(gone.verdict);
  cells[column("fails")] = "false";
  cells[column("id")] = csv_cell(gone.id);
  for (const std::size_t side : {0, 1}) {
    const OldPart& part = side == 0 ? gone.a : gone.b;
    cells[column("a") + side] = csv_cell(part.name);
    cells[column("a_path") + side] = csv_cell(part.path);
    cells[column("a_file") + side] = csv_cell(part.file);
  }
  if (gone.centroid) put_place(cells, conventions, *gone.centroid);
  cells[column("test")] = csv_cell(gone.test);
  cells[column("change")] = "resolved";
  cells[column("region")] = csv_cell(gone.region);
  return cells;
}

void write_row(Sink& sink, const auto& cells) { sink.write(fmt::format("{}\r\n", fmt::join(cells, ","))); }

}  // namespace

std::string csv_cell(std::string_view text) {
  std::string cell = (needs_defusing(text) ? "'" : "") + printable(text);
  if (cell.find_first_of("\",") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string without_defusing(std::string_view cell) {
  return std::string(cell.starts_with('\'') && needs_defusing(cell.substr(1)) ? cell.substr(1) : cell);
}

Result<void> write_csv(Sink& sink, const Review& review) {
  const Conventions conventions = conventions_of(review.options, review.assembly);
  write_row(sink, kColumns);
  const std::vector<Bounds> boxes = boxes_of(review);
  std::size_t rank = 0;
  for (const std::size_t i : ranked(review.clashes.pairs)) {
    if (review.options.stop.stop_requested()) return interrupted();
    if (sink.failed()) break;
    Cells cells = row_of(review, conventions, i, place_of(review, boxes, i).at);
    cells[column("rank")] = whole(++rank);
    write_row(sink, cells);
  }
  const Assembly& assembly = review.assembly;
  const auto write_note = [&](const char* verdict, const std::string& note, const std::string& file = {}) {
    Cells cells;
    cells[column("verdict")] = verdict;
    cells[column("note")] = csv_cell(note);
    cells[column("a_file")] = csv_cell(file);
    write_row(sink, cells);
  };
  const std::size_t unread = assembly.missing.size() - assembly.skipped.size();  // the skipped ones come last
  for (std::size_t i = 0; i < unread; ++i) write_note("missing", assembly.missing[i]);
  for (std::size_t i = 0; i < assembly.skipped.size(); ++i)
    write_note("skipped", assembly.missing[unread + i], assembly.skipped[i]);
  for (const std::string& warning : assembly.alignment) write_note("warning", warning);
  for (const Resolved& gone : review.resolved) {
    if (review.options.stop.stop_requested()) return interrupted();
    if (sink.failed()) break;
    write_row(sink, row_of(gone, conventions));
  }
  return {};
}

}  // namespace impinge::report
