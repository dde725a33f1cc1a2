// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/bcf/zip.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <array>
#include <memory>

#include "report/assembly.hpp"

namespace impinge::report {
namespace {

/// False where libzip refuses; the archive knows why.
bool add_member(zip_t* archive, const Member& member) {
  constexpr zip_uint16_t kMidnight = 0, kFirstOf1980 = 1U << 5U | 1U;  // month and day, after seven bits of the year
  constexpr zip_uint32_t kUsualLevel = 6;                              // of deflate; libzip's own is the slowest, 9
  zip_source_t* const source = zip_source_buffer(archive, member.bytes.data(), member.bytes.size(), 0);
  const zip_int64_t added = zip_file_add(archive, member.name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (added < 0) {
    zip_source_free(source);
    return false;
  }
  const auto index = static_cast<zip_uint64_t>(added);
  return zip_set_file_compression(archive, index, member.packed ? ZIP_CM_DEFLATE : ZIP_CM_STORE, kUsualLevel) == 0 &&
         zip_file_set_dostime(archive, index, kMidnight, kFirstOf1980, 0) == 0;
}

/// Copies a finished archive. False where libzip refuses to read it.
bool copy_archive(zip_source_t* from, Sink& to) {
  if (zip_source_open(from) != 0) return false;
  std::array<char, 1 << 16> piece{};
  zip_int64_t got = 0;
  while ((got = zip_source_read(from, piece.data(), piece.size())) > 0)
    to.write({piece.data(), static_cast<std::size_t>(got)});
  zip_source_close(from);
  return got == 0;
}

int is_stopped(zip_t*, void* stop) { return static_cast<const std::stop_token*>(stop)->stop_requested() ? 1 : 0; }

}  // namespace

Result<void> write_zip(Sink& sink, std::span<const Member> members, const std::stop_token& stop) {
  const auto refused = [](zip_error_t* error) {
    return Error{Code::bad_file, fmt::format("the archive cannot be made: {}", zip_error_strerror(error))};
  };
  zip_error_t error;
  zip_error_init(&error);
  const std::unique_ptr<zip_source_t, decltype(&zip_source_free)> bytes(zip_source_buffer_create(nullptr, 0, 0, &error),
                                                                        zip_source_free);
  if (!bytes) return refused(&error);
  std::unique_ptr<zip_t, decltype(&zip_discard)> archive(zip_open_from_source(bytes.get(), ZIP_TRUNCATE, &error),
                                                         zip_discard);
  if (!archive) return refused(&error);
  zip_source_keep(bytes.get());  // the archive has the other hold on it
  std::stop_token stopping = stop;
  zip_register_cancel_callback_with_state(archive.get(), is_stopped, nullptr, &stopping);
  for (const Member& member : members)
    if (!add_member(archive.get(), member)) return refused(zip_get_error(archive.get()));
  if (zip_close(archive.get()) != 0)
    return stop.stop_requested() ? interrupted() : refused(zip_get_error(archive.get()));
  static_cast<void>(archive.release());
  if (!copy_archive(bytes.get(), sink)) return refused(zip_source_error(bytes.get()));
  return {};
}

}  // namespace impinge::report
