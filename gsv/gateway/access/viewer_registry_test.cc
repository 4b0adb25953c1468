#include "gsv/gateway/access/viewer_registry.h"

#include <utility>

#include <gtest/gtest.h>

namespace gsv::gateway::access {
namespace {

using std::chrono::seconds;

// Two viewers and a clock that the test sets.
class ViewerRegistryTest : public ::testing::Test {
 protected:
  // Advances the clock. Both viewers send requests until then.
  void WaitUntil(int second) {
    for (; now_ < start_ + seconds(second); now_ += seconds(1)) {
      registry_.List(ada_.key, now_);
      registry_.List(bob_.key, now_);
    }
  }
  std::uint64_t Holder(const std::string& simulation = "arena") {
    for (const auto& person : registry_.List(bob_.key, now_).viewers) {
      if (person.simulation == simulation && person.holds) return person.number;
    }
    return 0;
  }
  base::Status CheckControl(const std::string& key) {
    return registry_.CheckControl(key, "arena", now_);
  }
  ViewerRegistry::ViewerState Bob() { return registry_.List("", now_).viewers.at(1); }

  const ViewerRegistry::Time start_{};
  ViewerRegistry::Time now_ = start_;
  ViewerRegistry registry_{{.absence = seconds(8), .answer = seconds(20)}};
  const ViewerRegistry::Admission ada_ = registry_.Enter("Ada", "arena", now_).value();
  const ViewerRegistry::Admission bob_ = registry_.Enter("  Bob\n", "arena", now_).value();
};

TEST_F(ViewerRegistryTest, WithoutAHolderAllViewersHaveControl) {
  EXPECT_TRUE(CheckControl(ada_.key));
  EXPECT_TRUE(CheckControl(""));
  const auto standing = registry_.List(ada_.key, now_);
  ASSERT_EQ(standing.viewers.size(), 2u);
  EXPECT_EQ(standing.viewers[1].name, "Bob");
  EXPECT_EQ(standing.you, ada_.number);
  EXPECT_EQ(Holder(), 0u);
}

TEST_F(ViewerRegistryTest, OnlyTheHolderHasControl) {
  ASSERT_TRUE(registry_.RequestControl(ada_.key, now_));
  EXPECT_EQ(Holder(), ada_.number);
  EXPECT_TRUE(CheckControl(ada_.key));
  for (const std::string& other : {bob_.key, std::string(), std::string("no key")}) {
    const base::Status may = CheckControl(other);
    ASSERT_FALSE(may) << other;
    EXPECT_NE(may.error().message.find("Ada has control"), std::string::npos);
  }
  ASSERT_TRUE(registry_.Release(ada_.key, now_));
  EXPECT_TRUE(CheckControl(bob_.key));
}

TEST_F(ViewerRegistryTest, AHolderGrantsOrKeepsControl) {
  ASSERT_TRUE(registry_.RequestControl(ada_.key, now_));
  ASSERT_TRUE(registry_.RequestControl(bob_.key, now_));
  EXPECT_EQ(Bob().asks, 1u);
  EXPECT_FALSE(registry_.Answer(bob_.key, true, now_));
  ASSERT_TRUE(registry_.Answer(ada_.key, false, now_));
  EXPECT_EQ(Bob().asks, 0u);
  EXPECT_EQ(Holder(), ada_.number);
  ASSERT_TRUE(registry_.RequestControl(bob_.key, now_));
  ASSERT_TRUE(registry_.Answer(ada_.key, true, now_));
  EXPECT_EQ(Holder(), bob_.number);
  EXPECT_FALSE(registry_.Answer(bob_.key, true, now_));  // nobody requests control
}

TEST_F(ViewerRegistryTest, ControlPassesWhenTheHolderDoesNotAnswer) {
  ASSERT_TRUE(registry_.RequestControl(ada_.key, now_));
  ASSERT_TRUE(registry_.RequestControl(bob_.key, now_));
  WaitUntil(19);
  EXPECT_EQ(Holder(), ada_.number);
  EXPECT_EQ(Bob().left, seconds(1));
  WaitUntil(21);
  EXPECT_EQ(Holder(), bob_.number);
}

TEST_F(ViewerRegistryTest, ControlPassesWhenTheHolderLeavesOrIsSilent) {
  ASSERT_TRUE(registry_.RequestControl(ada_.key, now_));
  ASSERT_TRUE(registry_.RequestControl(bob_.key, now_));
  ASSERT_TRUE(registry_.Leave(ada_.key, now_));
  EXPECT_EQ(Holder(), bob_.number);
  EXPECT_FALSE(registry_.RequestControl(ada_.key, now_));
  now_ += seconds(9);  // Bob's machine is suspended, so it sends nothing
  EXPECT_TRUE(CheckControl(""));
  EXPECT_TRUE(registry_.List("", now_).viewers.empty());
  EXPECT_EQ(registry_.Rename(bob_.key, "Bob", now_).error().code, base::ErrorCode::kNotFound);
}

TEST_F(ViewerRegistryTest, EachSimulationHasItsOwnHolder) {
  ASSERT_TRUE(registry_.RequestControl(ada_.key, now_));
  ASSERT_TRUE(registry_.SelectSimulation(bob_.key, "other", now_));
  ASSERT_TRUE(registry_.RequestControl(bob_.key, now_));
  EXPECT_EQ(Holder("arena"), ada_.number);
  EXPECT_EQ(Holder("other"), bob_.number);
  EXPECT_TRUE(registry_.CheckControl(ada_.key, "arena", now_));
  EXPECT_FALSE(registry_.CheckControl(ada_.key, "other", now_));
  EXPECT_FALSE(registry_.CheckControl(bob_.key, "arena", now_));
  EXPECT_TRUE(registry_.CheckControl(bob_.key, "a third", now_));
}

TEST_F(ViewerRegistryTest, AHolderWhoSelectsAnotherSimulationReleasesControl) {
  ASSERT_TRUE(registry_.RequestControl(ada_.key, now_));
  ASSERT_TRUE(registry_.RequestControl(bob_.key, now_));
  // Ada already views this simulation, so she keeps control.
  ASSERT_TRUE(registry_.SelectSimulation(ada_.key, "arena", now_));
  EXPECT_EQ(Holder(), ada_.number);
  ASSERT_TRUE(registry_.SelectSimulation(ada_.key, "", now_));
  EXPECT_EQ(Holder(), bob_.number);
  EXPECT_EQ(registry_.RequestControl(ada_.key, now_).error().code, base::ErrorCode::kNotRunning);
}

TEST_F(ViewerRegistryTest, TheVersionIncreasesWithEachChange) {
  std::uint64_t version = registry_.Version(now_);
  const auto is_news = [&] {
    const std::uint64_t before = std::exchange(version, registry_.Version(now_));
    return version != before;
  };
  EXPECT_FALSE(is_news());
  ASSERT_TRUE(registry_.RequestControl(ada_.key, now_));
  EXPECT_TRUE(is_news());
  ASSERT_TRUE(registry_.RequestControl(ada_.key, now_));  // again
  EXPECT_FALSE(is_news());
  ASSERT_TRUE(registry_.Rename(bob_.key, "Robert", now_));
  EXPECT_TRUE(is_news());
  now_ += seconds(9);  // both viewers have sent nothing for too long
  EXPECT_TRUE(is_news());
  EXPECT_FALSE(is_news());
}

TEST_F(ViewerRegistryTest, NamesAreShortAndOnOneLine) {
  std::string name;
  for (int i = 0; i < 40; ++i) name += "ä";
  ASSERT_TRUE(registry_.Rename(ada_.key, name, now_));
  EXPECT_EQ(registry_.List("", now_).viewers[0].name, name.substr(0, 60));
  ASSERT_TRUE(registry_.Rename(ada_.key, "a\tb\x1b[2J<b>", now_));
  EXPECT_EQ(registry_.List("", now_).viewers[0].name, "a b [2J<b>");
  ASSERT_TRUE(registry_.Rename(ada_.key, " \n ", now_));
  EXPECT_EQ(registry_.List("", now_).viewers[0].name, "viewer 1");
}

TEST_F(ViewerRegistryTest, AtMostAThousandViewersAreKept) {
  for (std::size_t i = 2; i < ViewerRegistry::kMaxViewers; ++i)
    ASSERT_TRUE(registry_.Enter("", "arena", now_));
  EXPECT_EQ(registry_.Enter("", "arena", now_).error().code, base::ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace gsv::gateway::access
