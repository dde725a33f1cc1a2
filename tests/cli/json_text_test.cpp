// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "report/json_writer.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

TEST(JsonText, StringsReadBack) {
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  for (const std::string& text : {std::string(), std::string("\"\\/\b\f\n\r\t"), std::string("\xf0\x9f\x94\xa9"), all})
    EXPECT_EQ(nlohmann::json::parse(json_string(text)).get<std::string>(), valid_utf8(text));
}

TEST(JsonText, NumbersReadBackBitForBit) {
  for (const double value : {0.1, 1e-5, 5e-324, 1.7976931348623157e308, -123456789.125, 1e22, 1.0})
    EXPECT_EQ(nlohmann::json::parse(json_number(value)).get<double>(), value);
  EXPECT_EQ(json_number(-0.0), "0");
  EXPECT_EQ(json_number(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(json_number(std::nan("")), "null");
}

}  // namespace
}  // namespace impinge::report
