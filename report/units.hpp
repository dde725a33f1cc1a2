// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "impinge/report.hpp"
#include "report/vector.hpp"

/// Units of length: their names, and what is said of files that do not tell theirs.
namespace impinge::report {

/// The units that people name, and how many metres each has.
const std::vector<std::pair<std::string, double>>& named_units();

/// "mm" of 0.001; nothing of units that are none of those.
std::optional<std::string> short_name(double metres);
/// The same, or else the metres: "0.9144 m".
std::string unit_name(double metres);

/// The same, or "an unknown unit".
std::string unit_text(const std::optional<double>& metres);
/// What follows a length: " mm", or nothing where the unit is not known.
std::string unit_after(const std::optional<double>& metres);

/// "12.3 L" of so many cubes of a unit of so many metres, to so many digits: in the largest of m³, L, cm³ and mm³, or
/// where the unit is the foot or the inch of ft³ and in³, that it has one of. A number alone where it is not known.
std::string volume_text(double volume, const std::optional<double>& metres, int digits);

/// A length from 0 up, "10", "10mm" or "10 mm"; nothing for any other text.
std::optional<Length> parse_length(std::string_view text);
/// "10mm", or "10" in the run's unit: what `parse_length` takes.
std::string text_of(const Length& length);

/// Brings the length to the run's unit. Errors: `bad_option` (it has a unit of its own, and the run's is not known).
Result<void> bring_to_unit(Length& length, const std::optional<double>& metres, std::string_view name);

/// In the run's unit, to which it must have been brought.
inline std::optional<double> value_of(const std::optional<Length>& length) {
  return length ? std::optional(length->value) : std::nullopt;
}

/// What is known of the unit of a file.
struct FileUnit {
  std::string file;
  bool is_known = false;  ///< the file says it, or the call how its coordinates are scaled
  Bounds box{};
};

/// A sentence for each file whose unit is not known and whose coordinates are far larger or smaller than those of the
/// others; and one for all other such files, on what they are taken to be where others say their unit. `metres`: in one
/// of the run's units.
std::vector<std::string> unit_warnings(const std::vector<FileUnit>& files, std::optional<double> metres);

}  // namespace impinge::report
