// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "interrupt.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace impinge::cli {
namespace {

// A stop request locks and allocates, which a signal handler may not do; the handler writes to this pipe instead, and a
// thread that reads from it makes the request. Handlers, unlike a blocked signal mask, are not inherited by the child
// process that reads files.
int wake_read = -1;
int wake_write = -1;

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
constexpr char kStop = 's', kEnd = 'e';

void wake(int /*signal*/) {
  const int saved = errno;
  if (::write(wake_write, &kStop, 1) < 0) {
    // The pipe is full of earlier requests.
  }
  errno = saved;
}

void do_nothing(int /*signal*/) {}

void handle(int signal, void (*handler)(int), unsigned flags) {
  struct sigaction old {};
  if (::sigaction(signal, nullptr, &old) != 0 || old.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(flags);
  ::sigemptyset(&action.sa_mask);
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

Interrupt::Interrupt() {
  int ends[2];
  // Without a pipe (no descriptors left) signals end the program as they always did.
  if (::pipe2(ends, O_CLOEXEC) != 0) return;
  wake_read = ends[0];
  wake_write = ends[1];
  ::fcntl(wake_write, F_SETFL, O_NONBLOCK);
  listener_ = std::jthread([this] {
    for (char what = 0;;) {
      const ssize_t got = ::read(wake_read, &what, 1);
      if (got < 0 && errno == EINTR) continue;
      if (got == 1 && what == kStop) source_.request_stop();
      if (got != 1 || what == kEnd) return;
    }
  });
  for (const int signal : kSignals) handle(signal, wake, SA_RESTART | static_cast<unsigned>(SA_RESETHAND));
  // The child process would inherit SIG_IGN.
  handle(SIGPIPE, do_nothing, SA_RESTART);
  handle(SIGXFSZ, do_nothing, SA_RESTART);
}

Interrupt::~Interrupt() {
  if (wake_write < 0) return;
  for (const int signal : kSignals) handle(signal, SIG_DFL, 0);
  // A full pipe holds stop requests, which the listener is reading: it will have room.
  while (::write(wake_write, &kEnd, 1) < 0 && (errno == EAGAIN || errno == EINTR)) std::this_thread::yield();
  listener_.join();
  ::close(wake_read);
  ::close(wake_write);
  wake_read = wake_write = -1;
}

}  // namespace impinge::cli
