// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <chrono>
#include <stop_token>
#include <string>
#include <utility>

#include "arguments.hpp"
#include "impinge/options.hpp"
#include "progress.hpp"
#include "report/assembly.hpp"
#include "report/page.hpp"
#include "report/scene.hpp"
#include "terminal.hpp"

/// What `check` and `clash` do alike.
namespace impinge::cli {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start);

/// Reads the files while a line shows how far that is. Errors: as the library's `read_assembly`.
Result<Assembly> read_assembly(const SceneOptions& options, ProgressLine& line, const std::stop_token& stop);

/// What `run(progress)` returns, while a line shows how far it is; `cancelled` after a request to stop.
template <class Run>
auto with_progress(ProgressLine& line, std::string label, std::string unit, const std::stop_token& stop, Run&& run) {
  Progress progress;
  const auto so_far = [&progress] {
    return Work{static_cast<double>(progress.done.load()), static_cast<double>(progress.total.load())};
  };
  line.phase(std::move(label), so_far, std::move(unit));
  auto result = run(progress);
  line.end();  // its thread reads `progress`
  if (stop.stop_requested()) result = interrupted();
  return result;
}

/// Writes a page as `write_page`, and says on standard error where it draws something else than the model.
template <class Arguments>
Result<void> write_page_of(Sink& sink, const std::string& page, const Assembly& assembly, const Arguments& arguments,
                           const std::stop_token& stop, PageBlocks blocks) {
  ProgressLine line(STDERR_FILENO, !arguments.quiet);
  line.phase("drawing");
  if (!arguments.quiet) blocks.warn = [&](const std::string& sentence) { line.end(), complain(sentence); };
  return write_page(sink, page, assembly, arguments, blocks, stop);
}

/// Says on standard error what of the files no answer is about; also where everything else is quiet, for nothing that
/// is found may mean nothing then.
void mention_missing(const Assembly& assembly);
/// Says on standard error how the files were aligned, and that they have warnings, if they have.
void mention_warnings(const Assembly& assembly);

}  // namespace impinge::cli
