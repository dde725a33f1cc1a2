// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene_command.hpp"

#include <fmt/format.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>
#include <system_error>
#include <vector>

#include "report/text.hpp"
#include "terminal.hpp"

namespace impinge::cli {

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Result<Assembly> read_assembly(const SceneOptions& options, ProgressLine& line, const std::stop_token& stop) {
  constexpr double kMega = 1e6;
  const std::vector<std::string>& files = options.files;
  std::vector<double> sizes;  // in megabytes
  for (const std::string& file : files) {
    std::error_code unknown;
    const auto bytes = std::filesystem::file_size(file, unknown);
    sizes.push_back(unknown ? 0 : static_cast<double>(bytes) / kMega);
  }
  SceneOptions stoppable = options;
  stoppable.stop = stop;
  // Of a single file nobody knows how far it is read.
  const double total = files.size() > 1 ? std::accumulate(sizes.begin(), sizes.end(), 0.0) : 0;
  const auto done = std::make_shared<std::atomic<double>>(0);  // the line outlives the reading
  return report::read_assembly(stoppable, [&](std::size_t i, bool is_read) {
    if (is_read)
      *done += sizes[i];
    else
      line.phase(
          fmt::format("reading {} ({} of {})", printable(files[i]), i + 1, files.size()),
          [done, total] {
            return Work{*done, total};
          },
          "MB");
  });
}

void mention_missing(const Assembly& assembly) {
  for (const std::string& sentence : assembly.missing) complain(sentence);
}

void mention_warnings(const Assembly& assembly) {
  for (const std::string& sentence : assembly.alignment) complain(sentence);
  if (assembly.warnings.empty()) return;
  complain(fmt::format("{} about these files, listed by impinge info", counted(assembly.warnings.size(), "warning")));
}

}  // namespace impinge::cli
