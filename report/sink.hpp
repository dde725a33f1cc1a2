// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "impinge/result.hpp"

/// Where bytes go: standard output or a file that appears whole or not at all. Write errors are kept, not lost.
namespace impinge::report {

/// Buffered writing to a file descriptor that someone else owns. After the first error nothing more is written.
class Sink {
 public:
  /// `name` says in messages where the bytes went.
  Sink(int descriptor, std::string name);

  void write(std::string_view bytes);
  /// From here on a JSON document is written within a page: '<', which only stands in strings there, becomes \u003c, so
  /// that no name can end the element that holds it. Until it is turned off.
  void in_page(bool on) noexcept { in_page_ = on; }
  /// Writes what is still buffered. Errors: `bad_file`, with the first reason that writing failed for.
  Result<void> flush();
  [[nodiscard]] bool failed() const noexcept { return error_ != 0; }

 private:
  void drain();

  int descriptor_;
  std::string name_;
  std::string buffer_;
  bool in_page_ = false;
  int error_ = 0;  ///< errno of the first failure
};

/// A kind of document: the option that asks for one, what it is called, and how the names of such files end.
struct DocumentKind {
  std::string_view option, noun;
  std::string_view ending, other_ending = ending;
};
extern const DocumentKind kJson, kPage, kCsv, kMatrix, kImpactTable, kBcf, kGltf;

/// A document that is complete, and beside its place rather than in it. Without `put` it vanishes, and what was in the
/// place stays. Where bytes go straight to their place there is nothing left to do.
class Written {
 public:
  Written() = default;
  Written(std::filesystem::path temporary, std::filesystem::path place)
      : temporary_(std::move(temporary)), place_(std::move(place)) {}
  ~Written();
  Written(Written&& other) noexcept;
  Written& operator=(Written&& other) noexcept;
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;

  /// Errors: `bad_file`.
  Result<void> put();

 private:
  std::filesystem::path temporary_, place_;  ///< both empty: nothing to put
};

/// The place that a document is written to. A regular file is written beside itself and renamed at the end, so
/// that nobody sees half of it; a device or a pipe is written directly; "-" is standard output.
class Target {
 public:
  /// Looks whether the place can be written, before long work begins. An existing file is replaced only if it is empty
  /// or its name ends as those of such documents do, unless `force` is set: `--json a.obj b.obj` must not cost its
  /// author a.obj. A link stays a link, and what it points to is written. Errors: `bad_file`.
  static Result<Target> check(std::string_view name, const DocumentKind& kind, bool force = false);

  [[nodiscard]] bool is_standard_output() const noexcept { return standard_output_; }

  /// Calls `fill(sink)`, which says whether the document is complete. Errors: those of `fill`; `bad_file` where it
  /// cannot be written. The old file stays in any case.
  template <class Fill>
  Result<Written> write(Fill&& fill) const {
    Result<Opened> opened = open();
    if (!opened) return opened.error();
    Sink sink(opened->descriptor, opened->name);
    Result<void> filled = fill(sink);
    if (filled) filled = sink.flush();
    return close(*opened, std::move(filled));
  }

 private:
  struct Opened {
    int descriptor;
    std::string name;
    std::string temporary;  ///< empty where the bytes go straight to their place
  };
  Result<Opened> open() const;
  Result<Written> close(const Opened& opened, Result<void> filled) const;

  bool standard_output_ = false;
  bool direct_ = false;
  std::filesystem::path place_;
};

/// Where the bytes of a file of this name lie or would lie: what a link points to, also if nothing is there yet. Of
/// links that lead in a circle, one of them.
std::filesystem::path place_behind(const std::filesystem::path& name);

}  // namespace impinge::report
