// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "check.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <system_error>

#include "assembly.hpp"
#include "calibration_cache.hpp"
#include "ignore.hpp"
#include "impinge/scene.hpp"
#include "json_writer.hpp"
#include "progress.hpp"
#include "sink.hpp"
#include "stats.hpp"
#include "table.hpp"
#include "text.hpp"

namespace impinge::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Answer {
  Assembly assembly;
  Contacts contacts;
  double read_seconds = 0;
  double check_seconds = 0;
};

Result<void> refuse_overwriting_input(const CheckArguments& arguments) {
  for (const std::string& file : arguments.files) {
    std::error_code unknown;
    if (*arguments.json != "-" && std::filesystem::equivalent(*arguments.json, file, unknown))
      return Error{Code::bad_option, fmt::format("--json {} is one of the files to read", *arguments.json)};
  }
  return {};
}

Result<Contacts> collide(const CheckArguments& arguments, const Assembly& assembly, ProgressLine& line,
                         const std::stop_token& stop) {
  Scene scene;
  std::vector<ObjectId> ids;
  ids.reserve(assembly.objects.size());
  for (std::size_t i = 0; i < assembly.objects.size(); ++i) {
    Result<ObjectId> id = scene.add(assembly.objects[i].mesh, assembly.objects[i].pose);
    if (!id)
      return Error{id.error().code, fmt::format("{}: object '{}': {}", assembly.files[assembly.file_of[i]],
                                                assembly.labels[i], id.error().message)};
    ids.push_back(*id);
  }
  if (auto ignored = ignore_pairs(assembly, arguments.ignored, ids, scene); !ignored) return ignored.error();
  if (auto updated = scene.update(); !updated) return updated.error();

  std::optional<CalibrationCache> cache;
  if (arguments.backend == "hybrid") cache.emplace();
  Progress progress;
  Options options;
  options.find = arguments.first ? Options::Find::first : Options::Find::all;
  options.limit = arguments.limit;
  options.threads = arguments.threads;
  options.backend = arguments.backend;
  options.device = arguments.device;
  options.device_share = arguments.device_share;
  options.predict_cost = arguments.stats;
  options.progress = &progress;
  options.stop = stop;
  line.phase(fmt::format("checking {}", counted(assembly.objects.size(), "object")), [&progress] {
    const std::uint64_t total = progress.total.load();
    return total > 0 ? static_cast<double>(progress.done.load()) / static_cast<double>(total) : -1.0;
  });
  Result<Contacts> contacts = scene.collide(options);
  line.end();  // it looks at `progress`
  if (stop.stop_requested()) return interrupted();
  return contacts;
}

Result<Answer> find_answer(const CheckArguments& arguments, const std::stop_token& stop) {
  ProgressLine line(STDERR_FILENO, !arguments.quiet);
  const auto start = Clock::now();
  Result<Assembly> assembly = read_assembly(arguments, line, stop);
  if (!assembly) return assembly.error();
  const double read_seconds = seconds_since(start);
  const auto read = Clock::now();
  Result<Contacts> contacts = collide(arguments, *assembly, line, stop);
  if (!contacts) return contacts.error();
  return Answer{std::move(*assembly), std::move(*contacts), read_seconds, seconds_since(read)};
}

Table table_of_pairs(const Answer& answer, bool first) {
  using enum Column::Kind;
  Table table;
  table.rows = answer.contacts.objects.size();
  table.columns = {{"object", name}, {"object", name}};
  if (first) {
    table.columns.push_back({"witness", text});
  } else {
    for (const char* heading : {"crossing", "touching", "coplanar"}) table.columns.push_back({heading, number});
  }
  table.cell = [&answer, first](std::size_t row, std::size_t column) -> std::string {
    const Contacts& contacts = answer.contacts;
    if (column < 2) return answer.assembly.labels[contacts.objects[row][column]];
    if (first) return std::string(kind_name(contacts.kinds[contacts.offsets[row]]));
    const RowCounts counts = count_row(contacts, row);
    return grouped(column == 2 ? counts.crossing : column == 3 ? counts.touching : counts.coplanar);
  };
  return table;
}

std::string summary(const Answer& answer, const CheckArguments& arguments) {
  const Contacts& contacts = answer.contacts;
  const Assembly& assembly = answer.assembly;
  std::string text;
  if (contacts.objects.empty() && !contacts.truncated) {
    text = "Nothing touches.\n";
    if (assembly.objects.size() == 1) text += "There is only one object, and no object is tested against itself.\n";
  } else if (contacts.objects.empty()) {
    text = "Something touches, but --limit 0 keeps nothing of it.\n";
  } else if (arguments.first) {
    text = fmt::format("{} of objects touch.\n", counted(contacts.objects.size(), "pair"));
  } else {
    text = fmt::format("{} of objects touch, in {} of triangles.\n", counted(contacts.objects.size(), "pair"),
                       counted(contacts.triangles.size(), "pair"));
  }
  if (contacts.truncated && !contacts.objects.empty())
    text += fmt::format("Cut short by --limit {}: there are more.\n", grouped(arguments.limit));
  return text + fmt::format("{}, {}; read in {}, checked in {}.\n", counted(assembly.objects.size(), "object"),
                            counted(assembly.triangles, "triangle"), duration(answer.read_seconds),
                            duration(answer.check_seconds));
}

Result<void> print_answer(const Answer& answer, const CheckArguments& arguments, const std::stop_token& stop) {
  Sink out(STDOUT_FILENO, "standard output");
  const auto width = width_of(STDOUT_FILENO);
  if (!answer.contacts.objects.empty()) {
    print(table_of_pairs(answer, arguments.first), out, width, stop);
    out.write("\n");
  }
  out.write(summary(answer, arguments));
  if (arguments.stats) print_statistics(answer.contacts.statistics, out);
  if (stop.stop_requested()) return interrupted();
  return out.flush();
}

void warn(const Assembly& assembly) {
  if (assembly.warnings.empty()) return;
  complain(fmt::format("{} about these files, listed by impinge info", counted(assembly.warnings.size(), "warning")));
}

}  // namespace

Result<bool> check(const CheckArguments& arguments, const std::stop_token& stop) {
  std::optional<Target> target;
  if (arguments.json) {
    if (auto refused = refuse_overwriting_input(arguments); !refused) return refused.error();
    Result<Target> checked = Target::check(*arguments.json);
    if (!checked) return checked.error();
    target = std::move(*checked);
  }
  Result<Answer> answer = find_answer(arguments, stop);
  if (!answer) return answer.error();
  if (!arguments.quiet) {
    warn(answer->assembly);
    for (const std::string& warning : answer->contacts.warnings) complain(warning);
  }
  if (target) {
    auto written = target->write(
        [&](Sink& sink) { return write_check_json(sink, answer->assembly, answer->contacts, arguments, stop); });
    if (!written) return written.error();
  }
  if (!arguments.quiet && !(target && target->is_standard_output())) {
    if (auto printed = print_answer(*answer, arguments, stop); !printed) return printed.error();
  }
  return !answer->contacts.objects.empty() || answer->contacts.truncated;
}

}  // namespace impinge::cli
