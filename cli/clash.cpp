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
  Progress progress;
  input.options.progress = &progress;
  input.options.stop = stop;
  line.phase(
      fmt::format("judging {}", counted(assembly->objects.size(), "part")), [&progress] { return work_of(progress); },
      "steps");
  Result<Review> review = make_review(*std::move(assembly), std::move(input));
  line.end();  // it looks at `progress`
  if (review) review->read_seconds = read_seconds;
  return review;
}

Result<void> write_topics(Sink& sink, const Review& review, const Topics& topics, bool quiet) {
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
  return written;
}

/// Writes the BCF, if it was ordered.
Result<void> write_topics(Documents& documents, const Review& review, bool quiet) {
  const Topics topics = topics_of(review);
  const auto bcf = [&](Sink& sink) { return write_topics(sink, review, topics, quiet); };
  if (auto written = documents.write(kBcf, bcf); !written) return written;
  if (topics.left_out > 0 && !quiet)
    complain(fmt::format("the BCF has the {} worst of {} that fail, by --bcf-topics", grouped(topics.pairs.size()),
                         counted(topics.pairs.size() + topics.left_out, "pair")));
  return {};
}

Result<void> print_on_standard_output(const Review& review, const ClashArguments& arguments,
                                      const std::stop_token& stop) {
  Sink out(STDOUT_FILENO, "standard output");
  print_review(review, arguments, out, width_of(STDOUT_FILENO), stop);
  if (stop.stop_requested()) return interrupted();
  return out.flush();
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
  if (auto ordered = documents.order(kJson, arguments.json); !ordered) return ordered.error();
  if (auto ordered = documents.order(kPage, arguments.html); !ordered) return ordered.error();
  if (auto ordered = documents.order(kCsv, arguments.csv); !ordered) return ordered.error();
  if (auto ordered = documents.order(kMatrix, arguments.matrix); !ordered) return ordered.error();
  if (auto ordered = documents.order(kBcf, arguments.bcf); !ordered) return ordered.error();
  if (auto ordered = documents.order(kGltf, arguments.gltf); !ordered) return ordered.error();
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
  const auto write_json = [&](Sink& sink) { return write_clash_json(sink, *review); };
  if (auto written = documents.write(kJson, write_json); !written) return written.error();
  const auto write_html = [&](Sink& sink) -> Result<void> {
    const Result<DrawnScene> scene = draw(review->assembly, arguments.page_triangles, stop);
    if (!scene) return scene.error();
    if (const auto warning = simplified(*scene); warning && !arguments.quiet) complain(*warning);
    return write_page(sink, *page, head_of(arguments.files, arguments), *scene, write_json, stop);
  };
  if (auto written = documents.write(kPage, write_html); !written) return written.error();
  for (const auto& place : {arguments.csv, arguments.bcf})
    if (place && !arguments.force)
      if (auto kept = check_replaced(*place, decisions, *review); !kept) return kept.error();
  const auto csv = [&](Sink& sink) { return write_csv(sink, *review); };
  if (auto written = documents.write(kCsv, csv); !written) return written.error();
  const auto matrix = [&](Sink& sink) { return write_matrix(sink, *review); };
  if (auto written = documents.write(kMatrix, matrix); !written) return written.error();
  const auto gltf = [&](Sink& sink) { return write_gltf(sink, *review); };
  if (auto written = documents.write(kGltf, gltf); !written) return written.error();
  if (arguments.bcf)
    if (auto written = write_topics(documents, *review, arguments.quiet); !written) return written.error();
  if (auto put = documents.put(); !put) return put.error();
  if (!arguments.quiet && !documents.on_standard_output()) {
    if (auto printed = print_on_standard_output(*review, arguments, stop); !printed) return printed.error();
  }
  return count_failing(*review) > 0;
}

}  // namespace impinge::cli
