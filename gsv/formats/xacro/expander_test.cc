// Tests the expansion of xacro files as xacro's documentation describes it. The expected values
// were computed by hand.
#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/xacro/arguments.h"
#include "gsv/formats/xacro/xacro.h"

namespace gsv::formats::xacro {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class ExpanderTest : public testing::Test {
 protected:
  // Expands the file. Returns the content of the root element on one line, or "refused: …" with the
  // place.
  std::string Expanded(const std::string& content, std::map<std::string, std::string> args = {}) {
    const auto file = folder_.Write("robot.xacro", "<robot>" + content + "</robot>");
    tinyxml2::XMLDocument document;
    EXPECT_EQ(document.LoadFile(file.c_str()), tinyxml2::XML_SUCCESS) << content;
    const ResourceFinder finder({}, allows_absolute_paths_);
    const auto xml = Expand(*document.RootElement(), file, {finder, limits_, args}, problems_);
    if (!xml) return "refused: " + xml.error().Sentence();
    tinyxml2::XMLDocument plain;
    EXPECT_EQ(plain.Parse(xml->xml.c_str()), tinyxml2::XML_SUCCESS) << xml->xml;
    tinyxml2::XMLPrinter printer(nullptr, true);
    for (auto* child = plain.RootElement()->FirstChild(); child != nullptr;
         child = child->NextSibling()) {
      child->Accept(&printer);
    }
    return printer.CStr();
  }

