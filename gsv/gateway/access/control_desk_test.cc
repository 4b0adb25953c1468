#include "gsv/gateway/access/control_desk.h"

#include <gtest/gtest.h>

namespace gsv::gateway::access {
namespace {

using std::chrono::seconds;

// Two people at a desk whose clock is set by hand.
class ControlDeskTest : public ::testing::Test {
 protected:
  // Both keep asking how things stand until then.
  void WaitUntil(int second) {
    for (; now_ < start_ + seconds(second); now_ += seconds(1)) {
      desk_.See(ada_.key, now_);
      desk_.See(bob_.key, now_);
    }
  }
  std::uint64_t Holder() { return desk_.See(bob_.key, now_).holder; }

  const ControlDesk::Time start_{};
  ControlDesk::Time now_ = start_;
  ControlDesk desk_{{.absence = seconds(8), .answer = seconds(20)}};
  const ControlDesk::Admission ada_ = desk_.Enter("Ada", now_).value();
  const ControlDesk::Admission bob_ = desk_.Enter("  Bob\n", now_).value();
};

TEST_F(ControlDeskTest, WhileNobodyHoldsControlAllMayAct) {
  EXPECT_TRUE(desk_.MayAct(ada_.key, now_));
  EXPECT_TRUE(desk_.MayAct("", now_));
  const auto standing = desk_.See(ada_.key, now_);
  ASSERT_EQ(standing.viewers.size(), 2u);
  EXPECT_EQ(standing.viewers[1].name, "Bob");
  EXPECT_EQ(standing.you, ada_.number);
  EXPECT_EQ(standing.holder, 0u);
}

TEST_F(ControlDeskTest, WhoHoldsItActsAlone) {
  ASSERT_TRUE(desk_.Ask(ada_.key, now_));
  EXPECT_EQ(Holder(), ada_.number);
  EXPECT_TRUE(desk_.MayAct(ada_.key, now_));
  for (const std::string& other : {bob_.key, std::string(), std::string("no key")}) {
    const base::Status may = desk_.MayAct(other, now_);
    ASSERT_FALSE(may) << other;
    EXPECT_NE(may.error().message.find("Ada holds control"), std::string::npos);
  }
  ASSERT_TRUE(desk_.Release(ada_.key, now_));
  EXPECT_TRUE(desk_.MayAct(bob_.key, now_));
}

TEST_F(ControlDeskTest, AHolderGrantsOrKeepsIt) {
  ASSERT_TRUE(desk_.Ask(ada_.key, now_));
  ASSERT_TRUE(desk_.Ask(bob_.key, now_));
  EXPECT_EQ(desk_.See(ada_.key, now_).asking, std::vector{bob_.number});
  EXPECT_FALSE(desk_.Answer(bob_.key, true, now_));
  ASSERT_TRUE(desk_.Answer(ada_.key, false, now_));
  EXPECT_TRUE(desk_.See(ada_.key, now_).asking.empty());
  EXPECT_EQ(Holder(), ada_.number);
  ASSERT_TRUE(desk_.Ask(bob_.key, now_));
  ASSERT_TRUE(desk_.Answer(ada_.key, true, now_));
  EXPECT_EQ(Holder(), bob_.number);
  EXPECT_FALSE(desk_.Answer(bob_.key, true, now_));  // nobody asks
}

TEST_F(ControlDeskTest, ItPassesWhenTheHolderDoesNotAnswer) {
  ASSERT_TRUE(desk_.Ask(ada_.key, now_));
  ASSERT_TRUE(desk_.Ask(bob_.key, now_));
  WaitUntil(19);
  EXPECT_EQ(Holder(), ada_.number);
  EXPECT_EQ(desk_.See(bob_.key, now_).left, seconds(1));
  WaitUntil(21);
  EXPECT_EQ(Holder(), bob_.number);
}

TEST_F(ControlDeskTest, ItPassesWhenTheHolderLeavesOrIsSilent) {
  ASSERT_TRUE(desk_.Ask(ada_.key, now_));
  ASSERT_TRUE(desk_.Ask(bob_.key, now_));
  ASSERT_TRUE(desk_.Leave(ada_.key, now_));
  EXPECT_EQ(Holder(), bob_.number);
  EXPECT_FALSE(desk_.Ask(ada_.key, now_));
  now_ += seconds(9);  // Bob's machine sleeps
  EXPECT_TRUE(desk_.MayAct("", now_));
  EXPECT_TRUE(desk_.See("", now_).viewers.empty());
  EXPECT_EQ(desk_.Rename(bob_.key, "Bob", now_).error().code, base::ErrorCode::kNotFound);
}

TEST_F(ControlDeskTest, NamesAreShortAndOnOneLine) {
  std::string name;
  for (int i = 0; i < 40; ++i) name += "ä";
  ASSERT_TRUE(desk_.Rename(ada_.key, name, now_));
  EXPECT_EQ(desk_.See("", now_).viewers[0].name, name.substr(0, 60));
  ASSERT_TRUE(desk_.Rename(ada_.key, "a\tb\x1b[2J<b>", now_));
  EXPECT_EQ(desk_.See("", now_).viewers[0].name, "a b [2J<b>");
  ASSERT_TRUE(desk_.Rename(ada_.key, " \n ", now_));
  EXPECT_EQ(desk_.See("", now_).viewers[0].name, "viewer 1");
}

TEST_F(ControlDeskTest, NoMoreThanAThousandAreThere) {
  for (std::size_t i = 2; i < ControlDesk::kMostViewers; ++i) ASSERT_TRUE(desk_.Enter("", now_));
  EXPECT_EQ(desk_.Enter("", now_).error().code, base::ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace gsv::gateway::access
