// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/zip.hpp"

#include <zlib.h>

#include <limits>
#include <new>

namespace impinge::cli {
namespace {

/// Integers with the lowest byte first, as they stand in a zip.
class Bytes {
 public:
  Bytes& u16(std::uint64_t value) { return put(value, 2); }
  Bytes& u32(std::uint64_t value) { return put(value, 4); }
  Bytes& text(std::string_view value) { return text_ += value, *this; }
  [[nodiscard]] const std::string& str() const { return text_; }

 private:
  Bytes& put(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) text_ += static_cast<char>(value >> (8 * i) & 0xFF);
    return *this;
  }
  std::string text_;
};

const Bytef* bytes_of(std::string_view text) { return reinterpret_cast<const Bytef*>(text.data()); }

/// A raw stream (RFC 1951).
std::string deflated(std::string_view text) {
  constexpr int kRaw = -15, kMemory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kRaw, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string out(deflateBound(&stream, static_cast<uLong>(text.size())), '\0');
  stream.next_in = const_cast<Bytef*>(bytes_of(text));  // zlib's older interface; it only reads
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  ::deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

Error too_large() { return {Code::bad_file, "the archive is larger than a zip file can be; ask for fewer topics"}; }

constexpr std::uint64_t kMostBytes = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMostMembers = 0xFFFE;  // one more says that a 64-bit form follows

}  // namespace

Result<void> Zip::write(std::string_view bytes) {
  sink_.write(bytes);
  written_ += bytes.size();
  if (written_ > kMostBytes) return too_large();
  return {};
}

Result<void> Zip::add(std::string_view name, std::string_view bytes, bool packed) {
  if (++members_ > kMostMembers || bytes.size() > kMostBytes / 2) return too_large();
  const std::string body = packed ? deflated(bytes) : std::string(bytes);
  constexpr std::uint64_t kVersion = 20, kStored = 0, kDeflated = 8;
  constexpr std::uint64_t kMidnight = 0, kFirstOf1980 = 1U << 5U | 1U;  // month and day, after seven bits of the year
  const uLong crc = crc32_z(crc32_z(0, nullptr, 0), bytes_of(bytes), bytes.size());
  // What the directory says of a member as well.
  const std::string about = Bytes()
                                .u16(kVersion)
                                .u16(0)
                                .u16(packed ? kDeflated : kStored)
                                .u16(kMidnight)
                                .u16(kFirstOf1980)
                                .u32(crc)
                                .u32(body.size())
                                .u32(bytes.size())
                                .u16(name.size())
                                .u16(0)
                                .str();
  directory_ += Bytes()
                    .text("PK\1\2")
                    .u16(kVersion)
                    .text(about)
                    .u16(0)  // no comment
                    .u16(0)  // on the first disk
                    .u16(0)
                    .u32(0)
                    .u32(written_)
                    .text(name)
                    .str();
  return write(Bytes().text("PK\3\4").text(about).text(name).text(body).str());
}

Result<void> Zip::finish() {
  const std::uint64_t start = written_;
  if (auto written = write(directory_); !written) return written;
  return write(
      Bytes().text("PK\5\6").u16(0).u16(0).u16(members_).u16(members_).u32(directory_.size()).u32(start).u16(0).str());
}

}  // namespace impinge::cli