  base::testing::TestFolder folder_;
  base::Problems problems_;
  ReadLimits limits_;
  bool allows_absolute_paths_ = true;
};

TEST_F(ExpanderTest, SubstitutesPropertiesInAttributesAndTexts) {
  EXPECT_EQ(Expanded("<xacro:property name='r' value='0.5'/><a d='${2 * r}' e='x${r}y'>z ${r}</a>"),
            "<a d=\"1.0\" e=\"x0.5y\">z 0.5</a>");
  // Numbers keep their type: an integer has no decimal point.
  EXPECT_EQ(Expanded("<xacro:property name='n' value='100'/><a n='${n}' m='${n / 2}'/>"),
            "<a n=\"100\" m=\"50.0\"/>");
  // Properties are evaluated on first use, in the scope of their definition.
  EXPECT_EQ(Expanded("<xacro:property name='b' value='${2 * a}'/>"
                     "<xacro:property name='a' value='21'/><x b='${b}'/>"),
            "<x b=\"42\"/>");
  // A text that only looks like arithmetic stays a text.
  EXPECT_EQ(Expanded("<xacro:property name='p' value='5 -2'/><a p='${p}'/>"), "<a p=\"5 -2\"/>");
}

TEST_F(ExpanderTest, RejectsRecursiveProperties) {
  EXPECT_THAT(Expanded("<xacro:property name='a' value='${b}'/>\n"
                       "<xacro:property name='b' value='${a + 1}'/><x a='${a}'/>"),
              HasSubstr("robot.xacro:1: the property \"a\" is defined by itself"));
}

TEST_F(ExpanderTest, ReadsADoubledDollarAsOneDollar) {
  EXPECT_EQ(Expanded("<a b='$${x}' c='$$${x}' d='$$(cwd)' e='$' f='a $ b'/>"),
            "<a b=\"${x}\" c=\"$${x}\" d=\"$(cwd)\" e=\"$\" f=\"a $ b\"/>");
}

TEST_F(ExpanderTest, CallsMacrosWithValuesAndDefaults) {
  const std::string macro =
      "<xacro:macro name='wheel' params=\"side reflect:=1 label:='a b'\">"
      "<w n='${side}_wheel' y='${reflect * 0.2}' l='${label}'/></xacro:macro>";
  EXPECT_EQ(Expanded(macro + "<xacro:wheel side='left'/><xacro:wheel side='right' reflect='-1'/>"),
            "<w n=\"left_wheel\" y=\"0.2\" l=\"a b\"/><w n=\"right_wheel\" y=\"-0.2\" l=\"a b\"/>");
  EXPECT_THAT(Expanded(macro + "<xacro:wheel/>"), HasSubstr("lacks the parameter \"side\""));
  EXPECT_THAT(Expanded(macro + "<xacro:wheel side='l' colour='red'/>"),
              HasSubstr("the macro has no parameter \"colour\""));
  EXPECT_THAT(Expanded(macro + "\n<xacro:wheels side='l'/>"),
              HasSubstr("robot.xacro:2: there is no macro \"wheels\""));
}

TEST_F(ExpanderTest, InsertsBlocks) {
  EXPECT_EQ(Expanded("<xacro:macro name='m' params='*one **many'><x><xacro:insert_block "
                     "name='one'/></x><y><xacro:insert_block name='many'/></y></xacro:macro>"
                     "<xacro:m><o a='${1 + 1}'/><c><d/><e/></c></xacro:m>"),
            "<x><o a=\"2\"/></x><y><d/><e/></y>");
  EXPECT_EQ(Expanded("<xacro:property name='b'><i v='${k}'/></xacro:property>"
                     "<xacro:property name='k' value='7'/><xacro:insert_block name='b'/>"),
            "<i v=\"7\"/>");
  // A block is passed on through another macro.
  EXPECT_EQ(Expanded("<xacro:macro name='in' params='*b'><i><xacro:insert_block name='b'/></i>"
                     "</xacro:macro><xacro:macro name='out' params='*b'><o><xacro:in>"
                     "<xacro:insert_block name='b'/></xacro:in></o></xacro:macro>"
                     "<xacro:out><woot/></xacro:out>"),
            "<o><i><woot/></i></o>");
  EXPECT_THAT(Expanded("<xacro:macro name='m' params='*b'/><xacro:m/>"),
              HasSubstr("lacks an element for the block \"b\""));
  EXPECT_THAT(Expanded("<xacro:macro name='m'/><xacro:m><x/></xacro:m>"),
              HasSubstr("the macro has no block parameter for the element <x>"));
}

TEST_F(ExpanderTest, ForwardsPropertiesOfTheCaller) {
  const std::string macro = "<xacro:macro name='m' params='a:=^|6'><x a='${a}'/></xacro:macro>";
  EXPECT_EQ(Expanded(macro + "<xacro:m/>"), "<x a=\"6\"/>");
  EXPECT_EQ(Expanded(macro + "<xacro:property name='a' value='42'/><xacro:m/>"), "<x a=\"42\"/>");
}

TEST_F(ExpanderTest, SetsPropertiesOfOuterScopes) {
  EXPECT_EQ(Expanded("<xacro:macro name='m' params='f'><xacro:property name='p' value='${21*f}' "
                     "scope='parent'/></xacro:macro><xacro:m f='2'/><a p='${p}'/>"),
            "<a p=\"42\"/>");
  EXPECT_EQ(Expanded("<xacro:macro name='in'><xacro:property name='p' value='1' scope='global'/>"
                     "</xacro:macro><xacro:macro name='out'><xacro:in/></xacro:macro>"
                     "<xacro:out/><a p='${p}'/>"),
            "<a p=\"1\"/>");
  EXPECT_THAT(Expanded("<xacro:macro name='m'><xacro:property name='p' value='1'/></xacro:macro>"
                       "<xacro:m/><a p='${p}'/>"),
              HasSubstr("\"p\" is not defined"));
}

TEST_F(ExpanderTest, ExpandsInDocumentOrder) {
  EXPECT_EQ(Expanded("<xacro:property name='p' value='1'/><a p='${p}'/>"
                     "<xacro:property name='p' value='2'/><a p='${p}'/>"),
            "<a p=\"1\"/><a p=\"2\"/>");
  EXPECT_EQ(Expanded("<xacro:property name='p' value='1'/><xacro:property name='p' default='2'/>"
                     "<xacro:property name='q' default='3'/><a p='${p}' q='${q}'/>"),
            "<a p=\"1\" q=\"3\"/>");
}

TEST_F(ExpanderTest, KeepsElementsWhoseConditionIsTrue) {
  EXPECT_EQ(Expanded("<xacro:if value='true'><a/></xacro:if><xacro:if value='0'><b/></xacro:if>"
                     "<xacro:unless value='${1 == 2}'><c/></xacro:unless>"
                     "<xacro:if value='${3 * 0.1}'><d/></xacro:if>"
                     "<xacro:if value='false'><xacro:include filename='none.xacro'/></xacro:if>"),
            "<a/><c/><d/>");
  EXPECT_THAT(Expanded("<xacro:if value='nonsense'/>"), HasSubstr("neither true nor false"));
}

TEST_F(ExpanderTest, ArgumentsOverrideTheirDefaults) {
  const std::string file =
      "<xacro:arg name='n' default='0.5'/><xacro:property name='p' "
      "value='$(arg n)'/><a p='${p - 0.25}' n='$(arg n)'/>";
  EXPECT_EQ(Expanded(file), "<a p=\"0.25\" n=\"0.5\"/>");
  EXPECT_EQ(Expanded(file, {{"n", "1"}}), "<a p=\"0.75\" n=\"1\"/>");
  EXPECT_EQ(Expanded("<a b='${xacro.arg(\"x\")}'/>", {{"x", "y"}}), "<a b=\"y\"/>");
  EXPECT_THAT(Expanded("<a b='$(arg nobody)'/>"), HasSubstr("\"nobody\" has no default"));
}

TEST_F(ExpanderTest, IncludesFilesBesideItAndInNamespaces) {
  folder_.Write("parts/wheel.xacro",
                "<robot><xacro:property name='w' value='2'/><xacro:macro name='m'><m w='${w}'/>"
                "</xacro:macro><xacro:include filename='tyre.xacro'/></robot>");
  folder_.Write("parts/tyre.xacro", "<robot><tyre/></robot>");
  EXPECT_EQ(Expanded("<xacro:include filename='parts/wheel.xacro'/><xacro:m/><a w='${w}'/>"),
            "<tyre/><m w=\"2\"/><a w=\"2\"/>");
  EXPECT_EQ(Expanded("<xacro:property name='w' value='1'/>"
                     "<xacro:include filename='parts/wheel.xacro' ns='P'/>"
                     "<xacro:P.m/><a w='${w}' pw='${P.w}'/>"),
            "<tyre/><m w=\"2\"/><a w=\"1\" pw=\"2\"/>");
  folder_.Write("sized.xacro",
                "<robot><xacro:property name='w' value='2'/><xacro:macro name='m' "
                "params='size:=${2 * w}'><m s='${size}'/></xacro:macro></robot>");
  EXPECT_EQ(Expanded("<xacro:include filename='sized.xacro' ns='P'/><xacro:P.m/>"), "<m s=\"4\"/>");
  EXPECT_EQ(Expanded("<xacro:include filename='absent.xacro' optional='true'/><a/>"), "<a/>");
  EXPECT_THAT(problems_, SizeIs(1));
}

TEST_F(ExpanderTest, IncludesAllFilesThatMatchAPattern) {
  folder_.Write("legs/b.xacro", "<robot><b/></robot>");
  folder_.Write("legs/a.xacro", "<robot><a/></robot>");
  folder_.Write("legs/c.txt", "no XML");
  EXPECT_EQ(Expanded("<xacro:include filename='legs/*.xacro'/>"), "<a/><b/>");
  EXPECT_THAT(problems_, SizeIs(0));
  EXPECT_EQ(Expanded("<xacro:include filename='arms/*.xacro'/><c/>"), "<c/>");
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("no file matches the pattern"));
}

