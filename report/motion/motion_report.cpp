// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/motion/motion_report.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "report/json_writer.hpp"

namespace impinge::report {
namespace {

std::string json_moment(const std::optional<Moment>& moment) {
  return moment ? fmt::format("[{},{}]", json_number(moment->lo), json_number(moment->hi)) : "null";
}

void write_spans(Sink& sink, const std::vector<ClashSpan>& spans, bool depth) {
  sink.write("\"spans\":[");
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const ClashSpan& span = spans[i];
    const std::string inner = span.inner < 0 ? "null" : fmt::format("{}", span.objects[span.inner]);
    sink.write(fmt::format(
        "{}\n{{\"a\":{},\"b\":{},\"from\":{},\"to\":{},\"worst\":\"{}\",\"inner\":{},\"worst_at\":{},\"note\":{}",
        i > 0 ? "," : "", span.objects[0], span.objects[1], json_moment(span.from), json_moment(span.to),
        name(span.worst), inner, json_number(span.worst_at),
        span.note == Note::none ? "null" : json_string(sentence(span.note))));
    if (depth) sink.write(",\"overlap_depth\":" + json_depth(span.overlap_depth));
    sink.write("}");
  }
  sink.write("\n]");
}

void write_left_out(Sink& sink, const LeftOut& left) {
  sink.write("\"left_out\":[");
  std::string comma;
  for (const std::vector<std::string>* list : {&left.shapes, &left.harmless})
    for (const std::string& sentence : *list) sink.write(std::exchange(comma, ",") + json_string(sentence));
  sink.write("],\n");
}

void write_animation(Sink& sink, const MotionReport& report) {
  const std::size_t steps = report.timeline.times.size() - 1;
  sink.write(fmt::format("\"animation\":{{\"name\":{},\"seconds\":{},\"frames\":{},\"step\":{}}},\n",
                         json_string(report.animation.name), json_number(report.animation.seconds), steps,
                         json_number(report.animation.seconds / static_cast<double>(steps))));
}

}  // namespace

Result<void> write_motion_json(Sink& sink, const MotionReport& report, const MotionArguments& arguments) {
  sink.write("{\"version\":1,\n");
  write_animation(sink, report);
  sink.write(fmt::format("\"settings\":{{\"tolerance\":{},\"depth\":{},\"fail_on\":[",
                         arguments.tolerance ? json_number(*arguments.tolerance) : "\"auto\"", arguments.depth));
  const std::vector<std::string> words = words_of(arguments.fail_on);
  for (std::size_t i = 0; i < words.size(); ++i) sink.write((i > 0 ? "," : "") + json_string(words[i]));
  sink.write("]},\n\"objects\":[");
  for (std::size_t i = 0; i < report.assembly.objects.size(); ++i)
    sink.write(fmt::format("{}\n{{{},\"moves\":{}}}", i > 0 ? "," : "", json_identity(report.assembly, i),
                           report.mover.bodies()[i] != 0));
  sink.write("\n],\n" + json_missing(report.assembly));
  write_left_out(sink, report.left_out);
  write_spans(sink, report.timeline.spans, arguments.depth);
  sink.write("}\n");
  return {};
}

Result<void> write_motion_block(Sink& sink, const MotionReport& report, const DrawnScene& scene,
                                const MotionArguments& arguments) {
  const std::vector<double>& times = report.timeline.times;
  std::vector<std::string> poses(report.assembly.objects.size());
  for (const double time : times) {
    const Result<std::vector<Posed>> posed = report.mover.at(time);
    if (!posed) return posed.error();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (report.mover.bodies()[i] == 0 || !scene.objects[i].mesh) continue;
      poses[i] +=
          (poses[i].empty() ? "" : ",") + json_map(about(scene.middles[*scene.objects[i].mesh], (*posed)[i].map));
    }
  }
  sink.write("{\"version\":1,\n");
  write_animation(sink, report);
  sink.write("\"times\":[");
  for (std::size_t i = 0; i < times.size(); ++i) sink.write((i > 0 ? "," : "") + json_number(times[i]));
  sink.write("],\n\"objects\":[");
  bool is_first = true;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].empty()) continue;
    sink.write(fmt::format("{}\n{{\"id\":{},\"poses\":[{}]}}", is_first ? "" : ",", i, poses[i]));
    is_first = false;
  }
  sink.write("\n],\n");
  write_left_out(sink, report.left_out);
  write_spans(sink, report.timeline.spans, arguments.depth);
  sink.write("}");
  return {};
}

}  // namespace impinge::report
