// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

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

/// What a row is about.
struct Row {
  const Review& review;
  const Conventions& conventions;
  const Clash& pair;
  const Standing& standing;
  const std::string& axes;
  std::size_t rank;
  const std::string& id;
  Point at;
};

/// A row about what is gone since the previous run: a pair of then, or one of its regions.
struct GoneRow {
  const Conventions& conventions;
  const Resolved& what;
};

/// An empty cell stands where there is no such number.
std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value == 0 ? 0.0 : value) : ""; }
std::string whole(std::uint64_t value) { return fmt::format("{}", value); }
std::string truth(bool value) { return value ? "true" : "false"; }

const io::Object& part(const Row& row, std::size_t side) { return row.review.assembly.objects[row.pair.objects[side]]; }
const std::string& file(const Row& row, std::size_t side) {
  return row.review.assembly.files[row.review.assembly.file_of[row.pair.objects[side]]];
}
/// Empty where the part's file does not say it.
std::string property(const Row& row, std::size_t side, std::string_view wanted) {
  for (const auto& [name, value] : part(row, side).properties)
    if (name == wanted) return csv_cell(value);
  return "";
}
std::string inner(const Row& row) {
  if (row.pair.verdict != Verdict::inside || row.pair.inner < 0) return "";
  return row.pair.inner == 0 ? "a" : "b";
}
Interval depth(const Row& row) { return depth_of(row.pair.overlap_depth); }
std::string depth(const Row& row, double (*pick)(const OverlapDepth&)) {
  return row.pair.overlap_depth ? number(pick(*row.pair.overlap_depth)) : "";
}
double area(const Row& row) { return area_of(row.pair); }
double length(const Row& row) {
  double all = 0;
  for (const Region& region : row.pair.regions) all += region.length;
  return all;
}
std::string normal(const Row& row, double Point::*axis) {
  return row.pair.regions.empty() ? "" : number(row.pair.regions.front().normal.*axis);
}
/// Nothing where nobody said what the files' unit is.
std::string in_metres(const Conventions& conventions, double value, int power = 1) {
  if (!conventions.is_known) return "";
  for (int i = 0; i < power; ++i) value *= conventions.metres;
  return number(value);
}
std::string in_metres(const Conventions& conventions, const Point& at, double Point::*axis) {
  return conventions.is_known ? number(place_in_bcf(conventions, at).*axis) : "";
}

std::string test(const Row& row) {
  const std::vector<PlannedTest>& tests = row.review.plan.tests();
  return tests.empty() ? "" : csv_cell(tests[row.pair.test].name);
}
std::string new_regions(const Row& row) {
  if (row.standing.change == Change::unknown) return "";
  const auto& regions = row.standing.regions;
  return whole(static_cast<std::uint64_t>(
      std::count_if(regions.begin(), regions.end(), [](const auto& r) { return r.change == Change::fresh; })));
}

std::string centroid(const GoneRow& row, double Point::*axis) {
  return row.what.centroid ? number((*row.what.centroid).*axis) : "";
}
std::string centroid_in_metres(const GoneRow& row, double Point::*axis) {
  return row.what.centroid ? in_metres(row.conventions, *row.what.centroid, axis) : "";
}

struct Column {
  std::string_view name;
  std::string (*text)(const Row& row);
  std::string (*gone)(const GoneRow& row) = nullptr;  ///< null: an empty cell
};

