// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/bcf/zip.hpp"

#include <unistd.h>
#include <zlib.h>

#include <limits>
#include <new>

#include "report/identity.hpp"

namespace impinge::report {
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

constexpr std::string_view kEnd = "PK\5\6";
constexpr std::size_t kEndBytes = 22;  // without the comment

std::string comment_of(const std::string& directory) { return "impinge " + guid_of(directory); }

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
  const std::string comment = comment_of(directory_);
  return write(Bytes()
                   .text(kEnd)
                   .u16(0)
                   .u16(0)
                   .u16(members_)
                   .u16(members_)
                   .u32(directory_.size())
                   .u32(start)
                   .u16(comment.size())
                   .text(comment)
                   .str());
}

bool is_untouched(int descriptor) {
  constexpr std::size_t kMostBytesOfDirectory = 1 << 26;
  const std::size_t end_size = kEndBytes + comment_of({}).size();
  const off_t size = ::lseek(descriptor, 0, SEEK_END);
  std::string end(end_size, '\0');
  const auto read = [&](std::string& text, off_t at) {
    return at >= 0 && ::pread(descriptor, text.data(), text.size(), at) == static_cast<ssize_t>(text.size());
  };
  if (!read(end, size - static_cast<off_t>(end_size)) || !end.starts_with(kEnd)) return false;
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8U | static_cast<unsigned char>(end[at + i]);
    return value;
  };
  const std::size_t bytes = number(12);
  const off_t start = number(16);
  if (bytes > kMostBytesOfDirectory || start + static_cast<off_t>(bytes + end_size) != size) return false;
  std::string directory(bytes, '\0');
  return read(directory, start) && end.substr(kEndBytes) == comment_of(directory);
}

}  // namespace impinge::report
