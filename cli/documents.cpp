// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "documents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

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

Result<void> Documents::order(const DocumentKind& kind, const std::optional<std::string>& place) {
  if (!place) return {};
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
  return {};
}

Result<void> Documents::put() {
  // JSON, which is ordered first and is what the next run compares with, comes last.
  for (auto ordered = ordered_.rbegin(); ordered != ordered_.rend(); ++ordered)
    if (auto put = ordered->written.put(); !put) return put;
  return {};
}

bool Documents::on_standard_output() const {
  return std::any_of(ordered_.begin(), ordered_.end(), [](const Ordered& o) { return o.target.is_standard_output(); });
}

}  // namespace impinge::cli
