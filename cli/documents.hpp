// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <stop_token>
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

  struct Order {
    const DocumentKind& kind;
    const std::optional<std::string>& place;  ///< nothing: no such document is wanted
  };
  /// Where documents are to go. Errors: `bad_file`; `bad_option` (one of the files to read, or where another document
  /// goes).
  Result<void> order(std::initializer_list<Order> orders);

  /// Whether one of them takes the place of what the program prints.
  [[nodiscard]] bool on_standard_output() const;

  /// Writes the document of this kind if it was ordered, by `fill(sink)`. After the first error, which `put` tells,
  /// nothing more is written.
  template <class Fill>
  void write(const DocumentKind& kind, Fill&& fill) {
    for (Ordered& ordered : ordered_) {
      if (ordered.kind != &kind || !all_written_) continue;
      Result<Written> written = ordered.target.write(std::forward<Fill>(fill));
      if (written)
        ordered.written = *std::move(written);
      else
        all_written_ = written.error();
    }
  }

  /// Puts all of them in their places. Errors: as `Target::write`.
  Result<void> put();

  /// Puts them in their places, and lets `print(sink, width)` write to standard output, unless that is not wanted or
  /// has one of the documents. Errors: as `put`; `cancelled`.
  Result<void> put_and_print(bool quiet, const std::stop_token& stop,
                             const std::function<void(Sink&, std::optional<std::size_t> width)>& print);

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
  Result<void> all_written_;
};

}  // namespace impinge::cli