/// Others may be added at the end; these keep their names and places (docs/reports.md).
constexpr std::array kColumns{
    Column{"rank", [](const Row& row) { return whole(row.rank); }},
    Column{"verdict", [](const Row& row) { return std::string(name(row.pair.verdict)); },
           [](const GoneRow& row) { return std::string(name(row.what.verdict)); }},
    Column{"fails", [](const Row& row) { return truth(row.standing.fails); },
           [](const GoneRow&) { return truth(false); }},
    Column{"id", [](const Row& row) { return row.id; }, [](const GoneRow& row) { return csv_cell(row.what.id); }},
    Column{"a", [](const Row& row) { return csv_cell(part(row, 0).name); },
           [](const GoneRow& row) { return csv_cell(row.what.a.name); }},
    Column{"b", [](const Row& row) { return csv_cell(part(row, 1).name); },
           [](const GoneRow& row) { return csv_cell(row.what.b.name); }},
    Column{"a_path", [](const Row& row) { return csv_cell(part(row, 0).path); },
           [](const GoneRow& row) { return csv_cell(row.what.a.path); }},
    Column{"b_path", [](const Row& row) { return csv_cell(part(row, 1).path); },
           [](const GoneRow& row) { return csv_cell(row.what.b.path); }},
    Column{"a_product", [](const Row& row) { return csv_cell(part(row, 0).product); }},
    Column{"b_product", [](const Row& row) { return csv_cell(part(row, 1).product); }},
    Column{"a_file", [](const Row& row) { return csv_cell(file(row, 0)); },
           [](const GoneRow& row) { return csv_cell(row.what.a.file); }},
    Column{"b_file", [](const Row& row) { return csv_cell(file(row, 1)); },
           [](const GoneRow& row) { return csv_cell(row.what.b.file); }},
    Column{"inner", inner},
    Column{"depth", [](const Row& row) { return row.pair.overlap_depth ? number(depth(row).hi) : ""; }},
    Column{"a_in_b_least", [](const Row& row) { return depth(row, [](const auto& d) { return d.a_in_b.lo; }); }},
    Column{"a_in_b_most", [](const Row& row) { return depth(row, [](const auto& d) { return d.a_in_b.hi; }); }},
    Column{"b_in_a_least", [](const Row& row) { return depth(row, [](const auto& d) { return d.b_in_a.lo; }); }},
    Column{"b_in_a_most", [](const Row& row) { return depth(row, [](const auto& d) { return d.b_in_a.hi; }); }},
    Column{"distance", [](const Row& row) { return row.pair.nearest ? number(row.pair.nearest->distance) : ""; }},
    Column{"distance_error", [](const Row& row) { return row.pair.nearest ? number(row.pair.nearest->error) : ""; }},
    Column{"regions", [](const Row& row) { return whole(row.pair.regions.size()); }},
    Column{"area", [](const Row& row) { return number(area(row)); }},
    Column{"length", [](const Row& row) { return number(length(row)); }},
    Column{"x", [](const Row& row) { return number(row.at.x); },
           [](const GoneRow& row) { return centroid(row, &Point::x); }},
    Column{"y", [](const Row& row) { return number(row.at.y); },
           [](const GoneRow& row) { return centroid(row, &Point::y); }},
    Column{"z", [](const Row& row) { return number(row.at.z); },
           [](const GoneRow& row) { return centroid(row, &Point::z); }},
    Column{"normal_x", [](const Row& row) { return normal(row, &Point::x); }},
    Column{"normal_y", [](const Row& row) { return normal(row, &Point::y); }},
    Column{"normal_z", [](const Row& row) { return normal(row, &Point::z); }},
    Column{"crossing", [](const Row& row) { return whole(row.pair.contacts[0]); }},
    Column{"touching", [](const Row& row) { return whole(row.pair.contacts[1]); }},
    Column{"coplanar", [](const Row& row) { return whole(row.pair.contacts[2]); }},
    Column{"tolerance", [](const Row& row) { return number(row.pair.tolerance); }},
    Column{"note", [](const Row& row) { return csv_cell(sentence(row.pair.note)); }},
    Column{"test", test, [](const GoneRow& row) { return csv_cell(row.what.test); }},
    Column{"change", [](const Row& row) { return name(row.standing.change); },
           [](const GoneRow&) { return std::string("resolved"); }},
    Column{"was", [](const Row& row) { return std::string(row.standing.was ? name(*row.standing.was) : ""); }},
    Column{"new_regions", new_regions},
    Column{"region", [](const Row&) { return std::string(); },
           [](const GoneRow& row) { return csv_cell(row.what.region); }},
    Column{"status", [](const Row& row) { return csv_cell(row.standing.decision.status); }},
    Column{"comment", [](const Row& row) { return csv_cell(row.standing.decision.comment); }},
    Column{"depth_m",
           [](const Row& row) { return row.pair.overlap_depth ? in_metres(row.conventions, depth(row).hi) : ""; }},
    Column{
        "distance_m",
        [](const Row& row) { return row.pair.nearest ? in_metres(row.conventions, row.pair.nearest->distance) : ""; }},
    Column{"area_m2", [](const Row& row) { return in_metres(row.conventions, area(row), 2); }},
    Column{"length_m", [](const Row& row) { return in_metres(row.conventions, length(row)); }},
    Column{"x_m", [](const Row& row) { return in_metres(row.conventions, row.at, &Point::x); },
           [](const GoneRow& row) { return centroid_in_metres(row, &Point::x); }},
    Column{"y_m", [](const Row& row) { return in_metres(row.conventions, row.at, &Point::y); },
           [](const GoneRow& row) { return centroid_in_metres(row, &Point::y); }},
    Column{"z_m", [](const Row& row) { return in_metres(row.conventions, row.at, &Point::z); },
           [](const GoneRow& row) { return centroid_in_metres(row, &Point::z); }},
    Column{"fails_below", [](const Row& row) { return number(row.pair.fails_below); }},
    Column{"a_class", [](const Row& row) { return property(row, 0, "class"); }},
    Column{"b_class", [](const Row& row) { return property(row, 1, "class"); }},
    Column{"a_global_id", [](const Row& row) { return property(row, 0, "GlobalId"); }},
    Column{"b_global_id", [](const Row& row) { return property(row, 1, "GlobalId"); }},
    Column{"a_tag", [](const Row& row) { return property(row, 0, "Tag"); }},
    Column{"b_tag", [](const Row& row) { return property(row, 1, "Tag"); }},
    Column{"a_storey", [](const Row& row) { return property(row, 0, "storey"); }},
    Column{"b_storey", [](const Row& row) { return property(row, 1, "storey"); }},
    Column{"assignee", [](const Row& row) { return csv_cell(row.standing.decision.assignee); }},
    Column{"unit", [](const Row& row) { return row.conventions.is_known ? unit_name(row.conventions.metres) : ""; }},
    Column{"incomplete", [](const Row& row) { return incomplete_sides(row.review, row.pair); }},
    Column{"volume",
           [](const Row& row) { return row.pair.overlap_volume ? number(row.pair.overlap_volume->volume) : ""; }},
    Column{"volume_error",
           [](const Row& row) { return row.pair.overlap_volume ? number(row.pair.overlap_volume->error) : ""; }},
    Column{"volume_m3",
           [](const Row& row) {
             return row.pair.overlap_volume ? in_metres(row.conventions, row.pair.overlap_volume->volume, 3) : "";
           }},
    Column{"depth_least", [](const Row& row) { return row.pair.overlap_depth ? number(depth(row).lo) : ""; }},
    Column{"due", [](const Row& row) { return csv_cell(row.standing.decision.due); }},
    Column{"axes", [](const Row& row) { return csv_cell(row.axes); }},
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
  sink.write(line([](const Column& column) { return column.name; }));
  const std::vector<Bounds> boxes = boxes_of(review);
  std::size_t rank = 0;
  for (const std::size_t i : ranked(review.clashes.pairs)) {
    if (review.options.stop.stop_requested()) return interrupted();
    if (sink.failed()) break;
    const Row row{review,         conventions, review.clashes.pairs[i], review.standings[i],
                  review.axes[i], ++rank,      review.ids[i],           place_of(review, boxes, i).at};
    sink.write(line([&](const Column& column) { return column.text(row); }));
  }
  const Assembly& assembly = review.assembly;
  const auto write_note = [&](std::string_view verdict, const std::string& note, const std::string& file = {}) {
    sink.write(line([&](const Column& column) {
      return column.name == "verdict"  ? std::string(verdict)
             : column.name == "note"   ? csv_cell(note)
             : column.name == "a_file" ? csv_cell(file)
                                       : std::string();
    }));
  };
  const std::size_t unread = assembly.missing.size() - assembly.skipped.size();  // the skipped ones come last
  for (std::size_t i = 0; i < unread; ++i) write_note("missing", assembly.missing[i]);
  for (std::size_t i = 0; i < assembly.skipped.size(); ++i)
    write_note("skipped", assembly.missing[unread + i], assembly.skipped[i]);
  for (const std::string& warning : assembly.alignment) write_note("warning", warning);
  for (const Resolved& gone : review.resolved) {
    if (review.options.stop.stop_requested()) return interrupted();
    if (sink.failed()) break;
    const GoneRow row{conventions, gone};
    sink.write(line([&](const Column& column) { return column.gone == nullptr ? "" : column.gone(row); }));
  }
  return {};
}

}  // namespace impinge::report