TEST_F(ExpanderTest, ReportsTheMessagesOfAFile) {
  EXPECT_EQ(Expanded("\n<a>${xacro.warning('no inertia of', 3)}</a>"), "<a/>");
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("robot.xacro:2: no inertia of 3"));
  EXPECT_THAT(Expanded("<a>${xacro.fatal('no such arm')}</a>"), HasSubstr("refused"));
}

TEST_F(ExpanderTest, SkipsCallsOfMacrosInAMissingFile) {
  EXPECT_EQ(Expanded("\n<xacro:include filename='absent.xacro'/>\n<xacro:lidar name='l'/><a/>"),
            "<a/>");
  ASSERT_THAT(problems_, SizeIs(2));
  EXPECT_THAT(problems_[0].Sentence(),
              HasSubstr("robot.xacro:2: the include of absent.xacro is ignored: cannot find"));
  EXPECT_THAT(problems_[1].Sentence(),
              HasSubstr("robot.xacro:3: the call of the macro \"lidar\" is ignored"));
  // An undefined property is an error, even if a missing file may define it. Only calls of macros
  // are left out.
  EXPECT_THAT(Expanded("<xacro:include filename='absent.xacro'/><a b='${height}'/>"),
              HasSubstr("(absent.xacro is missing)"));
}

