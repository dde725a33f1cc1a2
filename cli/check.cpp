// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <optional>
#include <utility>

#include "calibration_cache.hpp"
#include "commands.hpp"
#include "documents.hpp"
#include "progress.hpp"
#include "report/assembly.hpp"
#include "report/json_writer.hpp"
#include "report/sink.hpp"
#include "report/text.hpp"
#include "scene_command.hpp"
#include "table.hpp"
#include "tables.hpp"
#include "terminal.hpp"

namespace impinge::cli {
namespace {

struct Answer {
  Assembly assembly;
  Contacts contacts;
  double read_seconds = 0;
  double check_seconds = 0;
};

Result<Contacts> collide(const CheckArguments& arguments, const Assembly& assembly, ProgressLine& line,
                         const std::stop_token& stop) {
  Result<Scene> scene = scene_of(assembly, arguments);
  if (!scene) return scene.error();
  for (std::uint32_t i = 0; arguments.self && i < assembly.objects.size(); ++i)
    if (auto set = scene->self(scene->id(i).value(), true); !set) return set.error();

  std::optional<CalibrationCache> cache;
  if (arguments.backend == "hybrid") cache.emplace();
  Options options;
  options.find = arguments.first ? Options::Find::first : Options::Find::all;
  options.limit = arguments.limit;
  options.threads = arguments.threads;
  options.backend = arguments.backend;
  options.device = arguments.device;
  options.device_share = arguments.device_share;
  options.statistics = true;
  options.predict_cost = arguments.stats;
  options.stop = stop;
  const std::string label = "checking " + counted(assembly.objects.size(), "object");
  return with_progress(line, label, "pairs", stop, [&](Progress& progress) {
    options.progress = &progress;
    return scene->collide(options);
  });
}

Result<Answer> find_answer(const CheckArguments& arguments, const std::stop_token& stop) {
  ProgressLine line(STDERR_FILENO, !arguments.quiet);
  const auto start = Clock::now();
  Result<Assembly> assembly = read_assembly(arguments, line, stop);
  if (!assembly) return assembly.error();
  const double read_seconds = seconds_since(start);
  const auto read = Clock::now();
  Result<Contacts> contacts = collide(arguments, *assembly, line, stop);
  if (!contacts) return with_label(contacts.error(), *assembly);
  return Answer{std::move(*assembly), std::move(*contacts), read_seconds, seconds_since(read)};
}

Table table_of_pairs(const Answer& answer, bool first) {
  using enum Column::Kind;
  const Contacts& contacts = answer.contacts;
  Table table{contacts.objects.size(), {}};
  for (const std::size_t which : {0, 1})
    table.columns.push_back({"object", name, [&answer, &contacts, which](std::size_t row) {
                               return answer.assembly.labels[contacts.objects[row][which]];
                             }});
  if (first) {
    table.columns.push_back({"witness", text, [&contacts](std::size_t row) {
                               return std::string(kind_name(contacts.kinds[contacts.offsets[row]]));
                             }});
    return table;
  }
  for (const Kind kind : {Kind::crossing, Kind::touching, Kind::coplanar})
    table.columns.push_back({std::string(kind_name(kind)), number, [&contacts, kind](std::size_t row) {
                               return grouped(count_row(contacts, row)[static_cast<std::size_t>(kind)]);
                             }});
  return table;
}

std::string summary(const Answer& answer, const CheckArguments& arguments) {
  const Contacts& contacts = answer.contacts;
  const Assembly& assembly = answer.assembly;
  std::string text;
  if (contacts.objects.empty() && !contacts.truncated) {
    text = "Nothing touches.\n";
    if (assembly.objects.size() == 1 && !arguments.self)
      text += "There is only one object, and no object is tested against itself without --self.\n";
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

void print_answer(const Answer& answer, const CheckArguments& arguments, Sink& out, std::optional<std::size_t> width,
                  const std::stop_token& stop) {
  if (!answer.contacts.objects.empty()) {
    print(table_of_pairs(answer, arguments.first), out, width, stop);
    out.write("\n");
  }
  out.write(summary(answer, arguments));
  if (arguments.stats) print_statistics(answer.contacts.statistics, out);
}

}  // namespace

Result<bool> check(const CheckArguments& arguments, const std::stop_token& stop) {
  Documents documents(arguments.files, arguments.force);
  if (auto ordered = documents.order({{kJson, arguments.json}}); !ordered) return ordered.error();
  Result<Answer> answer = find_answer(arguments, stop);
  if (!answer) return answer.error();
  mention_missing(answer->assembly);
  if (!arguments.quiet) {
    mention_warnings(answer->assembly);
    for (const std::string& warning : answer->contacts.warnings) complain(warning);
  }
  documents.write(kJson, [&](Sink& sink) {
    return write_check_json(sink, answer->assembly, answer->contacts, arguments.triangles, !arguments.first, stop);
  });
  const auto print = [&](Sink& out, auto width) { print_answer(*answer, arguments, out, width, stop); };
  if (auto printed = documents.put_and_print(arguments.quiet, stop, print); !printed) return printed.error();
  return !answer->contacts.objects.empty() || answer->contacts.truncated;
}

}  // namespace impinge::cli
