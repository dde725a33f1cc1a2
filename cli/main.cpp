// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <exception>
#include <new>

#include "arguments.hpp"
#include "check.hpp"
#include "clash.hpp"
#include "devices.hpp"
#include "info.hpp"
#include "interrupt.hpp"
#include "motion.hpp"
#include "report/sink.hpp"
#include "view.hpp"

namespace {

using namespace impinge;
using namespace impinge::cli;

constexpr int kNothing = 0, kSomething = 1, kFailed = 2;

int failed(const Error& error) {
  complain(error.message);
  return kFailed;
}

int print_notice(const Notice& notice) {
  Sink out(STDOUT_FILENO, "standard output");
  out.write(notice.text);
  if (auto flushed = out.flush(); !flushed) return failed(flushed.error());
  return 0;
}

int run(int argc, char** argv) {
  const Result<Command> command = parse_command_line(argc, argv);
  if (!command) return failed(command.error());
  if (const auto* notice = std::get_if<Notice>(&*command)) return print_notice(*notice);

  if (std::holds_alternative<DevicesArguments>(*command)) {
    const Result<bool> usable = list_devices();
    if (!usable.has_value()) return failed(usable.error());
    return *usable ? 0 : kFailed;
  }

  const Interrupt interrupt;
  if (const auto* arguments = std::get_if<CheckArguments>(&*command)) {
    const Result<bool> touches = check(*arguments, interrupt.token());
    if (!touches.has_value()) return failed(touches.error());
    return *touches ? kSomething : kNothing;
  }
  if (const auto* arguments = std::get_if<ClashArguments>(&*command)) {
    const Result<bool> fails = clash(*arguments, interrupt.token());
    if (!fails.has_value()) return failed(fails.error());
    return *fails ? kSomething : kNothing;
  }
  if (const auto* arguments = std::get_if<MotionArguments>(&*command)) {
    const Result<bool> clashes = motion(*arguments, interrupt.token());
    if (!clashes.has_value()) return failed(clashes.error());
    return *clashes ? kSomething : kNothing;
  }
  if (const auto* arguments = std::get_if<ViewArguments>(&*command)) {
    const Result<void> written = view(*arguments, interrupt.token());
    return written ? 0 : failed(written.error());
  }
  const Result<bool> all_read = info(std::get<InfoArguments>(*command), interrupt.token());
  if (!all_read.has_value()) return failed(all_read.error());
  return *all_read ? 0 : kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  fill_closed_descriptors();
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    complain("out of memory; a smaller --limit or --first keeps less of the answer");
  } catch (const std::exception& error) {
    complain(error.what());
  }
  return kFailed;
}
