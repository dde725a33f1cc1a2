// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/sink.hpp"

namespace impinge::cli {
using namespace report;

/// Whether two names are of one file, also where none is yet. Standard output, "-", is one.
bool is_one_place(const std::string& a, const std::string& b);

/// The documents that a call is asked for. Their places are looked at before long work begins, and what was in them
/// stays until all documents are complete: an earlier run's JSON is not lost to a disk that is too full for the page.
class Documents {
 public:
  /// `files` are those that the call reads, which no document may replace.
  explicit Documents(const std::vector<std::string>& files) : files_(files) {}

  /// Where a document of this kind is to go; nothing without a place. `known` names one of this kind, or what the call
  /// refuses before it writes. Errors: `bad_file`; `bad_option` (one of the files to read, or where another document
  /// goes).
  Result<void> order(const DocumentKind& kind, const std::optional<std::string>& place,
                     const std::optional<std::string>& known = {});

  /// Whether one of them takes the place of what the program prints.
  [[nodiscard]] bool on_standard_output() const;

  /// Writes the document of this kind if it was ordered, by `fill(sink)`. Errors: as `Target::write`.
  template <class Fill>
  Result<void> write(const DocumentKind& kind, Fill&& fill) {
    for (Ordered& ordered : ordered_) {
      if (ordered.kind != &kind) continue;
      Result<Written> written = ordered.target.write(std::forward<Fill>(fill));
      if (!written) return written.error();
      ordered.written = *std::move(written);
    }
    return {};
  }

  /// Puts all of them in their places. Errors: `bad_file`.
  Result<void> put();

 private:
  struct Ordered {
    const DocumentKind* kind;
    std::string place;
    Target target;
    Written written{};
  };
  const std::vector<std::string>& files_;
  std::vector<Ordered> ordered_;
};

}  // namespace impinge::cli
