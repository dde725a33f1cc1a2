// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "terminal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

#include "numbers.hpp"
#include "report/sink.hpp"
#include "report/text.hpp"

namespace impinge::cli {
using namespace report;

void complain(std::string_view sentence) {
  Sink errors(STDERR_FILENO, "standard error");
  errors.write(fmt::format("impinge: {}\n", printable(sentence)));
  // There is nowhere left to report to if this fails; the exit status still tells.
  if (!errors.flush()) return;
}

std::optional<std::size_t> width_of(int descriptor) {
  winsize size{};
  if (::isatty(descriptor) == 1 && ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  if (const char* const text = std::getenv("COLUMNS"))
    if (const auto columns = parse_number<std::size_t>(text); columns && *columns > 0) return columns;
  return std::nullopt;
}

void fill_closed_descriptors() {
  // `open` gives the lowest free descriptor, so the order matters. Read-only on 1: writing there must fail.
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    const int opened = ::open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    if (opened >= 0 && opened != descriptor) ::close(opened);
  }
}

}  // namespace impinge::cli
