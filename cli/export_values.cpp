// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "export_values.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "numbers.hpp"
#include "report/date.hpp"

namespace impinge::cli {
namespace {

Result<void> take_unit(const std::string& text, ExportArguments& to) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
  if (text.empty()) return {};
  for (const auto& [name, metres] : kUnits)
    if (text == name) return to.metres = metres, Result<void>();
  return bad_option(fmt::format("--unit is m, cm, mm, in or ft, not '{}'", text));
}

Result<void> take_date(const std::string& text, ExportArguments& to) {
  if (text.empty()) {
    const Result<std::string> date = usual_date();
    if (!date) return date.error();
    to.date = *date;
    return {};
  }
  const std::optional<std::string> date = parse_date(text);
  if (!date) return bad_option(fmt::format("--date takes now, or a date such as 2024-05-31, not '{}'", text));
  to.date = *date;
  return {};
}

}  // namespace

Result<void> take_exports(const Raw& raw, ExportArguments& to) {
  if (!raw.csv.empty()) to.csv = raw.csv;
  if (!raw.bcf.empty()) to.bcf = raw.bcf;
  if (!raw.gltf.empty()) to.gltf = raw.gltf;
  if (!to.bcf && !raw.date.empty()) return bad_option("--date is for the topics of --bcf FILE");
  if (!to.bcf && !raw.topics.empty()) return bad_option("--bcf-topics is for the topics of --bcf FILE");
  if (!to.csv && !to.bcf && !to.gltf && !raw.unit.empty())
    return bad_option("--unit is for --csv FILE, --bcf FILE and --gltf FILE; nothing else depends on it");
  if (auto taken = take_unit(raw.unit, to); !taken) return taken;
  constexpr std::uint64_t kMostTopics = 20'000;  // a zip archive counts its members in 16 bits
  if (!raw.topics.empty()) {
    const auto topics = parse_whole(raw.topics);
    if (!topics || *topics > kMostTopics)
      return bad_option(
          fmt::format("--bcf-topics takes a whole number from 0 to {}, not '{}'", kMostTopics, raw.topics));
    to.topics = *topics;
  }
  return to.bcf ? take_date(raw.date, to) : Result<void>();
}

}  // namespace impinge::cli
