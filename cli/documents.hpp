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

/// The documents that a call is asked for. Their places are looked at before long work begins, and what was in them
/// stays until all documents are complete: an earlier run's JSON is not lost to a disk that is too full for the page.
class Documents {
 public:
  /// `files` are those that the call reads, which no document may replace; other files whose names do not end as those
  /// of the document do are replaced only with `force`.
  Documents(const std::vector<std::string>& files, bool force) : files_(files), force_(force) {}

  /// Where a document of this kind is to go; nothing without a place. Errors: `bad_file`; `bad_option` (one of the
  /// files to read, or where another document goes).
  Result<void> order(const DocumentKind& kind, const std::optional<std::string>& place);

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
  bool force_;
  std::vector<Ordered> ordered_;
};

}  // namespace impinge::cli
