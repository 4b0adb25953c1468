#include "gsv/broker/trader/cursor_table.h"

#include <string>

#include <gtest/gtest.h>

namespace gsv::broker {
namespace {

using Table = CursorTable<std::vector<int>, std::string>;
using std::chrono::seconds;

class CursorTableTest : public testing::Test {
 protected:
  std::chrono::steady_clock::time_point now_{};
  Table table_{CursorLimits{.cursors = 2, .entries = 6, .lifetime = seconds(10)},
               [this] { return now_; }};

  static std::size_t TenBytes(const int&, const std::string&) { return 10; }
};

TEST_F(CursorTableTest, ReturnsEachEntryOnceInOrder) {
  const std::uint64_t key = table_.Open({1, 2, 3}, "context");
  EXPECT_EQ(table_.Left(key), 3u);
  const auto first = table_.Take(key, 2, 1000, TenBytes);
  EXPECT_EQ(first->entries, (std::vector<int>{1, 2}));
  EXPECT_EQ(first->context, "context");
  EXPECT_TRUE(first->more);
  const auto second = table_.Take(key, 2, 1000, TenBytes);
  EXPECT_EQ(second->entries, std::vector<int>{3});
  EXPECT_FALSE(second->more);
  EXPECT_EQ(table_.Left(key), 0u);
  EXPECT_TRUE(table_.Close(key));
  EXPECT_FALSE(table_.Close(key));
  EXPECT_FALSE(table_.Take(key, 1, 1000, TenBytes));
}

TEST_F(CursorTableTest, LimitsTheBytesOfABatchButReturnsAtLeastOneEntry) {
  const std::uint64_t key = table_.Open({1, 2, 3, 4}, "");
  EXPECT_EQ(table_.Take(key, 9, 25, TenBytes)->entries, (std::vector<int>{1, 2}));
  EXPECT_EQ(table_.Take(key, 9, 5, TenBytes)->entries, std::vector<int>{3});
  EXPECT_TRUE(table_.Take(key, 0, 5, TenBytes)->entries.empty());
}

TEST_F(CursorTableTest, RemovesUnusedCursors) {
  const std::uint64_t used = table_.Open({1}, "");
  const std::uint64_t unused = table_.Open({1}, "");
  now_ += seconds(10);
  EXPECT_TRUE(table_.Left(used));
  now_ += seconds(1);
  table_.Expire();
  EXPECT_EQ(table_.size(), 1u);
  EXPECT_TRUE(table_.Left(used));
  EXPECT_FALSE(table_.Left(unused));
}

TEST_F(CursorTableTest, RemovesTheLeastRecentlyUsedCursorIfItIsFull) {
  const std::uint64_t a = table_.Open({1}, "");
  now_ += seconds(1);
  const std::uint64_t b = table_.Open({1}, "");
  now_ += seconds(1);
  EXPECT_TRUE(table_.Left(a));
  table_.Open({1}, "");
  EXPECT_TRUE(table_.Left(a));
  EXPECT_FALSE(table_.Left(b));
}

TEST_F(CursorTableTest, LimitsTheNumberOfEntries) {
  const std::uint64_t a = table_.Open({1, 2, 3, 4}, "");
  table_.Open({1, 2, 3}, "");
  EXPECT_FALSE(table_.Left(a));
}

}  // namespace
}  // namespace gsv::broker
