// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "date.hpp"

#include <fmt/chrono.h>
#include <time.h>

#include <cstdlib>
#include <ctime>

#include "numbers.hpp"

namespace impinge::cli {
namespace {

std::string text_of(std::time_t time) { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(time)); }

}  // namespace

std::optional<std::string> parse_date(std::string_view text) {
  if (text == "now") return text_of(std::time(nullptr));
  constexpr std::size_t kDay = 10;  // "2024-05-31"
  std::string whole(text);
  if (whole.size() == kDay) whole += "T00:00:00Z";
  std::tm date{};
  if (::strptime(whole.c_str(), "%Y-%m-%dT%H:%M:%SZ", &date) == nullptr) return std::nullopt;
  // Other spellings that strptime takes, and days and times that there are none of, come out as another text. XML
  // Schema has no year 0.
  if (text_of(::timegm(&date)) != whole || whole.starts_with("0000")) return std::nullopt;
  return whole;
}

Result<std::string> usual_date() {
  const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
  if (epoch == nullptr || *epoch == '\0') return text_of(std::time(nullptr));
  constexpr std::uint64_t kYear10000 = 253402300800;
  const std::optional<std::uint64_t> count = parse_number<std::uint64_t>(epoch);
  if (!count || *count >= kYear10000)
    return Error{Code::bad_option,
                 fmt::format("the variable SOURCE_DATE_EPOCH is '{}', not a number of seconds since 1970", epoch)};
  return text_of(static_cast<std::time_t>(*count));
}

}  // namespace impinge::cli
