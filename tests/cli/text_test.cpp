// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/text.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "program.hpp"
#include "report/json_writer.hpp"

namespace impinge::report {
namespace {

TEST(Text, PrintableReplacesInvalidUtf8ByteByByte) {
  EXPECT_EQ(printable("a\xc3\xa4\xe2\x82\xac\xf0\x9f\x94\xa9"), "a\xc3\xa4\xe2\x82\xac\xf0\x9f\x94\xa9");
  const std::string r = "\xEF\xBF\xBD";
  EXPECT_EQ(printable("\x80z"), r + "z");
  EXPECT_EQ(printable("\xc3"), r);                          // cut short
  EXPECT_EQ(printable("\xc0\xaf"), r + r);                  // overlong
  EXPECT_EQ(printable("\xe0\x80\x80"), r + r + r);          // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), r + r + r);          // surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), r + r + r + r);  // above U+10FFFF
  EXPECT_EQ(printable("\xf0\x9f\x94"), r + r + r);
}

TEST(Text, DistinctUtf8KeepsDifferentTextsDifferent) {
  EXPECT_EQ(distinct_utf8("a\xc3\xa4 \\x5 \\xfg \\"), "a\xc3\xa4 \\x5 \\xfg \\");
  EXPECT_EQ(distinct_utf8("T\xfcr\x80"), "T\\xfcr\\x80");
  EXPECT_EQ(distinct_utf8("\xc3"), "\\xc3");
  EXPECT_EQ(distinct_utf8("\\xff"), "\\x5cxff") << "it is not the byte";
  EXPECT_EQ(distinct_utf8("\\\xff"), "\\\\xff");
}

TEST(Text, PrintableSpellsOutWhatSteersATerminal) {
  EXPECT_EQ(printable("plain \xc3\xa4"), "plain \xc3\xa4");
  EXPECT_EQ(printable(std::string_view("\0\x1b[1m\n\t\r\x7f", 9)), "\\x00\\x1b[1m\\n\\t\\r\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"), "\\u009b");
  EXPECT_EQ(printable("\xe2\x80\xae\xe2\x80\xa8"), "\\u202e\\u2028");
  EXPECT_EQ(printable("\xf3\xa0\x81\x81"), "\\ue0041");
  EXPECT_EQ(printable("\xef\xbf\xbe"), "\\ufffe");
}

TEST(Text, ColumnsCountWideAndCombiningCharacters) {
  EXPECT_EQ(columns("abc"), 3U);
  EXPECT_EQ(columns("\xe9\x83\xa8\xe5\x93\x81"), 4U);
  EXPECT_EQ(columns("a\xcc\x88"), 1U);
  EXPECT_EQ(columns("\xf0\x9f\x94\xa9"), 2U);
}

TEST(Text, FitCutsInTheMiddle) {
  EXPECT_EQ(fit("Cylinder_0012", 13), "Cylinder_0012");
  EXPECT_EQ(fit("Cylinder_0012", 10),
            "Cylind\xe2\x80\xa6"
            "012");
  EXPECT_EQ(fit("Cylinder_0012", 1), "\xe2\x80\xa6");
  EXPECT_EQ(fit("Cylinder_0012", 0), "");
  EXPECT_EQ(fit("", 5), "");
}

TEST(Text, FitNeverExceedsTheWidthNorSplitsACharacter) {
  const std::string text =
      "\xe9\x83\xa8"
      "a\xcc\x88\xcc\x88\xf0\x9f\x94\xa9"
      "b\xe5\x93\x81\xe5\x93\x81"
      "cc\xcc\x88\xe9\x83\xa8";
  for (std::size_t width = 0; width < 20; ++width) {
    const std::string cut = fit(text, width);
    EXPECT_LE(columns(cut), width);
    EXPECT_EQ(printable(cut), cut);
    // A combining mark after the dots would have lost its letter.
    EXPECT_EQ(cut.find("\xe2\x80\xa6\xcc\x88"), std::string::npos);
  }
}

TEST(Text, PatternsMatchWholeNames) {
  EXPECT_TRUE(matches_pattern("bolt*", "bolt_1"));
  EXPECT_TRUE(matches_pattern("*", ""));
  EXPECT_TRUE(matches_pattern("a*b*c", "axxbyybzc"));
  EXPECT_FALSE(matches_pattern("a*b*c", "axxbyybz"));
  EXPECT_TRUE(matches_pattern("?", "\xc3\xa4"));
  EXPECT_FALSE(matches_pattern("??", "\xc3\xa4"));
  EXPECT_TRUE(matches_pattern("*\xc3\xa4?", "\xc3\xa4\xc3\xa4x"));
  EXPECT_FALSE(matches_pattern("", "a"));
  EXPECT_FALSE(matches_pattern("a", ""));
  EXPECT_TRUE(matches_pattern("\xff?", "\xff\xfe"));
  // Takes no exponential time.
  EXPECT_FALSE(matches_pattern("a*a*a*a*a*a*a*a*a*a*b", std::string(2000, 'a')));
}

TEST(Text, EditDistanceCountsCharacters) {
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("Bolt", "bOLT"), 0U);
  EXPECT_EQ(edit_distance("\xc3\xa4", "a"), 1U);
  EXPECT_EQ(edit_distance("--htlm", "--html"), 1U);
  EXPECT_EQ(edit_distance("--htlm", "--help"), 2U);
  EXPECT_EQ(edit_distance("abcd", "badc"), 2U);
  EXPECT_EQ(edit_distance("ca", "abc"), 3U);  // no character takes part in two changes
  EXPECT_EQ(edit_distance("abc", ""), 3U);
}

TEST(Text, NumbersForPeople) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(std::numeric_limits<std::uint64_t>::max()), "18,446,744,073,709,551,615");
  EXPECT_EQ(counted(1, "pair"), "1 pair");
  EXPECT_EQ(counted(0, "pair"), "0 pairs");
}

TEST(Text, DurationsChangeUnitsWithoutFourDigits) {
  EXPECT_EQ(duration(0), "0 s");
  EXPECT_EQ(duration(-1), "0 s");
  EXPECT_EQ(duration(85e-9), "85 ns");
  EXPECT_EQ(duration(999.6e-9), "1 µs");
  EXPECT_EQ(duration(999.6e-6), "1 ms");
  EXPECT_EQ(duration(0.9996), "1.00 s");
  EXPECT_EQ(duration(1.239), "1.24 s");
  EXPECT_EQ(duration(9.996), "10.0 s");
  EXPECT_EQ(duration(119.96), "2 min 0 s");
  EXPECT_EQ(duration(std::numeric_limits<double>::quiet_NaN()), "0 s");
  EXPECT_EQ(duration(std::numeric_limits<double>::infinity()), "inf s");
}

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
