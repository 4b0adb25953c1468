#include "gsv/formats/files/xml_fault.h"

#include <gmock/gmock.h>

namespace gsv::formats {
namespace {

using ::testing::HasSubstr;

void ExpectFault(std::string_view text, int line, int column, const std::string& sentence) {
  const auto fault = FindXmlFault(text);
  ASSERT_TRUE(fault) << text;
  EXPECT_EQ(fault->line, line) << text;
  EXPECT_EQ(fault->column, column) << text;
  EXPECT_THAT(fault->sentence, HasSubstr(sentence)) << text;
}

TEST(XmlFault, IsAbsentInWellFormedText) {
  EXPECT_FALSE(
      FindXmlFault("<?xml version='1.0'?>\n<!DOCTYPE a>\n<!-- < & --><a b='<' c = \"'\">"
                   "<![CDATA[ <x> ]]><d/>text</a >\n"));
}

TEST(XmlFault, ReportsAnUnsupportedEncoding) {
  ExpectFault(std::string_view("\xff\xfe<\0a\0", 6), 1, 1, "the text is in UTF-16");
}

TEST(XmlFault, ReportsAnUnclosedElement) {
  ExpectFault("<sdf>\n  <world>\n  </world>\n", 1, 1, "<sdf> is not closed. Add </sdf>");
  ExpectFault("<sdf>\n  <world>\n</sdf>", 3, 1,
              "expected </world>, found </sdf>. Close <world> of line 2 first");
  ExpectFault("<sdf></sdf></world>", 1, 12, "</world> has no opening tag");
}

TEST(XmlFault, ReportsUnclosedTags) {
  ExpectFault("<sdf>\n<world <model/></world></sdf>", 2, 1, "the tag <world does not end");
  ExpectFault("<a></a", 1, 4, "the tag </a does not end");
  ExpectFault("<a>1 < 2</a>", 1, 6, "In text, write &lt;");
}

TEST(XmlFault, ReportsMalformedAttributes) {
  ExpectFault("<a b=1/>", 1, 4, "the attribute b of <a> needs a value in quotes");
  ExpectFault("<a b='1/>", 1, 4, "the attribute b of <a> needs a value in quotes");
  ExpectFault("<a b/>", 1, 4, "an attribute of <a> is malformed");
}

TEST(XmlFault, ReportsUnclosedComments) {
  ExpectFault("<a>\n <!-- </a>", 2, 2, "the comment does not end. Add -->");
  ExpectFault("", 1, 1, "the file contains no element");
}

TEST(XmlFault, SurvivesTextOfAnyKind) {
  for (const std::string& text :
       {std::string("<"), std::string("</"), std::string("<!"), std::string("<a b"),
        std::string("<a b="), std::string("\0<\0", 3), std::string(1000, '<')}) {
    EXPECT_TRUE(FindXmlFault(text)) << text;
  }
}

}  // namespace
}  // namespace gsv::formats
