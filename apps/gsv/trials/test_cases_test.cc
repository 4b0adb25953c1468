#include "apps/gsv/trials/test_cases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/base/test_folder.h"

namespace gsv::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kScenario = "world: maze\nduration: 3\n";

class TestCasesTest : public ::testing::Test {
 protected:
  std::vector<std::string> Names(const std::vector<std::string>& given) {
    problems_.clear();
    const auto cases = FindTestCases(given, problems_);
    if (!cases) return {cases.error().Sentence()};
    std::vector<std::string> names;
    for (const TestCase& test : *cases)
      names.push_back(std::filesystem::path(test.name).lexically_relative(path()));
    return names;
  }
  std::string path() const { return folder_.path(); }

  const base::testing::TestFolder folder_{};
  base::Problems problems_;
};

TEST_F(TestCasesTest, FolderSelectsItsScenariosByName) {
  folder_.Write("b.yaml", kScenario);
  folder_.Write("a.yaml", kScenario);
  folder_.Write("notes.txt", "no scenario");
  folder_.Write("below/c.yaml", kScenario);
  EXPECT_THAT(Names({path()}), ElementsAre("a", "b"));
  EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(TestCasesTest, FileNamedTwiceIsOneCase) {
  const std::string a = folder_.Write("a.yaml", kScenario), b = folder_.Write("b.yaml", kScenario);
  EXPECT_THAT(Names({b, path(), a}), ElementsAre("b", "a"));
}

TEST_F(TestCasesTest, EachCaseHasItsOwnFolder) {
  folder_.Write("go-to.yaml", kScenario);
  folder_.Write("go_to.yaml", kScenario);
  folder_.Write("go.to.yaml", kScenario);
  const auto cases = FindTestCases({path()}, problems_);
  ASSERT_TRUE(cases);
  std::vector<std::string> ends;
  for (const TestCase& test : *cases) {
    ends.push_back(test.folder.substr(test.folder.find("go")));
  }
  EXPECT_THAT(ends, ElementsAre("go_to", "go_to_2", "go_to_3"));
}

TEST_F(TestCasesTest, MissingFileIsAnError) {
  EXPECT_THAT(
      Names({path() + "/none.yaml"}),
      ElementsAre(HasSubstr("none.yaml: there is no scenario file or folder of this name")));
  EXPECT_THAT(Names({path()}),
              ElementsAre(HasSubstr("the folder has no scenario files (*.yaml, *.yml)")));
}

TEST_F(TestCasesTest, EveryProblemOfEveryFileIsReported) {
  folder_.Write("a.yaml", "world: maze\n");
  folder_.Write("b.yaml", "world: maze\nduration: 3\nwrld: x\n");
  EXPECT_THAT(Names({path()}), SizeIs(2));
  ASSERT_THAT(problems_, SizeIs(2));
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("a.yaml: a test needs an end"));
  EXPECT_THAT(problems_[1].Sentence(), HasSubstr("b.yaml:3:1: there is no key \"wrld\" here"));
}

TEST(Shards, ParsesIOfN) {
  const auto shard = ParseShard("2/3");
  ASSERT_TRUE(shard);
  EXPECT_EQ(shard->index, 2u);
  EXPECT_EQ(shard->count, 3u);
  for (const char* bad : {"", "/", "1", "1/", "/3", "0/3", "4/3", "1/3x", "x1/3", "-1/3", "1 /3",
                          "1/0", "1/99999999999999999999"}) {
    const auto refused = ParseShard(bad);
    ASSERT_FALSE(refused) << bad;
    EXPECT_EQ(refused.error().code, base::ErrorCode::kInvalidArgument);
    EXPECT_EQ(refused.error().where, std::string("--shard ") + bad);
  }
}

TEST(Shards, TogetherContainEachCaseOnce) {
  std::vector<TestCase> cases;
  for (const char* name : {"a", "b", "c", "d", "e"}) cases.push_back({name, name});
  const auto names = [&](std::size_t index) {
    std::string share;
    for (const TestCase& test : ShareOf(cases, {index, 3})) share += test.name;
    return share;
  };
  EXPECT_EQ(names(1), "ad");
  EXPECT_EQ(names(2), "be");
  EXPECT_EQ(names(3), "c");
  EXPECT_THAT(ShareOf({}, {1, 1}), IsEmpty());
}

}  // namespace
}  // namespace gsv::app
