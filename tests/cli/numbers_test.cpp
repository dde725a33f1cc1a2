// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "numbers.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace impinge::cli {
namespace {

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
