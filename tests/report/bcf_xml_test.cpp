// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Texts of BCF.
#include "report/bcf/bcf_xml.hpp"

#include <gtest/gtest.h>

#include <pugixml.hpp>

#include "report/text.hpp"

namespace impinge::report {
namespace {

TEST(XmlText, IsReadBackAsItWas) {
  for (const char* text : {"", "bolt", "a<b>&\"'c", "]]>", "&amp;", "<!-- -->", "\xC3\xA9\xF0\x9F\x94\xA9",
                           "two\nlines", "a\tb", "<script>alert(1)</script>"}) {
    pugi::xml_document document;
    const std::string xml = "<a b=\"" + xml_text(text) + "\">" + xml_text(text) + "</a>";
    ASSERT_TRUE(document.load_string(xml.c_str(), pugi::parse_minimal | pugi::parse_escapes | pugi::parse_ws_pcdata))
        << xml;
    EXPECT_EQ(std::string(document.child("a").text().get()), text);
    EXPECT_EQ(std::string(document.child("a").attribute("b").value()), text);
  }
}

TEST(XmlText, HoldsOnlyWhatXmlCan) {
  using namespace std::string_literals;
  const std::string bad = "\0\x01\x1b\r\x7f\xff\xC3\xEF\xBF\xBE\xEF\xBF\xBF\xED\xA0\x80z"s;
  const std::string text = xml_text(bad);
  EXPECT_EQ(valid_utf8(text), text);
  for (const char c : text) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20) << static_cast<int>(c);
  EXPECT_EQ(text.find("\xEF\xBF\xBE"), std::string::npos);
  EXPECT_EQ(text.find("\xEF\xBF\xBF"), std::string::npos);
  EXPECT_TRUE(text.ends_with('z'));
}

}  // namespace
}  // namespace impinge::report
