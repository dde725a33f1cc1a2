// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"
#include "report/json_writer.hpp"

namespace impinge::report {
namespace {

TEST(JsonText, StringsReadBackAndBytesThatAreNotUtf8AreReplaced) {
  std::string ascii;
  for (int byte = 0; byte < 128; ++byte) ascii += static_cast<char>(byte);
  for (const std::string& text :
       {std::string(), std::string("\"\\/\b\f\n\r\t"), std::string("\xf0\x9f\x94\xa9"), ascii})
    EXPECT_EQ(as_read_back(text), text);
  std::string high, replaced;
  for (int byte = 128; byte < 256; ++byte) {  // none is followed by what would make a character of it
    high += static_cast<char>(byte);
    replaced += "\xEF\xBF\xBD";
  }
  EXPECT_EQ(as_read_back(high), replaced);
  EXPECT_EQ(as_read_back("\xe2\x82z"), "\xEF\xBF\xBDz") << "a character cut short is one U+FFFD (Unicode, table 3-8)";
}

TEST(JsonText, NumbersReadBackBitForBit) {
  for (const double value : {0.1, 1e-5, 5e-324, 1.7976931348623157e308, -123456789.125, 1e22, 1.0})
    EXPECT_EQ(nlohmann::json::parse(json_text(value)).get<double>(), value);
  EXPECT_EQ(json_text(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(json_text(std::nan("")), "null");
  EXPECT_EQ(json_text(json_point({-0.0, 0.5, -0.0})), "[0.0,0.5,0.0]");
  EXPECT_EQ(json_text(json_map({{-0.0, 1, 2, 3, 4, 5, 6, 7, 8}, {-9, -0.0, 9}})),
            "[0.0,1.0,2.0,-9.0,3.0,4.0,5.0,0.0,6.0,7.0,8.0,9.0]");
}

TEST(JsonText, DocumentsAreValidWhateverTheyHold) {
  const test::Folder folder;
  const Result<Target> target = Target::check((folder.path() / "out.json").string(), kJson);
  ASSERT_TRUE(target);
  Result<Written> written = target->write([](Sink& sink) {
    JsonDocument document(sink);
    document.list("none", 0, [](std::size_t) { return Json(); });
    document.list("two", 2, [](std::size_t i) { return Json(i); });
    document.list("streamed", 2, [&](std::size_t) { sink.write("{}"); });
    document.member("last", nullptr);
    return document.end();
  });
  ASSERT_TRUE(written && written->put());
  EXPECT_EQ(nlohmann::json::parse(folder.read("out.json")),
            nlohmann::json::parse(R"({"none":[],"two":[0,1],"streamed":[{},{}],"last":null})"));
}

}  // namespace
}  // namespace impinge::report
