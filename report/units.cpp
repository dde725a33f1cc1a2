// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "report/text.hpp"
#include "report/vector.hpp"

namespace impinge::report {
namespace {

double diagonal(const Bounds& box) { return length(box.hi - box.lo); }

/// Whether one box is in the other, to a tenth of the other's size.
bool is_within(const Bounds& box, const Bounds& other) {
  const double slack = 0.1 * diagonal(other);
  for (double Point::*const axis : {&Point::x, &Point::y, &Point::z})
    if (box.lo.*axis < other.lo.*axis - slack || box.hi.*axis > other.hi.*axis + slack) return false;
  return true;
}

/// The factor that makes a file's box that of the others; or, where some of these say their unit and it is more than
/// ten times as large as they are, that brings it to among them.
std::optional<double> factor_to_fit(const Bounds& box, const Bounds& others, const std::optional<double>& metres,
                                    bool any_known) {
  if (others.is_empty()) return std::nullopt;
  const bool is_large = any_known && diagonal(box) > 10 * diagonal(others);
  for (const double ratio : {1000.0, 25.4, 304.8})
    for (const double factor : {1 / ratio, ratio}) {
      if (metres && !short_name(factor * *metres)) continue;
      const Bounds scaled{factor * box.lo, factor * box.hi};
      if (is_within(scaled, others) && (is_within(others, scaled) || (is_large && factor < 1))) return factor;
    }
  return std::nullopt;
}

/// The box of all other files, but for those whose scale is doubted already.
Bounds box_of_others(const std::vector<FileUnit>& files, std::size_t file, const std::vector<bool>& doubted) {
  Bounds all;
  for (std::size_t i = 0; i < files.size(); ++i)
    if (i != file && !doubted[i]) all.add(files[i].box.lo), all.add(files[i].box.hi);
  return all;
}

}  // namespace

const std::vector<std::pair<std::string, double>>& named_units() {
  static const std::vector<std::pair<std::string, double>> units{
      {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
  return units;
}

std::optional<std::string> short_name(double metres) {
  // Files have units that are products of several numbers, each of them rounded.
  constexpr double kRounding = 1e-12;
  for (const auto& [name, size] : named_units())
    if (std::abs(metres - size) <= kRounding * size) return name;
  return std::nullopt;
}

std::string unit_name(double metres) { return short_name(metres).value_or(fmt::format("{} m", metres)); }

std::string unit_text(const std::optional<double>& metres) { return metres ? unit_name(*metres) : "an unknown unit"; }

std::string unit_after(const std::optional<double>& metres) { return metres ? " " + unit_name(*metres) : ""; }

std::string volume_text(double volume, const std::optional<double>& metres, int digits) {
  const auto figure = [&](double value) { return fmt::format("{:.{}g}", value + 0.0, digits); };
  if (!metres) return figure(volume);
  constexpr double kFoot = 0.3048 * 0.3048 * 0.3048, kInch = 0.0254 * 0.0254 * 0.0254;
  using Units = std::vector<std::pair<const char*, double>>;
  const std::string unit = unit_name(*metres);
  const Units units = unit == "ft" || unit == "in" ? Units{{"ft³", kFoot}, {"in³", kInch}}
                                                   : Units{{"m³", 1}, {"L", 1e-3}, {"cm³", 1e-6}, {"mm³", 1e-9}};
  const double cubic = volume * *metres * *metres * *metres;
  const auto fits = std::ranges::find_if(units, [&](const auto& one) { return std::abs(cubic) >= one.second; });
  const auto& [name, size] = fits == units.end() ? units.back() : *fits;
  return fmt::format("{} {}", figure(cubic / size), name);
}

std::optional<Length> parse_length(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !(value >= 0) || !std::isfinite(value)) return std::nullopt;
  value += 0.0;  // -0 is 0
  std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  if (unit.empty()) return value;
  if (unit.starts_with(' ')) unit.remove_prefix(1);
  for (const auto& [name, metres] : named_units())
    if (unit == name) return Length(value, metres);
  return std::nullopt;
}

std::string text_of(const Length& length) {
  return fmt::format("{}{}", length.value, length.unit_in_metres ? unit_name(*length.unit_in_metres) : "");
}

Result<void> bring_to_unit(Length& length, const std::optional<double>& metres, std::string_view name) {
  if (!length.unit_in_metres) return {};
  if (!metres)
    return Error{
        Code::bad_option,
        fmt::format("{} {}: no file says the unit of its coordinates; add --unit with theirs", name, text_of(length))};
  // Through a quotient of the units: 10 mm are 10 where millimetres are the unit.
  const double value = length.value * (*length.unit_in_metres / *metres);
  if (!std::isfinite(value))
    return Error{Code::bad_option, fmt::format("{} {}: is beyond every double in the unit of the coordinates, {}", name,
                                               text_of(length), unit_name(*metres))};
  length = value;
  return {};
}

std::vector<std::string> unit_warnings(const std::vector<FileUnit>& files, std::optional<double> metres) {
  std::vector<std::string> warnings, taken;
  std::vector<bool> doubted(files.size());
  const bool any_known = std::ranges::any_of(files, &FileUnit::is_known);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (files[i].is_known) continue;
    const std::string file = printable(files[i].file);
    const std::optional<double> factor =
        factor_to_fit(files[i].box, box_of_others(files, i, doubted), metres, any_known);
    doubted[i] = factor.has_value();
    if (factor)
      warnings.push_back(fmt::format(
          "{0} does not say its unit and is far {1} than the other files: --scale {0}={2:.6g}{3}; --scale {0}=1 if it "
          "is right",
          file, *factor < 1 ? "larger" : "smaller", *factor,
          metres ? " if it is in " + unit_name(*factor * *metres) : " brings it to their size"));
    else
      taken.push_back(file);
  }
  if (taken.empty() || !metres || !any_known) return warnings;
  constexpr std::size_t kMostNamed = 5;
  const std::size_t named = std::min(taken.size(), kMostNamed);
  const std::string more =
      named < taken.size() ? fmt::format(" and {}", counted(taken.size() - named, "more file")) : "";
  const bool one = taken.size() == 1;
  warnings.push_back(fmt::format(
      "{}{} {} unit and {} taken to be in {}, as the other files are: --scale {}=S multiplies the coordinates of {}, "
      "and says with S=1 that they are right",
      fmt::join(taken.begin(), taken.begin() + static_cast<std::ptrdiff_t>(named), ", "), more,
      one ? "does not say its" : "do not say their", one ? "is" : "are", unit_name(*metres), one ? taken[0] : "FILE",
      one ? "this file" : "one of them"));
  return warnings;
}

}  // namespace impinge::report
