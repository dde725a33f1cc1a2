// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "impinge/report.hpp"
#include "report/drawn_scene.hpp"
#include "report/sink.hpp"

namespace impinge::report {

/// The page's program, in which a report is written. If it is not named, it is looked for at `IMPINGE_PAGE`, beside the
/// running program, where it is installed and where `./dev` builds it. Errors: `bad_file`, with where it was looked
/// for.
Result<std::string> read_page_template(const std::string& named = {});

/// What a page needs to know beside what is drawn.
struct PageHead {
  std::string title;  ///< the names of the files, without their folders
  bool y_up = false;  ///< or Z
};
PageHead head_of(const std::vector<std::string>& files, const PageOptions& options);

/// A sentence where the page draws fewer triangles than there are, or more than were asked for; else nothing.
std::optional<std::string> simplified(const DrawnScene& scene);

/// Writes a page that needs nothing else: the template, with the report and what is drawn in its middle
/// (page/README.md describes them). `write_report` writes the report's JSON. Errors: those of `write_report`;
/// `cancelled`. `write_motion`, if there is one, writes what the timeline plays.
Result<void> write_page(Sink& sink, const std::string& page_template, const PageHead& head, const DrawnScene& scene,
                        const std::function<Result<void>(Sink&)>& write_report, const std::stop_token& stop,
                        const std::function<Result<void>(Sink&)>& write_motion = {});

}  // namespace impinge::report
