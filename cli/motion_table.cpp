// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "clash_table.hpp"
#include "report/text.hpp"
#include "table.hpp"

namespace impinge::cli {
namespace {

/// A time to a thousandth of a step, which is more than anybody looks at.
std::string time_text(double seconds, double step) {
  int decimals = 0;
  for (double unit = 1; unit > step / 1000 && decimals < 9; unit /= 10) ++decimals;
  return fmt::format("{:.{}f}", seconds, decimals);
}

std::string name_of(const io::Animation& animation) {
  return animation.name.empty() ? "an animation without a name" : "animation '" + printable(animation.name) + "'";
}

}  // namespace

void print_motion(const MotionReport& report, const MotionArguments& arguments, Sink& sink,
                  std::optional<std::size_t> width, const std::stop_token& stop) {
  const std::vector<ClashSpan>& spans = report.timeline.spans;
  const std::size_t frames = report.timeline.times.size() - 1;
  const double step = report.animation.seconds / static_cast<double>(frames);
  std::vector<std::size_t> order(spans.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto begin = [&](std::size_t i) { return spans[i].from ? spans[i].from->lo : -1.0; };
    return begin(a) < begin(b);
  });
  using enum Column::Kind;
  Table table;
  table.rows = spans.size();
  table.columns = {{"from", number}, {"to", number}, {"part", name}, {"part", name}, {"worst", text}, {"at", number}};
  if (arguments.depth) table.columns.push_back({"depth", number});
  const std::size_t note = table.columns.size();
  if (std::any_of(spans.begin(), spans.end(), [](const ClashSpan& span) { return span.note != Note::none; }))
    table.columns.push_back({"note", text});
  table.cell = [&](std::size_t row, std::size_t column) -> std::string {
    const ClashSpan& span = spans[order[row]];
    if (column == note) return note_text(span.note);
    switch (column) {
      case 0:
        return span.from ? time_text(span.from->hi, step) : "start";
      case 1:
        return span.to ? time_text(span.to->lo, step) : "end";
      case 2:
      case 3:
        return report.assembly.labels[span.objects[(column == 2) == (span.inner == 1) ? 1 : 0]];
      case 4:
        return std::string(impinge::name(span.worst));
      case 5:
        return time_text(span.worst_at, step);
      default:
        return span.overlap_depth
                   ? fmt::format("{:.4g}", std::max(span.overlap_depth->a_in_b.hi, span.overlap_depth->b_in_a.hi))
                   : "-";
    }
  };
  if (table.rows > 0) print(table, sink, width, stop);
  if (table.rows > 0) sink.write("\n");
  const auto moving = std::count_if(report.mover.bodies().begin(), report.mover.bodies().end(),
                                    [](std::uint32_t body) { return body != 0; });
  sink.write(fmt::format("{}, {} of them moving; {} of {} s; {}.\n", counted(report.assembly.objects.size(), "part"),
                         moving, name_of(report.animation), time_text(report.animation.seconds, step),
                         spans.empty()       ? "nothing clashes"
                         : spans.size() == 1 ? "1 clash"
                                             : grouped(spans.size()) + " clashes"));
  sink.write(
      fmt::format("Looked at {} of {} s: a clash that is over within one step may be missed; the times of "
                  "those that were seen are exact to a millionth of a step.\n",
                  counted(frames, "step"), time_text(step, step)));
  if (report.animations > 1)
    sink.write(fmt::format("The file has {} animations; --animation N chooses another one.\n", report.animations));
}

}  // namespace impinge::cli
