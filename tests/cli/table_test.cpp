// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "table.hpp"

#include <limits>

#include "numbers.hpp"
#include "program.hpp"

namespace impinge::cli {
namespace {

std::string printed(const Table& table, std::optional<std::size_t> width) {
  return test::written([&](Sink& sink) { print(table, sink, width); });
}

Table two_names(const std::string& a, const std::string& b) {
  using enum Column::Kind;
  return {1,
          {{"left", name, [=](std::size_t) { return a; }},
           {"right", name, [=](std::size_t) { return b; }},
           {"n", number, [](std::size_t) { return "12,345"; }},
           {"kind", text, [](std::size_t) { return "flat"; }}}};
}

TEST(Table, PadsToTheWidestCellAndLeavesNoTrailingSpaces) {
  EXPECT_EQ(printed(two_names("abcdefgh", "x"), std::nullopt),
            "left      right       n  kind\n"
            "abcdefgh  x      12,345  flat\n");
}

TEST(Table, AShortNameLeavesItsRoomToTheLongOne) {
  const std::string text = printed(two_names("abc", "abcdefghijklmnopqrstuvwxyz"), 40);
  EXPECT_EQ(text,
            "left  right                      n  kind\n"
            "abc   abcdefghijkl\xe2\x80\xa6tuvwxyz  12,345  flat\n");
}

TEST(Table, NeverCutsNumbersAndKeepsEightColumnsOfAName) {
  const std::string text = printed(two_names("abcdefghijklmnop", "abcdefghijklmnop"), 10);
  EXPECT_NE(text.find("12,345  flat"), std::string::npos);
  EXPECT_NE(text.find("abcde\xe2\x80\xa6op  abcde\xe2\x80\xa6op"), std::string::npos) << text;
}

TEST(Table, StopsWhenAsked) {
  std::stop_source stop;
  std::size_t asked = 0;
  const auto one = [&](std::size_t) {
    if (++asked == 100) stop.request_stop();
    return "1";
  };
  const Table table{1'000'000'000, {{"n", Column::Kind::number, one}}};
  test::written([&](Sink& sink) { print(table, sink, std::nullopt, stop.get_token()); });
  EXPECT_EQ(asked, 100U);
}

TEST(Numbers, WholeNumbersAreAllDigits) {
  EXPECT_EQ(parse_number<std::uint64_t>("0"), 0U);
  EXPECT_EQ(parse_number<std::uint64_t>("010"), 10U);
  EXPECT_EQ(parse_number<std::uint64_t>("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  for (const char* text : {"", "18446744073709551616", "-1", "+1", " 1", "1 ", "1.0", "0x10", "1,000"})
    EXPECT_EQ(parse_number<std::uint64_t>(text), std::nullopt) << text;
}

TEST(Numbers, DecimalsAreRoundedOnce) {
  EXPECT_EQ(parse_number<double>("25.4"), 25.4);
  EXPECT_EQ(parse_number<double>("1e-3"), 0.001);
  for (const char* text : {"", "1e999", "1,5", "2x", "2mm", " 2", "1e-999", "auto"})
    EXPECT_EQ(parse_number<double>(text), std::nullopt) << text;
}

}  // namespace
}  // namespace impinge::cli
