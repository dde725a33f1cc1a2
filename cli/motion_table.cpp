// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "report/text.hpp"
#include "table.hpp"
#include "tables.hpp"

namespace impinge::cli {
namespace {

/// A time with as many decimals as resolve a thousandth of a step.
std::string time_text(double seconds, double step) {
  int decimals = 0;
  for (double unit = 1; unit > step / 1000 && decimals < 9; unit /= 10) ++decimals;
  return fmt::format("{:.{}f}", seconds, decimals);
}

std::string name_of(const io::Animation& animation) {
  return animation.name.empty() ? "an animation without a name" : "animation '" + printable(animation.name) + "'";
}

}  // namespace

void print_motion(const MotionReport& report, Sink& sink, std::optional<std::size_t> width,
                  const std::stop_token& stop) {
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
  Table table{spans.size(), {}};
  const auto add = [&](std::string heading, Column::Kind kind, auto cell) {
    table.columns.push_back({std::move(heading), kind, [&, cell](std::size_t row) { return cell(spans[order[row]]); }});
  };
  // The part that lies in the other stands first.
  const auto label = [&](std::size_t which) {
    return [&report, which](const ClashSpan& span) {
      return report.assembly.labels[span.objects[span.inner == 1 ? 1 - which : which]];
    };
  };
  add("from", number, [step](const ClashSpan& span) { return span.from ? time_text(span.from->hi, step) : "start"; });
  add("to", number, [step](const ClashSpan& span) { return span.to ? time_text(span.to->lo, step) : "end"; });
  add("part", name, label(0));
  add("part", name, label(1));
  add("worst", text, [](const ClashSpan& span) { return std::string(impinge::name(span.worst)); });
  add("at", number, [step](const ClashSpan& span) { return time_text(span.worst_at, step); });
  if (std::ranges::any_of(spans, [](const ClashSpan& span) { return span.overlap_depth.has_value(); }))
    add("depth" + in_unit(report.assembly.unit_in_metres), number, [](const ClashSpan& span) {
      const auto four_digits = [](double length) { return fmt::format("{:.4g}", length); };
      return span.overlap_depth ? depth_text(*span.overlap_depth, four_digits) : "-";
    });
  if (std::any_of(spans.begin(), spans.end(), [](const ClashSpan& span) { return span.note != Note::none; }))
    add("note", text, [](const ClashSpan& span) { return note_text(span.note); });
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
      fmt::format("Looked at {} of {} s, and between them along screws: a clash that is over within one step is missed "
                  "only where its parts touch at both ends of the step, change their shape or move otherwise; the "
                  "times of those that were seen are exact to a millionth of a step.\n",
                  counted(frames, "step"), time_text(step, step)));
  if (report.animations > 1)
    sink.write(fmt::format("The file has {} animations; --animation N chooses another one.\n", report.animations));
}

}  // namespace impinge::cli
