// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "arguments.hpp"
#include "impinge/result.hpp"
#include "report/comparison/previous.hpp"

/// What people wrote into a report is not lost to the next one.
namespace impinge::report {

/// Looks for a status or comment that is not empty in a JSON text that comes piece by piece, so that a report of any
/// size is read at most once and never held.
class RemarkSearch {
 public:
  /// Whether one has been found.
  bool look(std::string_view piece);

 private:
  enum class At { outside, text, escape, code, value, remark };
  bool step(char c);
  void add(char c);

  At at_ = At::outside;
  std::string text_;  ///< how the last text begins; what is no ASCII letter may stand as any other character
  std::string code_;  ///< digits of the character that is written by its number
};

/// Whether such a document may go to this place. Errors: `bad_file`, where a report with remarks is.
Result<void> keep_remarks(const std::optional<std::string>& json);
/// The same of `clash`, which takes over those of its previous report: that one is replaced, and one that has no remark
/// beyond it.
Result<void> keep_remarks(const ClashArguments& arguments, const Previous& previous);

}  // namespace impinge::report
