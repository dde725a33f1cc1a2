// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <exception>
#include <new>

#include "commands.hpp"
#include "interrupt.hpp"
#include "report/sink.hpp"
#include "terminal.hpp"

namespace {

using namespace impinge;
using namespace impinge::cli;

constexpr int kNothing = 0, kSomething = 1, kFailed = 2;

int failed(const Error& error) {
  complain(error.message);
  return kFailed;
}

int exit_code(const Result<bool>& answer, int if_true, int if_false) {
  if (!answer.has_value()) return failed(answer.error());
  return *answer ? if_true : if_false;
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
  if (std::holds_alternative<DevicesArguments>(*command)) return exit_code(list_devices(), 0, kFailed);

  const Interrupt interrupt;
  const std::stop_token stop = interrupt.token();
  if (const auto* arguments = std::get_if<CheckArguments>(&*command))
    return exit_code(check(*arguments, stop), kSomething, kNothing);
  if (const auto* arguments = std::get_if<ClashArguments>(&*command))
    return exit_code(clash(*arguments, stop), kSomething, kNothing);
  if (const auto* arguments = std::get_if<MotionArguments>(&*command))
    return exit_code(motion(*arguments, stop), kSomething, kNothing);
  if (const auto* arguments = std::get_if<ImpactsArguments>(&*command))
    return exit_code(impacts(*arguments, stop), kSomething, kNothing);
  if (const auto* arguments = std::get_if<ViewArguments>(&*command)) {
    const Result<void> written = view(*arguments, stop);
    return written ? 0 : failed(written.error());
  }
  return exit_code(info(std::get<InfoArguments>(*command), stop), 0, kFailed);
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
