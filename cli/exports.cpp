// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exports.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>

#include "progress.hpp"
#include "report/bcf/bcf.hpp"
#include "report/csv.hpp"
#include "report/gltf.hpp"
#include "report/text.hpp"
#include "terminal.hpp"

namespace impinge::cli {
namespace {

Result<void> write_topics(Sink& sink, const Review& review, const ClashArguments& arguments, const Topics& topics,
                          const std::stop_token& stop) {
  ProgressLine line(STDERR_FILENO, !arguments.quiet);
  std::atomic<std::size_t> done = 0;
  const auto total = static_cast<double>(topics.pairs.size());
  line.phase(
      fmt::format("drawing {}", counted(topics.pairs.size(), "topic")),
      [&, total] {
        return Work{static_cast<double>(done), total};
      },
      "topics");
  Result<void> written = write_bcf(
      sink, review, arguments, topics, [&] { ++done; }, stop);
  line.end();  // it looks at `done`
  return written;
}

}  // namespace

Result<void> order_exports(Documents& documents, const ClashArguments& arguments) {
  if (auto ordered = documents.order(kCsv, arguments.csv); !ordered) return ordered;
  if (auto ordered = documents.order(kBcf, arguments.bcf); !ordered) return ordered;
  return documents.order(kGltf, arguments.gltf);
}

Result<void> write_exports(Documents& documents, const Review& review, const ClashArguments& arguments,
                           const std::stop_token& stop) {
  const auto csv = [&](Sink& sink) { return write_csv(sink, review, arguments, stop); };
  if (auto written = documents.write(kCsv, csv); !written) return written;
  const auto gltf = [&](Sink& sink) { return write_gltf(sink, review, arguments, stop); };
  if (auto written = documents.write(kGltf, gltf); !written) return written;
  if (!arguments.bcf) return {};
  const Topics topics = topics_of(review, arguments);
  const auto bcf = [&](Sink& sink) { return write_topics(sink, review, arguments, topics, stop); };
  if (auto written = documents.write(kBcf, bcf); !written) return written;
  if (topics.left_out > 0 && !arguments.quiet)
    complain(fmt::format("the BCF has the {} worst of {} that fail, by --bcf-topics", grouped(topics.pairs.size()),
                         counted(topics.pairs.size() + topics.left_out, "pair")));
  return {};
}

}  // namespace impinge::cli
