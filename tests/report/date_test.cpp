// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Dates of documents.
#include "date.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace impinge::cli {
namespace {

TEST(Date, IsTakenInTwoForms) {
  EXPECT_EQ(parse_date("2024-05-31"), "2024-05-31T00:00:00Z");
  EXPECT_EQ(parse_date("2024-02-29T23:59:59Z"), "2024-02-29T23:59:59Z");
  EXPECT_EQ(parse_date("0001-01-01"), "0001-01-01T00:00:00Z");
  EXPECT_EQ(parse_date("9999-12-31"), "9999-12-31T00:00:00Z");
  const auto now = parse_date("now");
  ASSERT_TRUE(now);
  EXPECT_EQ(parse_date(*now), now);
  EXPECT_GT(*now, "2024");
}

TEST(Date, OfNoDayIsNone) {
  for (const char* text :
       {"", "2024", "2023-02-29", "2024-13-01", "2024-00-01", "2024-01-00", "2024-01-32", "0000-01-01", "2024-1-1",
        "2024-01-01T24:00:00Z", "2024-01-01T00:60:00Z", "2024-01-01T00:00:60Z", "2024-01-01T00:00:00", "24-01-01",
        "2024-01-01 00:00:00Z", "2024-01-01T00:00:00+01:00", "yesterday", "-024-01-01", "2024-01-01Z"})
    EXPECT_FALSE(parse_date(text)) << text;
}

/// The variable is put back afterwards.
class Epoch : public testing::Test {
 protected:
  void TearDown() override { ::unsetenv("SOURCE_DATE_EPOCH"); }
  static void set(const char* value) { ::setenv("SOURCE_DATE_EPOCH", value, 1); }
};

TEST_F(Epoch, SaysTheUsualDate) {
  // Dates of this form are in the order of their texts.
  const auto expect_now = [] {
    const auto before = parse_date("now"), date = std::optional(*usual_date()), after = parse_date("now");
    EXPECT_LE(*before, *date);
    EXPECT_LE(*date, *after);
  };
  ::unsetenv("SOURCE_DATE_EPOCH");
  expect_now();
  set("");
  expect_now();
  set("1000000000");  // date -u -d @1000000000
  EXPECT_EQ(*usual_date(), "2001-09-09T01:46:40Z");
  set("951782400");
  EXPECT_EQ(*usual_date(), "2000-02-29T00:00:00Z");
  set("253402300799");
  EXPECT_EQ(*usual_date(), "9999-12-31T23:59:59Z");
  for (const char* wrong : {"253402300800", "-1", "1e9", "soon", "99999999999999999999"}) {
    set(wrong);
    ASSERT_FALSE(usual_date()) << wrong;
    EXPECT_NE(usual_date().error().message.find(wrong), std::string::npos);
  }
}

}  // namespace
}  // namespace impinge::cli
