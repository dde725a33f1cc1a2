// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "documents.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "report/assembly.hpp"
#include "terminal.hpp"

namespace impinge::cli {

namespace {

/// Whether two names are of one file, also where none is yet. Standard output, "-", is one.
bool is_one_place(const std::string& a, const std::string& b) {
  if (a == b) return true;
  if (a == "-" || b == "-") return false;
  std::error_code unknown;
  if (std::filesystem::equivalent(a, b, unknown)) return true;
  const auto real_a = std::filesystem::weakly_canonical(std::filesystem::absolute(place_behind(a)), unknown);
  const auto real_b = std::filesystem::weakly_canonical(std::filesystem::absolute(place_behind(b)), unknown);
  return !real_a.empty() && real_a == real_b;
}

}  // namespace

Result<void> Documents::order(std::initializer_list<Order> orders) {
  for (const auto& [kind, place] : orders) {
    if (!place) continue;
    for (const std::string& file : files_) {
      std::error_code unknown;
      if (*place != "-" && std::filesystem::equivalent(*place, file, unknown))
        return Error{Code::bad_option, fmt::format("{} {} is one of the files to read", kind.option, *place)};
    }
    for (const Ordered& other : ordered_)
      if (is_one_place(*place, other.place))
        return Error{Code::bad_option, fmt::format("{} and {} cannot both go to {}", other.kind->option, kind.option,
                                                   *place == "-" ? "standard output" : *place)};
    Result<Target> target = Target::check(*place, kind, force_);
    if (!target) return target.error();
    ordered_.push_back({&kind, *place, *std::move(target), {}});
  }
  return {};
}

Result<void> Documents::put() {
  if (!all_written_) return all_written_;
  // JSON, which is ordered first and is what the next run compares with, comes last.
  for (auto ordered = ordered_.rbegin(); ordered != ordered_.rend(); ++ordered)
    if (auto put = ordered->written.put(); !put) return put;
  return {};
}

Result<void> Documents::put_and_print(bool quiet, const std::stop_token& stop,
                                      const std::function<void(Sink&, std::optional<std::size_t> width)>& print) {
  if (auto all_put = put(); !all_put || quiet || on_standard_output()) return all_put;
  Sink out(STDOUT_FILENO, "standard output");
  print(out, width_of(STDOUT_FILENO));
  if (stop.stop_requested()) return interrupted();
  return out.flush();
}

bool Documents::on_standard_output() const {
  return std::any_of(ordered_.begin(), ordered_.end(), [](const Ordered& o) { return o.target.is_standard_output(); });
}

}  // namespace impinge::cli