TEST_F(ExpanderTest, KeepsTheSourceOfEachElement) {
  const auto part = folder_.Write("part.xacro",
                                  "<robot>\n<xacro:macro name='m' params='*block'>\n<b/>\n"
                                  "<xacro:insert_block name='block'/>\n</xacro:macro>\n</robot>");
  const auto file = folder_.Write("robot.xacro",
                                  "<robot>\n<xacro:include filename='part.xacro'/>\n<a/>\n"
                                  "<xacro:m>\n<c/>\n</xacro:m>\n</robot>");
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.LoadFile(file.c_str()), tinyxml2::XML_SUCCESS);
  const ResourceFinder finder;
  const auto expanded = Expand(*document.RootElement(), file, {finder, limits_, {}}, problems_);
  ASSERT_TRUE(expanded.has_value()) << expanded.error().Sentence();
  std::vector<std::string> places;
  for (const ElementSource& source : expanded->sources) {
    places.push_back(source.file->filename().string() + ":" + std::to_string(source.line));
  }
  EXPECT_EQ(places, (std::vector<std::string>{"robot.xacro:1", "robot.xacro:3", "part.xacro:3",
                                              "robot.xacro:5"}));
  // In the output, <b/> is on the line of the call.
  tinyxml2::XMLDocument plain;
  ASSERT_EQ(plain.Parse(expanded->xml.c_str()), tinyxml2::XML_SUCCESS);
  EXPECT_EQ(plain.RootElement()->FirstChildElement("b")->GetLineNum(), 4);
}

TEST_F(ExpanderTest, FindsPackagesByTheirFolderAndByTheirManifest) {
  folder_.Write("other_folder/package.xml", "<package><name>my_parts</name></package>");
  folder_.Write("other_folder/urdf/a.xacro", "<robot><a f='$(find my_parts)/x'/></robot>");
  const std::string folder = (folder_.path() / "other_folder").string();
  EXPECT_EQ(Expanded("<xacro:include filename='$(find my_parts)/urdf/a.xacro'/>"),
            "<a f=\"" + folder + "/x\"/>");
  EXPECT_EQ(Expanded("<a f='$(find nowhere_to_be_found)/m.stl' g='$(find nowhere_to_be_found)'/>"),
            "<a f=\"package://nowhere_to_be_found/m.stl\" g=\"package://nowhere_to_be_found\"/>");
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_THAT(problems_[0].message, HasSubstr("cannot find the package \"nowhere_to_be_found\""));
}

TEST_F(ExpanderTest, RefusesFilesThatIncludeThemselves) {
  folder_.Write("again.xacro", "<robot><xacro:include filename='again.xacro'/></robot>");
  EXPECT_THAT(Expanded("<xacro:include filename='again.xacro'/>"),
              HasSubstr("again.xacro:1: files include each other deeper than 16"));
}

TEST_F(ExpanderTest, ReadsNoFileOutsideItsFolderIfAbsolutePathsAreForbidden) {
  allows_absolute_paths_ = false;
  EXPECT_EQ(Expanded("<xacro:include filename='/etc/hostname'/>"), "");
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_THAT(problems_[0].message, HasSubstr("the include of /etc/hostname is ignored"));
  EXPECT_THAT(Expanded("<a b=\"${xacro.load_yaml('../../../etc/passwd')}\"/>"),
              HasSubstr("is outside"));
}

TEST_F(ExpanderTest, ReadsYamlWithUnits) {
  folder_.Write("c.yaml", "joints:\n  elbow: {lower: !degrees -180, name: 'e'}\nlist: [1, 2.5]\n");
  EXPECT_EQ(Expanded("<xacro:property name='c' value=\"${xacro.load_yaml('c.yaml')}\"/>"
                     "<a l=\"${c['joints']['elbow']['lower']}\" n='${c.joints.elbow.name}' "
                     "s='${c[\"list\"][1]}'/>"),
            "<a l=\"-3.141592653589793\" n=\"e\" s=\"2.5\"/>");
  folder_.Write("bad.yaml", "a: [1\n");
  EXPECT_THAT(Expanded("<a b=\"${load_yaml('bad.yaml')}\"/>"), HasSubstr("this is not valid YAML"));
}

TEST_F(ExpanderTest, MakesElementsAttributesAndCallsByName) {
  EXPECT_EQ(Expanded("<xacro:macro name='foo'><f/></xacro:macro>"
                     "<xacro:property name='v' value='foo'/><xacro:call macro='${v}'/>"
                     "<xacro:element xacro:name='${v}'><xacro:attribute name='k' value='${1+1}'/>"
                     "</xacro:element>"),
            "<f/><foo k=\"2\"/>");
}

