// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "documents.hpp"
#include "progress.hpp"
#include "report/make_review.hpp"
#include "report/page.hpp"
#include "report/review.hpp"
#include "report/text.hpp"
#include "report/writers.hpp"
#include "scene_command.hpp"
#include "tables.hpp"
#include "terminal.hpp"

namespace impinge::cli {
namespace {

Result<Review> read_and_review(ReviewInput input, bool quiet, const std::stop_token& stop) {
  ProgressLine line(STDERR_FILENO, !quiet);
  const auto start = Clock::now();
  Result<Assembly> assembly = read_assembly(input.options, line, stop);
  if (!assembly) return assembly.error();
  const double read_seconds = seconds_since(start);
  input.options.stop = stop;
  const std::string label = "judging " + counted(assembly->objects.size(), "part");
  Result<Review> review = with_progress(line, label, "steps", stop, [&](Progress& progress) {
    input.options.progress = &progress;
    return make_review(*std::move(assembly), std::move(input));
  });
  if (review) review->read_seconds = read_seconds;
  return review;
}

Result<void> write_topics(Sink& sink, const Review& review, bool quiet) {
  const Topics topics = topics_of(review);
  ProgressLine line(STDERR_FILENO, !quiet);
  std::atomic<std::size_t> done = 0;
  const auto total = static_cast<double>(topics.pairs.size());
  line.phase(
      fmt::format("drawing {}", counted(topics.pairs.size(), "topic")),
      [&, total] {
        return Work{static_cast<double>(done), total};
      },
      "topics");
  Result<void> written = write_bcf(sink, review, topics, [&] { ++done; });
  line.end();  // it looks at `done`
  if (written && topics.left_out > 0 && !quiet)
    complain(fmt::format("the BCF has the {} worst of {} that fail, by --bcf-topics", grouped(topics.pairs.size()),
                         counted(topics.pairs.size() + topics.left_out, "pair")));
  return written;
}

}  // namespace

Result<bool> clash(const ClashArguments& given, const std::stop_token& stop) {
  // Before the long work, which a file that cannot be used would cost.
  Result<ReviewInput> input = read_input(given);
  if (!input) return input.error();
  ClashArguments arguments = given;
  static_cast<ReportOptions&>(arguments) = input->options;
  std::vector<std::string> inputs = arguments.files;
  if (arguments.config) inputs.push_back(*arguments.config);
  if (arguments.decisions) inputs.push_back(*arguments.decisions);
  Documents documents(inputs, arguments.force);
  if (auto ordered = documents.order({{kJson, arguments.json},
                                      {kPage, arguments.html},
                                      {kCsv, arguments.csv},
                                      {kMatrix, arguments.matrix},
                                      {kBcf, arguments.bcf},
                                      {kGltf, arguments.gltf}});
      !ordered)
    return ordered.error();
  const Result<std::string> page = arguments.html ? read_page_template() : std::string();
  if (!page) return page.error();
  const Decisions decisions = input->decisions;
  const Result<Review> review = read_and_review(*std::move(input), arguments.quiet, stop);
  if (!review) return review.error();
  static_cast<ReportOptions&>(arguments) = review->options;  // with lengths in the unit of the files
  mention_missing(review->assembly);
  if (!arguments.quiet) {
    mention_warnings(review->assembly);
    for (const std::string& warning : review->warnings) complain(warning);
  }
  for (const auto& place : {arguments.csv, arguments.bcf})
    if (place && !arguments.force)
      if (auto kept = check_replaced(*place, decisions, *review); !kept) return kept.error();
  const auto write_json = [&](Sink& sink) { return write_clash_json(sink, *review); };
  documents.write(kJson, write_json);
  documents.write(
      kPage, [&](Sink& sink) { return write_page_of(sink, *page, review->assembly, arguments, stop, {write_json}); });
  documents.write(kCsv, [&](Sink& sink) { return write_csv(sink, *review); });
  documents.write(kMatrix, [&](Sink& sink) { return write_matrix(sink, *review); });
  documents.write(kGltf, [&](Sink& sink) { return write_gltf(sink, *review); });
  documents.write(kBcf, [&](Sink& sink) { return write_topics(sink, *review, arguments.quiet); });
  const auto print = [&](Sink& out, auto width) { print_review(*review, arguments, out, width, stop); };
  if (auto printed = documents.put_and_print(arguments.quiet, stop, print); !printed) return printed.error();
  return count_failing(*review) > 0;
}

}  // namespace impinge::cli
