// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include "commands.hpp"
#include "documents.hpp"
#include "progress.hpp"
#include "report/assembly.hpp"
#include "report/page.hpp"
#include "report/text.hpp"
#include "report/writers.hpp"
#include "scene_command.hpp"
#include "terminal.hpp"

namespace impinge::cli {

Result<void> view(const ViewArguments& arguments, const std::stop_token& stop) {
  Documents documents(arguments.files, arguments.force);
  if (auto ordered = documents.order(kPage, arguments.html); !ordered) return ordered;
  const Result<std::string> page = read_page_template();
  if (!page) return page.error();

  ProgressLine line(STDERR_FILENO, !arguments.quiet);
  const Result<Assembly> assembly = read_assembly(arguments, line, stop);
  if (!assembly) return assembly.error();
  line.phase("drawing");
  const Result<DrawnScene> scene = draw(*assembly, arguments.page_triangles, stop);
  if (!scene) return scene.error();
  line.end();
  mention_missing(*assembly);
  if (!arguments.quiet) mention_warnings(*assembly);
  if (const auto warning = simplified(*scene); warning && !arguments.quiet) complain(*warning);

  auto written = documents.write(kPage, [&](Sink& sink) {
    const auto write_report = [&](Sink& to) { return write_view_json(to, *assembly); };
    return write_page(sink, *page, head_of(arguments.files, arguments), *scene, write_report, stop);
  });
  if (written) written = documents.put();
  if (!written || arguments.quiet || documents.on_standard_output()) return written;
  Sink out(STDOUT_FILENO, "standard output");
  out.write(fmt::format("{}: {}, {}\n", printable(*arguments.html), counted(assembly->objects.size(), "part"),
                        counted(assembly->triangles, "triangle")));
  return out.flush();
}

}  // namespace impinge::cli
