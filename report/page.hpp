// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "impinge/report.hpp"
#include "report/drawn_scene.hpp"
#include "report/sink.hpp"

namespace impinge::report {

/// The page's program, in which a report is written. If it is not named, it is looked for at `IMPINGE_PAGE`, beside the
/// running program, where it is installed and where `./dev` builds it. Errors: `bad_file`, with where it was looked
/// for.
Result<std::string> read_page_template(const std::string& named = {});

/// What a page holds beside the assembly.
struct PageBlocks {
  std::function<Result<void>(Sink&)> report;  ///< writes the report's JSON
  /// Writes what the timeline plays; empty: there is none.
  std::function<Result<void>(Sink&, const DrawnScene&)> motion{};
  /// Is told a sentence where the page draws fewer triangles than there are, or more than were asked for.
  std::function<void(const std::string&)> warn = [](const std::string&) {};
};

/// Writes a page that needs nothing else: the template, with the report and what is drawn in its middle
/// (page/README.md describes them). Errors: those of the blocks; `cancelled`.
Result<void> write_page(Sink& sink, const std::string& page_template, const Assembly& assembly,
                        const PageOptions& options, const PageBlocks& blocks, const std::stop_token& stop);

}  // namespace impinge::report
