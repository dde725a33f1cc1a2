// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "report/sink.hpp"

namespace impinge::report {

/// A zip archive, written member by member (PKWARE's APPNOTE 6.3.3, without its 64-bit forms). Members are dated 1980,
/// the first year that a zip can hold: the same members give the same bytes. zlib packs them; what lays them out is our
/// own, for libzip brings OpenSSL along and minizip goes back to what it wrote, which a document that is being written
/// cannot.
class Zip {
 public:
  explicit Zip(Sink& sink) : sink_(sink) {}

  /// `name` is ASCII, '/' between folders, and unlike any other. Without `packed` the bytes stand there as they are.
  /// Errors: `bad_file` where the archive gets larger than a zip can be.
  Result<void> add(std::string_view name, std::string_view bytes, bool packed);
  Result<void> finish();

 private:
  Result<void> write(std::string_view bytes);

  Sink& sink_;
  std::string directory_;  ///< what the archive ends with
  std::uint64_t written_ = 0;
  std::size_t members_ = 0;
};

/// Whether a file is an archive that `Zip` wrote, and no other tool has written to since: its comment has a digest of
/// its directory, in which the sizes and check sums of all members are.
bool is_untouched(int descriptor);

}  // namespace impinge::report
