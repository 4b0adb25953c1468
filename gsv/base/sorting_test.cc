#include "gsv/base/sorting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace gsv::base {
namespace {

struct Numbered {
  std::string key;
  int number = 0;
  bool operator==(const Numbered&) const = default;
};

bool HasSmallerKey(const Numbered& a, const Numbered& b) { return a.key < b.key; }

TEST(Sorting, EqualsTheStableSortOfTheStandardLibrary) {
  std::mt19937 random(7);
  for (std::size_t count = 0; count < 300; ++count) {
    std::vector<Numbered> values;
    for (std::size_t i = 0; i < count; ++i) {
      // few different keys, some of which are too long to be stored in the string itself
      values.push_back({std::string(random() % 20, 'a'), static_cast<int>(i)});
    }
    std::vector<Numbered> expected = values;
    std::stable_sort(expected.begin(), expected.end(), HasSmallerKey);
    Sort(values, HasSmallerKey);
    EXPECT_EQ(values, expected);
  }
}

TEST(Sorting, UsesLessIfNoOrderIsGiven) {
  std::vector<std::string> names{"office", "maze", "hall"};
  Sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"hall", "maze", "office"}));
}

TEST(Sorting, MovesElementsThatCannotBeCopied) {
  std::vector<std::unique_ptr<int>> values;
  for (const int value : {3, 1, 2}) values.push_back(std::make_unique<int>(value));
  const int* three = values.front().get();
  Sort(values, [](const auto& a, const auto& b) { return *a < *b; });
  EXPECT_EQ(*values[0], 1);
  EXPECT_EQ(*values[1], 2);
  EXPECT_EQ(values[2].get(), three);
}

TEST(Sorting, SortsAPartOfAContainer) {
  std::vector<int> values{9, 3, 1, 2};
  Sort(std::span(values).subspan(1));
  EXPECT_EQ(values, (std::vector<int>{9, 1, 2, 3}));
}

TEST(Sorting, PassesTheCapturesOfTheOrder) {
  const std::vector<int> rank{2, 0, 1};
  std::vector<int> values{0, 1, 2};
  Sort(values, [&](int a, int b) { return rank[a] < rank[b]; });
  EXPECT_EQ(values, (std::vector<int>{1, 2, 0}));
}

}  // namespace
}  // namespace gsv::base