TEST_F(ExpanderTest, AcceptsElementsWithoutThePrefix) {
  EXPECT_EQ(Expanded("<property name='r' value='2'/><macro name='tyre' params='n'><t n='${n}'/>"
                     "</macro><tyre n='${r}'/><if value='${r > 1}'><a/></if>"
                     "<include><uri>model://x</uri></include>"),
            "<t n=\"2\"/><a/><include><uri>model://x</uri></include>");
}

TEST_F(ExpanderTest, DistinguishesElementsFromMacrosOfTheSameName) {
  EXPECT_EQ(Expanded("<xacro:macro name='camera' params='name'><sensor><camera name='${name}'/>"
                     "</sensor></xacro:macro><xacro:camera name='front'/>"),
            "<sensor><camera name=\"front\"/></sensor>");
  EXPECT_EQ(Expanded("<xacro:macro name='ball_inertia' params='m r'><i v='${m * r}'/>"
                     "</xacro:macro><ball_inertia m='2' r='3'/><ball_inertia/>"),
            "<i v=\"6\"/><ball_inertia/>");
}

TEST_F(ExpanderTest, CallsRecursiveMacrosUpToALimit) {
  EXPECT_EQ(Expanded("<xacro:macro name='m' params='n'><i n='${n}'/><xacro:if value='${n > 0}'>"
                     "<xacro:m n='${n - 1}'/></xacro:if></xacro:macro><xacro:m n='2'/>"),
            "<i n=\"2\"/><i n=\"1\"/><i n=\"0\"/>");
  EXPECT_THAT(Expanded("<xacro:macro name='m'><xacro:m/></xacro:macro><xacro:m/>"),
              HasSubstr("nested deeper than 500"));
}

TEST_F(ExpanderTest, StopsEndlessExpansion) {
  limits_.xml_bytes = 1u << 20;
  const std::string doubling =
      "<xacro:macro name='m' params='n *b'><xacro:if value='${n > 0}'><xacro:m n='${n - 1}'><x>"
      "<xacro:insert_block name='b'/><xacro:insert_block name='b'/></x></xacro:m></xacro:if>"
      "<xacro:if value='${n == 0}'><xacro:insert_block name='b'/></xacro:if></xacro:macro>"
      "<xacro:m n='60'><y/></xacro:m>";
  EXPECT_THAT(Expanded(doubling), HasSubstr("larger than the limit of 1048576 bytes"));
  const std::string forking =
      "<xacro:macro name='f' params='n'><xacro:if value='${n > 0}'><xacro:f n='${n-1}'/>"
      "<xacro:f n='${n-1}'/></xacro:if></xacro:macro><xacro:f n='60'/>";
  EXPECT_THAT(Expanded(forking), HasSubstr("steps"));
}

TEST_F(ExpanderTest, ReportsThePlaceOfAnErrorAndOfTheMacrosCall) {
  EXPECT_THAT(Expanded("<xacro:macro name='m'>\n<a b='${1 / 0}'/>\n</xacro:macro>\n<xacro:m/>"),
              AllOf(HasSubstr("robot.xacro:2: division by zero in ${1 / 0}"),
                    HasSubstr("in the macro m called at"), HasSubstr("robot.xacro:4")));
  EXPECT_THAT(Expanded("<a b='$(env HOME)'/>"), HasSubstr("environment variables are not read"));
  EXPECT_THAT(Expanded("<a b='${[x for x in y]}'/>"), HasSubstr("comprehensions"));
}

TEST(XacroArguments, AreTakenFromTheName) {
  const NamedFile named = SplitArguments("a/b.urdf.xacro?arm=true&mesh=x%20y/z&n:=2");
  EXPECT_EQ(named.file, "a/b.urdf.xacro");
  EXPECT_EQ(named.arguments.at("arm"), "true");
  EXPECT_EQ(named.arguments.at("mesh"), "x y/z");
  EXPECT_EQ(named.arguments.at("n"), "2");
  EXPECT_EQ(AsPath("a/b.xacro?f=c/d"), "a/b.xacro?f=c%2Fd");
  EXPECT_EQ(SplitArguments(AsPath("a/b.xacro?f=c/d")).arguments.at("f"), "c/d");
  EXPECT_EQ(SplitArguments("what?.sdf").file, "what?.sdf");
}

}  // namespace
}  // namespace gsv::formats::xacro
