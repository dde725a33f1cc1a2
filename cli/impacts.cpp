// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <tuple>
#include <utility>

#include "commands.hpp"
#include "documents.hpp"
#include "frame_files.hpp"
#include "progress.hpp"
#include "report/motion/impacts_report.hpp"
#include "report/text.hpp"
#include "report/units.hpp"
#include "scene_command.hpp"
#include "table.hpp"
#include "tables.hpp"

namespace impinge::cli {
namespace {

Result<ImpactSequence> find(const ImpactsArguments& arguments, const std::stop_token& stop) {
  ProgressLine line(STDERR_FILENO, !arguments.quiet);
  ImpactOptions options = arguments;
  options.stop = stop;
  const std::string label = "following " + counted(arguments.files.size(), "state");
  return with_progress(line, label, "steps", stop, [&](Progress& progress) {
    options.progress = &progress;
    return find_impact_sequence(options);
  });
}

/// The impacts of two parts in one step.
struct Meeting {
  std::uint32_t frame;
  std::array<std::uint32_t, 2> objects;
  Interval first;
  std::array<std::uint64_t, 3> counts;  ///< by `Feature`
};

std::vector<Meeting> meetings_of(const ImpactSequence& sequence) {
  std::vector<Meeting> meetings;
  for (const SequenceImpact& found : sequence.impacts) {
    const Interval& time = found.impact.time;
    if (meetings.empty() || meetings.back().frame != found.frame || meetings.back().objects != found.objects)
      meetings.push_back({found.frame, found.objects, time, {}});
    Meeting& meeting = meetings.back();
    if (std::tie(time.lo, time.hi) < std::tie(meeting.first.lo, meeting.first.hi)) meeting.first = time;
    ++meeting.counts[static_cast<std::size_t>(found.impact.feature)];
  }
  return meetings;
}

Table table_of(const std::vector<Meeting>& meetings, const Assembly& assembly) {
  using enum Column::Kind;
  Table table{meetings.size(), {}};
  const auto add = [&](std::string heading, Column::Kind kind, auto cell) {
    table.columns.push_back({std::move(heading), kind, [&, cell](std::size_t row) { return cell(meetings[row]); }});
  };
  add("step", number, [](const Meeting& m) { return std::to_string(m.frame); });
  add("first at", number, [](const Meeting& m) { return fmt::format("{:.6g}", m.first.lo); });
  for (const std::size_t which : {0, 1})
    add("part", name, [&assembly, which](const Meeting& m) { return assembly.labels[m.objects[which]]; });
  add("vertex-face", number, [](const Meeting& m) { return grouped(m.counts[0]); });
  add("face-vertex", number, [](const Meeting& m) { return grouped(m.counts[1]); });
  add("edge-edge", number, [](const Meeting& m) { return grouped(m.counts[2]); });
  return table;
}

std::string summary(const ImpactSequence& sequence, const ImpactsArguments& arguments) {
  std::string text;
  if (!sequence.earliest) {
    text = sequence.separation > 0 ? fmt::format("Nothing comes within {}{}.\n", sequence.separation,
                                                 unit_after(sequence.assembly.unit_in_metres))
                                   : "Nothing meets.\n";
  } else {
    const auto& [frame, toi] = *sequence.earliest;
    text = fmt::format("{} at {} of the step from {} to {}{}.\n",
                       arguments.earliest || sequence.impacts.empty()
                           ? "The first impact is"
                           : counted(sequence.impacts.size(), "impact") + "; the first is",
                       toi.lo, printable(arguments.files[frame]), printable(arguments.files[frame + 1]),
                       toi.hi > 0                ? ""
                       : sequence.separation > 0 ? ", which begins within the separation"
                                                 : ", which begins with contact");
  }
  if (sequence.truncated) text += fmt::format("Cut short by --limit {}: there are more.\n", grouped(arguments.limit));
  return text + fmt::format("{}, {}, {}.\n", counted(arguments.files.size(), "state"),
                            counted(sequence.assembly.objects.size(), "part"),
                            counted(sequence.assembly.triangles, "triangle"));
}

}  // namespace

Result<bool> impacts(const ImpactsArguments& given, const std::stop_token& stop) {
  ImpactsArguments arguments = given;
  Result<std::vector<std::string>> files = frame_files(given.files);
  if (!files) return files.error();
  arguments.files = *std::move(files);
  Documents documents(arguments.files, arguments.force);
  if (auto ordered = documents.order({{kJson, arguments.json}, {kImpactTable, arguments.csv}}); !ordered)
    return ordered.error();
  const Result<ImpactSequence> sequence = find(arguments, stop);
  if (!sequence) return sequence.error();
  mention_missing(sequence->assembly);
  if (!arguments.quiet) mention_warnings(sequence->assembly);

  ImpactOptions options = arguments;
  options.stop = stop;
  documents.write(kJson, [&](Sink& sink) { return write_impacts_json(sink, *sequence, options); });
  documents.write(kImpactTable, [&](Sink& sink) { return write_impacts_csv(sink, *sequence, options); });
  const auto print_answer = [&](Sink& out, auto width) {
    const std::vector<Meeting> meetings = meetings_of(*sequence);
    if (!meetings.empty()) {
      print(table_of(meetings, sequence->assembly), out, width, stop);
      out.write("\n");
    }
    out.write(summary(*sequence, arguments));
  };
  if (auto printed = documents.put_and_print(arguments.quiet, stop, print_answer); !printed) return printed.error();
  return sequence->earliest.has_value();
}

}  // namespace impinge::cli
