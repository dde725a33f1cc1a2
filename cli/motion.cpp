// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "commands.hpp"
#include "documents.hpp"
#include "numbers.hpp"
#include "progress.hpp"
#include "report/motion/motion_report.hpp"
#include "report/page.hpp"
#include "report/text.hpp"
#include "report/units.hpp"
#include "report/writers.hpp"
#include "scene_command.hpp"
#include "tables.hpp"
#include "terminal.hpp"

namespace impinge::cli {
namespace {

Result<io::Model> read_model(const MotionArguments& arguments, const std::stop_token& stop) {
  io::ReadOptions options;
  options.max_file_bytes = arguments.max_file_bytes;
  options.unit_in_metres = arguments.unit_in_metres;
  options.stop = stop;
  Result<io::Model> model = io::read(arguments.files.front(), options);
  if (stop.stop_requested()) return interrupted();
  if (model && model->animations.empty())
    return Error{
        Code::bad_file,
        fmt::format(
            "{}: nothing moves in it: it has no animation of its nodes that lasts; impinge clash finds what clashes "
            "where its parts stand",
            arguments.files.front())};
  if (model && !model->unit_in_metres) model->unit_in_metres = arguments.unit_in_metres;
  return model;
}

/// The animation that is named or numbered; the first by default.
Result<const io::Animation*> choose(const io::Model& model, const MotionArguments& arguments) {
  if (!arguments.animation) return &model.animations.front();
  std::vector<std::size_t> named;
  for (std::size_t i = 0; i < model.animations.size(); ++i)
    if (model.animations[i].name == *arguments.animation) named.push_back(i);
  if (named.size() == 1) return &model.animations[named.front()];
  if (named.size() > 1)
    return Error{Code::bad_option,
                 fmt::format("--animation {}: {} has {} animations of that name; choose one by its number: {}",
                             *arguments.animation, arguments.files.front(), named.size(), fmt::join(named, ", "))};
  const auto number = parse_number<std::size_t>(*arguments.animation);
  if (number && *number < model.animations.size()) return &model.animations[*number];
  std::string names;
  for (std::size_t i = 0; i < model.animations.size(); ++i)
    names += fmt::format(
        "{}{} {}", i > 0 ? ", " : "", i,
        model.animations[i].name.empty() ? "without a name" : "'" + printable(model.animations[i].name) + "'");
  return Error{Code::bad_option, fmt::format("--animation {}: {} has no such animation, but {}", *arguments.animation,
                                             arguments.files.front(), names)};
}

Result<Timeline> run(const io::Model& model, const io::Animation& animation, const MotionArguments& arguments,
                     ProgressLine& line, const std::stop_token& stop) {
  report::TimelineOptions options = arguments;
  options.stop = stop;
  const std::string label = "moving " + counted(model.objects.size(), "part");
  return with_progress(line, label, "frames", stop, [&](Progress& progress) {
    options.progress = &progress;
    return find_timeline(model, animation, options);
  });
}

/// Says it on standard error. What is not of the whole motion says so even where everything else is quiet.
void mention(const LeftOut& left, bool quiet) {
  static constexpr std::size_t kMost = 5;
  const auto say = [](const std::vector<std::string>& sentences) {
    for (std::size_t i = 0; i < std::min(kMost, sentences.size()); ++i) complain(sentences[i]);
    if (sentences.size() > kMost)
      complain(fmt::format("and {} such, which --json lists", counted(sentences.size() - kMost, "more thing")));
  };
  say(left.shapes);
  if (!quiet) say(left.harmless);
}

}  // namespace

Result<bool> motion(const MotionArguments& given, const std::stop_token& stop) {
  MotionArguments arguments = given;
  Documents documents(arguments.files, arguments.force);
  if (auto ordered = documents.order({{kJson, arguments.json}, {kPage, arguments.html}}); !ordered)
    return ordered.error();
  const Result<std::string> page = arguments.html ? read_page_template() : std::string();
  if (!page) return page.error();

  ProgressLine line(STDERR_FILENO, !arguments.quiet);
  line.phase("reading " + printable(arguments.files.front()));
  const Result<io::Model> model = read_model(arguments, stop);
  if (!model) return model.error();
  const Result<const io::Animation*> animation = choose(*model, arguments);
  if (!animation) return animation.error();
  if (arguments.tolerance)
    if (auto brought = bring_to_unit(*arguments.tolerance, model->unit_in_metres, "--tolerance"); !brought)
      return brought.error();
  const Mover mover(*model, **animation);
  MotionReport report{assemble(arguments.files, {*model}), **animation, model->animations.size(), mover, {}, {}};
  Result<LeftOut> left = left_out(*model, **animation, report.assembly);
  if (!left) return left.error();
  report.left_out = std::move(*left);
  Result<Timeline> timeline = run(*model, **animation, arguments, line, stop);
  if (!timeline) return timeline.error();
  report.timeline = std::move(*timeline);
  mention_missing(report.assembly);
  mention(report.left_out, arguments.quiet);
  if (!arguments.quiet) mention_warnings(report.assembly);

  documents.write(kJson, [&](Sink& sink) { return write_motion_json(sink, report, arguments); });
  documents.write(kPage, [&](Sink& sink) {
    return write_page_of(sink, *page, report.assembly, arguments, stop,
                         {[&](Sink& to) { return write_view_json(to, report.assembly); },
                          [&](Sink& to, const DrawnScene& scene) { return write_motion_block(to, report, scene); }});
  });
  const auto print = [&](Sink& out, auto width) { print_motion(report, out, width, stop); };
  if (auto printed = documents.put_and_print(arguments.quiet, stop, print); !printed) return printed.error();
  return !report.timeline.spans.empty();
}

}  // namespace impinge::cli
