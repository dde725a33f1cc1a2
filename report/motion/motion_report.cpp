// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/motion/motion_report.hpp"

#include <string>
#include <utility>
#include <vector>

#include "report/json_writer.hpp"
#include "report/review.hpp"
#include "report/units.hpp"

namespace impinge::report {
namespace {

Json json_moment(const std::optional<Moment>& moment) { return moment ? Json{moment->lo, moment->hi} : Json(); }

void write_spans(JsonDocument& document, const std::vector<ClashSpan>& spans) {
  document.list("spans", spans.size(), [&](std::size_t i) {
    const ClashSpan& span = spans[i];
    return Json{{"a", span.objects[0]},
                {"b", span.objects[1]},
                {"from", json_moment(span.from)},
                {"to", json_moment(span.to)},
                {"point", span.point ? json_point(*span.point) : Json()},
                {"worst", name(span.worst)},
                {"inner", span.inner < 0 ? Json() : Json(span.objects[span.inner])},
                {"worst_at", span.worst_at},
                {"note", span.note == Note::none ? Json() : Json(sentence(span.note))},
                {"fails_below", json_finite(span.fails_below)},
                {"overlap_depth", json_depth(span.overlap_depth)}};
  });
}

void write_left_out(JsonDocument& document, const LeftOut& left) {
  std::vector<std::string> sentences = left.shapes;
  sentences.insert(sentences.end(), left.harmless.begin(), left.harmless.end());
  document.member("left_out", sentences);
}

void write_animation(JsonDocument& document, const MotionReport& report) {
  const std::size_t steps = report.timeline.times.size() - 1;
  document.member("animation", Json{{"name", report.animation.name},
                                    {"seconds", report.animation.seconds},
                                    {"frames", steps},
                                    {"step", report.animation.seconds / static_cast<double>(steps)}});
}

}  // namespace

Result<void> write_motion_json(Sink& sink, const MotionReport& report, const TimelineOptions& options) {
  JsonDocument document(sink);
  document.member("version", 1);
  document.member("unit", json_unit(report.assembly.unit_in_metres));
  write_animation(document, report);
  document.member("settings", Json{{"tolerance", json_tolerance(value_of(options.tolerance))},
                                   {"depth_precision", json_finite(options.depth_precision)},
                                   {"fail_on", words_of(options.fail_on)}});
  document.list("objects", report.assembly.objects.size(), [&](std::size_t i) {
    Json object = json_identity(report.assembly, i);
    object["moves"] = report.mover.bodies()[i] != 0;
    return object;
  });
  write_missing(document, report.assembly);
  write_left_out(document, report.left_out);
  write_spans(document, report.timeline.spans);
  return document.end();
}

Result<void> write_motion_block(Sink& sink, const MotionReport& report, const DrawnScene& scene) {
  std::vector<Json> poses(report.assembly.objects.size());
  for (const double time : report.timeline.times) {
    const Result<std::vector<Posed>> posed = report.mover.at(time);
    if (!posed) return posed.error();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (report.mover.bodies()[i] == 0 || !scene.objects[i].mesh) continue;
      poses[i].push_back(json_map(about(scene.middles[*scene.objects[i].mesh], (*posed)[i].map)));
    }
  }
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (!poses[i].empty()) moving.push_back(i);
  JsonDocument document(sink);
  document.member("version", 1);
  write_animation(document, report);
  document.member("times", report.timeline.times);
  document.list("objects", moving.size(), [&](std::size_t i) {
    return Json{{"id", moving[i]}, {"poses", std::move(poses[moving[i]])}};
  });
  write_left_out(document, report.left_out);
  write_spans(document, report.timeline.spans);
  return document.end();
}

}  // namespace impinge::report
