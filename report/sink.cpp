// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/sink.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "report/text.hpp"

namespace impinge::report {
namespace {

std::string reason(int error) { return std::system_category().message(error); }

Error cannot_write(std::string_view name, int error) {
  return {Code::bad_file, fmt::format("cannot write to {}: {}", name, reason(error))};
}

std::string in_quotes(const std::filesystem::path& path) { return fmt::format("'{}'", path.native()); }

/// The mode that a file made by `open(2)` would get.
mode_t usual_mode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

}  // namespace

const DocumentKind kJson{"--json", "JSON", ".json"}, kPage{"--html", "page", ".html"},
    kCsv{"--csv", "table of clashes", ".csv"}, kMatrix{"--matrix", "table of counts", ".csv"},
    kImpactTable{"--csv", "table of impacts", ".csv"}, kBcf{"--bcf", "BCF", ".bcf", ".bcfzip"},
    kGltf{"--gltf", "binary glTF", ".glb"};

Sink::Sink(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}

void Sink::write(std::string_view bytes) {
  constexpr std::size_t kBufferBytes = 1 << 16;
  if (failed()) return;
  if (in_page_) {
    for (const char c : bytes) c == '<' ? buffer_ += "\\u003c" : buffer_ += c;
  } else {
    buffer_ += bytes;
  }
  if (buffer_.size() >= kBufferBytes) drain();
}

void Sink::drain() {
  std::string_view left = buffer_;
  while (!left.empty() && !failed()) {
    const ssize_t put = ::write(descriptor_, left.data(), left.size());
    if (put >= 0) {
      left.remove_prefix(static_cast<std::size_t>(put));
    } else if (errno == EAGAIN) {  // somebody set a shared terminal or pipe to non-blocking
      pollfd ready{descriptor_, POLLOUT, 0};
      ::poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      error_ = errno;
    }
  }
  buffer_.clear();
}

Result<void> Sink::flush() {
  drain();
  if (failed()) return cannot_write(name_, error_);
  return {};
}

Result<Target> Target::check(std::string_view name, const DocumentKind& kind, bool force) {
  Target target;
  if (name == "-") {
    target.standard_output_ = true;
    return target;
  }
  target.place_ = place_behind(name);
  std::error_code unknown;
  if (std::filesystem::is_symlink(target.place_, unknown)) return cannot_write(in_quotes(name), ELOOP);

  struct stat about {};
  if (::stat(target.place_.c_str(), &about) == 0) {
    if (S_ISDIR(about.st_mode))
      return Error{Code::bad_file,
                   fmt::format("{} is a directory; name a file for the {}", in_quotes(name), kind.noun)};
    target.direct_ = !S_ISREG(about.st_mode);
    if (::access(target.place_.c_str(), W_OK) != 0) return cannot_write(in_quotes(name), errno);
    const std::string ending = target.place_.extension();
    const bool is_own = ending == kind.ending || ending == kind.other_ending;
    if (!target.direct_ && !is_own && !force && about.st_size > 0)
      return Error{Code::bad_file,
                   fmt::format("{} exists and does not end in {}, so it is not replaced: the word after {} is the file "
                               "to write; --force replaces it",
                               in_quotes(target.place_), kind.ending, kind.option)};
  }
  if (!target.direct_) {
    auto folder = target.place_.parent_path();
    if (folder.empty()) folder = ".";
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
      return Error{Code::bad_file, fmt::format("cannot write to {}: cannot create files in {}: {}", in_quotes(name),
                                               in_quotes(folder), reason(errno))};
  }
  return target;
}

Result<Target::Opened> Target::open() const {
  if (standard_output_) return Opened{STDOUT_FILENO, "standard output", {}};
  if (direct_) {
    const int descriptor = ::open(place_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return cannot_write(in_quotes(place_), errno);
    return Opened{descriptor, in_quotes(place_), {}};
  }
  std::string temporary = place_.native() + ".XXXXXX";
  const int descriptor = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (descriptor < 0) return cannot_write(in_quotes(place_), errno);
  struct stat old {};
  ::fchmod(descriptor, ::stat(place_.c_str(), &old) == 0 ? old.st_mode & 07777U : usual_mode());
  return Opened{descriptor, in_quotes(place_), std::move(temporary)};
}

Result<Written> Target::close(const Opened& opened, Result<void> filled) const {
  Written written = opened.temporary.empty() ? Written() : Written(opened.temporary, place_);
  // A full disk or a lost network drive may show only here.
  if (!standard_output_ && ::close(opened.descriptor) != 0 && filled) filled = cannot_write(opened.name, errno);
  if (!filled) return filled.error();
  return written;
}

Written::~Written() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Written::Written(Written&& other) noexcept
    : temporary_(std::exchange(other.temporary_, {})), place_(std::exchange(other.place_, {})) {}

Written& Written::operator=(Written&& other) noexcept {
  std::swap(temporary_, other.temporary_);
  std::swap(place_, other.place_);
  return *this;
}

Result<void> Written::put() {
  if (temporary_.empty()) return {};
  if (::rename(temporary_.c_str(), place_.c_str()) != 0) return cannot_write(in_quotes(place_), errno);
  temporary_.clear();
  return {};
}

std::filesystem::path place_behind(const std::filesystem::path& name) {
  constexpr int kMostLinks = 40;  // as the system allows
  std::error_code unknown;
  if (auto real = std::filesystem::canonical(name, unknown); !unknown) return real;
  std::filesystem::path place = name;
  for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(place, unknown); ++i) {
    const auto next = std::filesystem::read_symlink(place, unknown);
    if (unknown) break;
    place = place.parent_path() / next;  // which is `next` alone if that begins at the root
  }
  return place;
}

}  // namespace impinge::report
