// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "report/make_review.hpp"
#include "report/page.hpp"
#include "report/sink.hpp"
#include "report/writers.hpp"

namespace impinge::report {
namespace {

Result<Report> report_of(Result<Review> review) {
  if (!review) return review.error();
  return Report(std::make_unique<const Review>(*std::move(review)));
}

/// Of an assembly at hand. The clashes are looked for unless they are known.
Result<Report> review_of(Assembly assembly, ReportOptions options, std::optional<Clashes> known) {
  options.files = assembly.files;
  if (!assembly.unit_in_metres) assembly.unit_in_metres = options.unit_in_metres;
  Result<ReviewInput> input = read_input(options);
  if (!input) return input.error();
  return report_of(make_review(std::move(assembly), *std::move(input), std::move(known)));
}

template <class Fill>
Result<void> write_file(const std::string& file, const DocumentKind& kind, Fill&& fill) {
  const Result<Target> target = Target::check(file, kind);
  if (!target) return target.error();
  Result<Written> written = target->write(std::forward<Fill>(fill));
  if (!written) return written.error();
  return written->put();
}

}  // namespace

Report::Report(std::unique_ptr<const Review> review) noexcept : review_(std::move(review)) {}
Report::~Report() = default;
Report::Report(Report&&) noexcept = default;
Report& Report::operator=(Report&&) noexcept = default;

const Assembly& Report::assembly() const noexcept { return review_->assembly; }
const std::vector<Clash>& Report::pairs() const noexcept { return review_->clashes.pairs; }
std::vector<std::size_t> Report::worst_first() const { return ranked(pairs()); }
const std::string& Report::id(std::size_t pair) const { return review_->ids[pair]; }
bool Report::fails(std::size_t pair) const { return review_->standings[pair].fails; }
bool Report::is_new(std::size_t pair) const { return review_->standings[pair].change == Change::fresh; }
std::uint64_t Report::failing() const { return count_failing(*review_); }

std::vector<std::string> Report::warnings() const {
  std::vector<std::string> all = review_->assembly.missing;
  for (const std::vector<std::string>* const more :
       {&review_->assembly.alignment, &review_->assembly.warnings, &review_->warnings})
    all.insert(all.end(), more->begin(), more->end());
  return all;
}

Result<Report> review(const ReportOptions& options) {
  Result<ReviewInput> input = read_input(options);
  if (!input) return input.error();
  Result<Assembly> assembly = read_assembly(input->options);
  if (!assembly) return assembly.error();
  return report_of(make_review(*std::move(assembly), *std::move(input)));
}

Result<Report> review(Assembly assembly, const ReportOptions& options) {
  return review_of(std::move(assembly), options, std::nullopt);
}

Result<Report> review(Assembly assembly, Clashes clashes, const ReportOptions& options) {
  if (options.config || options.between)
    return Error{Code::bad_option, "the clashes are known, and named tests and --between would judge them anew"};
  const std::size_t count = assembly.objects.size();
  const auto is_known = [&](const Clash& pair) { return pair.objects[0] < count && pair.objects[1] < count; };
  if (clashes.parts.size() != count || !std::ranges::all_of(clashes.pairs, is_known))
    return Error{Code::bad_option,
                 fmt::format("the clashes are of {} parts, and the assembly has {}", clashes.parts.size(), count)};
  return review_of(std::move(assembly), options, std::move(clashes));
}

Result<void> write_json(const Report& report, const std::string& file) {
  return write_file(file, kJson, [&](Sink& sink) { return write_clash_json(sink, report.internal()); });
}

Result<void> write_csv(const Report& report, const std::string& file) {
  return write_file(file, kCsv, [&](Sink& sink) { return write_csv(sink, report.internal()); });
}

Result<void> write_matrix(const Report& report, const std::string& file) {
  return write_file(file, kMatrix, [&](Sink& sink) { return write_matrix(sink, report.internal()); });
}

Result<void> write_bcf(const Report& report, const std::string& file) {
  const Review& review = report.internal();
  return write_file(file, kBcf, [&](Sink& sink) { return write_bcf(sink, review, topics_of(review), [] {}); });
}

Result<void> write_gltf(const Report& report, const std::string& file) {
  return write_file(file, kGltf, [&](Sink& sink) { return write_gltf(sink, report.internal()); });
}

Result<void> write_page(const Report& report, const std::string& file) {
  const Review& review = report.internal();
  const ReportOptions& options = review.options;
  const Result<std::string> page = read_page_template(options.page_program);
  if (!page) return page.error();
  return write_file(file, kPage, [&](Sink& sink) {
    const PageBlocks blocks{[&](Sink& to) { return write_clash_json(to, review); }};
    return write_page(sink, *page, review.assembly, options, blocks, options.stop);
  });
}

}  // namespace impinge::report
