// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <stop_token>
#include <string>

#include "report/sink.hpp"

namespace impinge::report {

/// A file of an archive.
struct Member {
  std::string name, bytes;
  bool packed = true;  ///< compressed; a PNG is already
};

/// Writes a zip archive, by libzip. Members are dated 1980, the first year that a zip can hold: the same members give
/// the same bytes. The archive is laid out in memory first, as libzip goes back to what it wrote and a pipe cannot.
/// Errors: `bad_file`, with libzip's reason; `cancelled`.
Result<void> write_zip(Sink& sink, std::span<const Member> members, const std::stop_token& stop);

}  // namespace impinge::report
