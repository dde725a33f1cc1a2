// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/date.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "numbers.hpp"

namespace impinge::report {
namespace {

using namespace std::chrono;

std::string text_of(sys_seconds time) {
  const sys_days day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count());
}

/// The digits of the pattern's places 'n', which the text must have there and nothing else; its other characters too.
std::optional<std::string> digits(std::string_view text, std::string_view pattern) {
  if (text.size() != pattern.size()) return std::nullopt;
  std::string found;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_digit = text[i] >= '0' && text[i] <= '9';
    if (pattern[i] == 'n' ? !is_digit : text[i] != pattern[i]) return std::nullopt;
    if (is_digit) found += text[i];
  }
  return found;
}

}  // namespace

std::optional<std::string> parse_date(std::string_view text) {
  if (text == "now") return text_of(floor<seconds>(system_clock::now()));
  auto found = digits(text, "nnnn-nn-nnTnn:nn:nnZ");
  if (!found) {
    found = digits(text, "nnnn-nn-nn");
    if (!found) return std::nullopt;
    *found += "000000";
  }
  const auto number = [&](std::size_t at, std::size_t count) { return std::stoi(found->substr(at, count)); };
  const year_month_day date(year(number(0, 4)), month(static_cast<unsigned>(number(4, 2))),
                            day(static_cast<unsigned>(number(6, 2))));
  // XML Schema has no year 0.
  if (!date.ok() || number(0, 4) == 0 || number(8, 2) > 23 || number(10, 2) > 59 || number(12, 2) > 59)
    return std::nullopt;
  return text_of(sys_days(date) + hours(number(8, 2)) + minutes(number(10, 2)) + seconds(number(12, 2)));
}

Result<std::string> usual_date() {
  const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
  if (epoch == nullptr || *epoch == '\0') return text_of({});
  constexpr std::uint64_t kYear10000 = 253402300800;
  const std::optional<std::uint64_t> count = cli::parse_whole(epoch);
  if (!count || *count >= kYear10000)
    return Error{Code::bad_option,
                 fmt::format("the variable SOURCE_DATE_EPOCH is '{}', not a number of seconds since 1970", epoch)};
  return text_of(sys_seconds(seconds(*count)));
}

}  // namespace impinge::report
