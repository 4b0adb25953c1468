#include "gsv/broker/offers/offer_column.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace gsv::broker {
namespace {

OfferPtr Numbered(std::uint64_t number, const char* type = "T") {
  return std::make_shared<const Offer>(Offer{.number = number, .type = std::string(type)});
}

std::vector<std::uint64_t> Numbers(const OfferView& view) {
  std::vector<std::uint64_t> numbers;
  for (const auto& chunk : view.chunks()) {
    EXPECT_LE(chunk->offers().size(), OfferColumn::kChunk);
    for (const OfferPtr& offer : chunk->offers()) numbers.push_back(offer->number);
  }
  return numbers;
}

using Sequence = std::vector<std::uint64_t>;

TEST(OfferColumn, KeepsOffersInTheOrderOfTheirNumbers) {
  OfferColumn column;
  for (const std::uint64_t number : {3, 1, 7, 2}) column.Put(Numbered(number));
  EXPECT_EQ(Numbers(column.View()), (Sequence{1, 2, 3, 7}));
  column.Remove(3);
  EXPECT_EQ(Numbers(column.View()), (Sequence{1, 2, 7}));
  column.Put(Numbered(3));
  EXPECT_EQ(Numbers(column.View()), (Sequence{1, 2, 3, 7}));
  EXPECT_EQ(column.size(), 4u);
}

TEST(OfferColumn, ViewStaysUnchangedWhenTheColumnChanges) {
  OfferColumn column;
  column.Put(Numbered(1, "before"));
  column.Put(Numbered(2));
  const OfferView before = column.View();
  column.Put(Numbered(1, "after"));
  column.Remove(2);
  column.Put(Numbered(3));
  EXPECT_EQ(Numbers(before), (Sequence{1, 2}));
  EXPECT_EQ(*before.chunks()[0]->offers()[0]->type, "before");
  EXPECT_EQ(Numbers(column.View()), (Sequence{1, 3}));
  EXPECT_EQ(*column.View().chunks()[0]->offers()[0]->type, "after");
}

// The expected order is that of a sorted list.
TEST(OfferColumn, StaysSortedAfterManyAdditionsAndRemovals) {
  std::mt19937 random(3);
  OfferColumn column;
  std::set<std::uint64_t> expected;
  const auto check = [&] {
    EXPECT_EQ(Numbers(column.View()), Sequence(expected.begin(), expected.end()));
    EXPECT_EQ(column.size(), expected.size());
  };
  const auto put = [&](std::uint64_t number) {
    column.Put(Numbered(number));
    expected.insert(number);
  };
  for (std::uint64_t number = 1; number <= 5000; ++number) put(2 * number);
  check();
  EXPECT_LE(column.View().chunks().size(), 6u);
  for (int i = 0; i < 4000; ++i) put(1 + random() % 10'000);
  check();
  while (expected.size() > 10) {
    auto gone = expected.lower_bound(random() % 10'000);
    if (gone == expected.end()) gone = expected.begin();
    column.Remove(*gone);
    expected.erase(gone);
    if (expected.size() % 500 == 0) check();
  }
  check();
  EXPECT_LE(column.View().chunks().size(), 3u);
  while (!expected.empty()) {
    column.Remove(*expected.begin());
    expected.erase(expected.begin());
  }
  EXPECT_TRUE(column.View().chunks().empty());
  put(7);
  check();
}

// The property columns of other chunks are kept.
TEST(OfferColumn, ChangeAffectsOneChunk) {
  OfferColumn column;
  for (std::uint64_t number = 1; number <= 3000; ++number) column.Put(Numbered(number));
  const OfferView before = column.View();
  column.Put(Numbered(1500, "changed"));
  const OfferView after = column.View();
  EXPECT_EQ(before.chunks()[0], after.chunks()[0]);
  EXPECT_NE(before.chunks()[1], after.chunks()[1]);
  EXPECT_EQ(before.chunks()[2], after.chunks()[2]);
}

}  // namespace
}  // namespace gsv::broker
