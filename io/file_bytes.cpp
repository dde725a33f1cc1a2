// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/file_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace impinge::io {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

Error system_error(const Source& source, int code) {
  return file_error(source, sentence("the file cannot be read: ", std::strerror(code)));
}

/// The size of what `status` describes, if it is a file to read.
Result<std::uint64_t> size_to_read(const struct stat& status, std::uint64_t max_bytes, const Source& source) {
  if (S_ISDIR(status.st_mode)) return file_error(source, "this is a directory; name a mesh file in it");
  if (!S_ISREG(status.st_mode)) return file_error(source, "this is no regular file; copy its contents into one");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size == 0) return file_error(source, "the file is empty; export it again");
  if (size > max_bytes) {
    return file_error(source, sentence("the file has ", size, " bytes, more than the limit of ", max_bytes,
                                       "; raise the limit if it is good"));
  }
  return size;
}

/// Opens a file without waiting, for a pipe may lie under its name.
Result<std::uint64_t> open_and_measure(const Descriptor& descriptor, std::uint64_t max_bytes, const Source& source) {
  struct stat status {};
  if (descriptor.number() < 0 || fstat(descriptor.number(), &status) != 0) return system_error(source, errno);
  return size_to_read(status, max_bytes, source);
}

int open_file(const std::filesystem::path& file) {
  struct stat status {};
  // Opening a device may have effects of its own.
  if (stat(file.c_str(), &status) == 0 && (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode))) {
    return open("/dev/null", O_RDONLY | O_CLOEXEC);
  }
  return open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
}

}  // namespace

Result<void> check_file(const std::filesystem::path& file, std::uint64_t max_bytes, const Source& source) {
  const Descriptor descriptor(open_file(file));
  if (const auto size = open_and_measure(descriptor, max_bytes, source); !size) return size.error();
  return {};
}

Result<std::string> read_file(const std::filesystem::path& file, std::uint64_t max_bytes, const Source& source) {
  const Descriptor descriptor(open_file(file));
  const Result<std::uint64_t> size = open_and_measure(descriptor, max_bytes, source);
  if (!size) return size.error();
  std::string bytes(*size, '\0');
  std::size_t done = 0;
  while (done < *size) {
    const ssize_t count = ::read(descriptor.number(), bytes.data() + done, *size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return system_error(source, errno);
    if (count == 0) break;  // the file has become shorter meanwhile
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace impinge::io
