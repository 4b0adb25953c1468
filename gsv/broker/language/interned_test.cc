#include "gsv/broker/language/interned.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace gsv::broker {
namespace {

using Text = Interned<std::string>;

TEST(Interned, StoresEqualValuesOnce) {
  const std::size_t before = Text::Count();
  const Text a(std::string("sonar"));
  const Text b(std::string("sonar"));
  EXPECT_EQ(a, b);
  EXPECT_EQ(&*a, &*b);
  EXPECT_EQ(*a, "sonar");
  EXPECT_EQ(Text::Count(), before + 1);
  EXPECT_FALSE(a == Text(std::string("lidar")));
}

TEST(Interned, DeletesAValueWithItsLastUser) {
  const std::size_t before = Text::Count();
  {
    Text a(std::string("sonar"));
    Text b = a;
    a = Text(std::string("lidar"));
    EXPECT_EQ(*b, "sonar");
    EXPECT_EQ(Text::Count(), before + 2);
    b = a;
    EXPECT_EQ(Text::Count(), before + 1);
  }
  EXPECT_EQ(Text::Count(), before);
}

TEST(Interned, IsADefaultValueAfterDefaultConstructionAndMove) {
  Text a(std::string("sonar"));
  const Text b = std::move(a);
  EXPECT_EQ(*b, "sonar");
  EXPECT_EQ(*a, "");  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(a, Text());
  EXPECT_EQ(a, Text(std::string()));
}

TEST(Interned, SurvivesThreadsThatCreateAndDeleteTheSameValue) {
  const std::size_t before = Text::Count();
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([] {
      for (int n = 0; n < 10000; ++n) {
        const Text a(std::string("a value that is longer than the buffer of a string"));
        const Text b = a;
        ASSERT_EQ(b->size(), 50U);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(Text::Count(), before);
}

}  // namespace
}  // namespace gsv::broker
