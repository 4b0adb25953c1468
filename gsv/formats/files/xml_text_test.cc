#include "gsv/formats/files/xml_text.h"

#include <gmock/gmock.h>
#include <tinyxml2.h>

namespace gsv::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class XmlText : public testing::Test {
 protected:
  std::string Prepared(const std::string& text, std::size_t max_bytes = 1000) {
    problems_.clear();
    const auto prepared = PrepareXml(text, "a.sdf", max_bytes, problems_);
    return prepared ? *prepared : "error: " + prepared.error().Sentence();
  }
  std::vector<std::string> Sentences() const {
    std::vector<std::string> sentences;
    for (const base::Problem& problem : problems_) sentences.push_back(problem.Sentence());
    return sentences;
  }

  base::Problems problems_;
};

TEST_F(XmlText, ExpandsTheEntitiesOfItsDoctype) {
  EXPECT_EQ(Prepared("<!DOCTYPE a [<!ENTITY n 'hall'> <!ENTITY two \"&n; &n;\">]><a "
                     "b='&two;'>&n;&amp;&#65;</a>"),
            "<a b='hall hall'>hall&amp;&#65;</a>");
  EXPECT_THAT(Sentences(), IsEmpty());
}

TEST_F(XmlText, ExpandsElementsOfAnEntityButNotInAnAttribute) {
  EXPECT_EQ(Prepared("<!DOCTYPE a [<!ENTITY e '<b c=\"1\"/>'>]><a>&e;</a>"), "<a><b c=\"1\"/></a>");
  EXPECT_EQ(Prepared("<!DOCTYPE a [<!ENTITY e '<\"'>]><a b=\"&e;\" c='&e;'/>"),
            "<a b=\"&lt;&quot;\" c='&lt;\"'/>");
}

TEST_F(XmlText, KeepsLineNumbers) {
  EXPECT_EQ(Prepared("<!DOCTYPE a [\n<!ENTITY e '1\n2'>\n]>\n<!-- x\ny --><a>\n&e;<b/></a>"),
            "\n\n\n\n\n<a>\n1 2<b/></a>");
}

TEST_F(XmlText, KeepsTheFirstDeclarationOfAnEntity) {
  EXPECT_EQ(Prepared("<!DOCTYPE a [<!ENTITY e '1'><!ENTITY e '2'>]><a>&e;</a>"), "<a>1</a>");
}

TEST_F(XmlText, RefusesAnEntityThatContainsItself) {
  EXPECT_EQ(Prepared("<!DOCTYPE a [<!ENTITY e '&f;'><!ENTITY f '&e;'>]>\n<a>&e;</a>"),
            "error: a.sdf:2: the entity &e; contains itself");
}

TEST_F(XmlText, RefusesEntitiesThatGrowWithoutBound) {
  std::string text = "<!DOCTYPE a [<!ENTITY e0 '0123456789'>";
  std::string empty = "<!DOCTYPE a [<!ENTITY e0 ''>";
  for (int i = 1; i <= 20; ++i) {
    const std::string inner = "&e" + std::to_string(i - 1) + ";";
    const std::string entity =
        "<!ENTITY e" + std::to_string(i) + " '" + inner + inner + inner + inner + "'>";
    text += entity;
    empty += entity;
  }
  EXPECT_THAT(Prepared(text + "]><a>&e20;</a>"),
              HasSubstr("expand to more than the limit of 1000 bytes"));
  EXPECT_THAT(Prepared(empty + "]><a>&e20;</a>"),
              HasSubstr("more than 1000000 expansions of entities"));
}

TEST_F(XmlText, ReportsEntitiesThatItCannotExpand) {
  EXPECT_EQ(Prepared("<!DOCTYPE a [<!ENTITY e SYSTEM 'secret'>]><a>&e;&nope;&nope;</a>"),
            "<a>&nope;&nope;</a>");
  EXPECT_THAT(Sentences(), ElementsAre(HasSubstr("a.sdf:1: the entity &e; is in another file"),
                                       HasSubstr("the entity &nope; is not declared")));
  EXPECT_EQ(Prepared("<!DOCTYPE a [<!ENTITY % p 'x'> %p;]><a>1 & 2</a>"), "<a>1 & 2</a>");
  EXPECT_THAT(Sentences(), ElementsAre(HasSubstr("parameter entities")));
}

TEST_F(XmlText, JoinsAValueAroundCommentsAndKeepsCharacterData) {
  EXPECT_EQ(Prepared("<a>1 <!-- < & -->2<?mark it?></a>"), "<a>1 2</a>");
  EXPECT_EQ(Prepared("<a><![CDATA[ <3>&e;<!-- ]]></a>"), "<a><![CDATA[ <3>&e;<!-- ]]></a>");
  EXPECT_EQ(Prepared("<a b='<!-- no -->'/>"), "<a b='<!-- no -->'/>");
}

TEST_F(XmlText, ReadsTextThatIsNotUtf8AsLatin1) {
  EXPECT_EQ(Prepared("<?xml version='1.0' encoding='ISO-8859-1'?><a>caf\xe9</a>"),
            "<?xml version='1.0' encoding='ISO-8859-1'?><a>caf\xc3\xa9</a>");
  EXPECT_THAT(Sentences(), IsEmpty());
  EXPECT_EQ(Prepared("<a>\ncaf\xe9</a>"), "<a>\ncaf\xc3\xa9</a>");
  EXPECT_THAT(Sentences(), ElementsAre(HasSubstr("a.sdf:2: the text is not UTF-8")));
  EXPECT_EQ(Prepared("<a>caf\xc3\xa9</a>"), "<a>caf\xc3\xa9</a>");
  EXPECT_THAT(Sentences(), IsEmpty());
}

TEST_F(XmlText, ReportsASecondRootElement) {
  tinyxml2::XMLDocument document;
  ASSERT_TRUE(ParseXml("<a/>\n<b/>", "a.sdf", 1000, document, problems_));
  EXPECT_THAT(Sentences(),
              ElementsAre(HasSubstr("a.sdf:2: a second root element, <b>, is ignored")));
}

TEST_F(XmlText, ReportsTheLineOfMalformedXml) {
  tinyxml2::XMLDocument document;
  const auto status =
      ParseXml("<!DOCTYPE a [<!ENTITY e '<b>'>]>\n<a>\n</b>", "a.sdf", 1000, document, problems_);
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().Sentence(),
              HasSubstr("a.sdf:3:1: the XML is malformed: expected </a>, found </b>"));
}

}  // namespace
}  // namespace gsv::formats
