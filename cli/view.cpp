// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include "commands.hpp"
#include "documents.hpp"
#include "progress.hpp"
#include "report/page.hpp"
#include "report/text.hpp"
#include "report/writers.hpp"
#include "scene_command.hpp"

namespace impinge::cli {

Result<void> view(const ViewArguments& arguments, const std::stop_token& stop) {
  Documents documents(arguments.files, arguments.force);
  if (auto ordered = documents.order({{kPage, arguments.html}}); !ordered) return ordered;
  const Result<std::string> page = read_page_template();
  if (!page) return page.error();

  ProgressLine line(STDERR_FILENO, !arguments.quiet);
  const Result<Assembly> assembly = read_assembly(arguments, line, stop);
  if (!assembly) return assembly.error();
  line.end();
  mention_missing(*assembly);
  if (!arguments.quiet) mention_warnings(*assembly);
  documents.write(kPage, [&](Sink& sink) {
    return write_page_of(sink, *page, *assembly, arguments, stop,
                         {[&](Sink& to) { return write_view_json(to, *assembly); }});
  });
  return documents.put_and_print(arguments.quiet, stop, [&](Sink& out, auto) {
    out.write(fmt::format("{}: {}, {}\n", printable(*arguments.html), counted(assembly->objects.size(), "part"),
                          counted(assembly->triangles, "triangle")));
  });
}

}  // namespace impinge::cli
