// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace impinge::cli {
namespace {

TEST(Numbers, WholeNumbersAreAllDigits) {
  EXPECT_EQ(parse_whole("0"), 0U);
  EXPECT_EQ(parse_whole("010"), 10U);
  EXPECT_EQ(parse_whole("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  for (const char* text : {"", "18446744073709551616", "-1", "+1", " 1", "1 ", "1.0", "0x10", "1,000"})
    EXPECT_EQ(parse_whole(text), std::nullopt) << text;
}

TEST(Numbers, BytesTakeDecimalUnits) {
  EXPECT_EQ(parse_bytes("0"), 0U);
  EXPECT_EQ(parse_bytes("12"), 12U);
  EXPECT_EQ(parse_bytes("12B"), 12U);
  EXPECT_EQ(parse_bytes("500M"), 500'000'000U);
  EXPECT_EQ(parse_bytes("2G"), 2'000'000'000U);
  EXPECT_EQ(parse_bytes("2gb"), 2'000'000'000U);
  EXPECT_EQ(parse_bytes("3k"), 3'000U);
  EXPECT_EQ(parse_bytes("18446744T"), 18'446'744'000'000'000'000U);
  for (const char* text : {"", "G", "B", "2X", "2GG", "-2G", "1.5G", "18446745T", "2 G"})
    EXPECT_EQ(parse_bytes(text), std::nullopt) << text;
}

TEST(Numbers, FactorsArePositiveAndFinite) {
  EXPECT_EQ(parse_positive("25.4"), 25.4);
  EXPECT_EQ(parse_positive("1e-3"), 0.001);
  for (const char* text : {"", "0", "-0", "-1", "inf", "nan", "1e999", "1,5", "2x", " 2", "1e-999"})
    EXPECT_EQ(parse_positive(text), std::nullopt) << text;
}

TEST(Numbers, LengthsMayBeNothing) {
  EXPECT_EQ(parse_length("0"), 0.0);
  EXPECT_FALSE(std::signbit(parse_length("-0").value()));
  EXPECT_EQ(parse_length("2.5"), 2.5);
  EXPECT_EQ(parse_length("1e-9"), 1e-9);
  for (const char* text : {"", "-1", "-1e-9", "inf", "-inf", "nan", "-nan", "1e999", "1,5", "2mm", " 2", "auto"})
    EXPECT_EQ(parse_length(text), std::nullopt) << text;
}

}  // namespace
}  // namespace impinge::cli
