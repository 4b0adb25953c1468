#include "gsv/broker/offer_column.h"

#include <gtest/gtest.h>

namespace gsv::broker {
namespace {

OfferPtr Numbered(std::uint64_t number, const char* type = "T") {
  return std::make_shared<const Offer>(Offer{.number = number, .type = type});
}

std::vector<std::uint64_t> Numbers(const OfferView& view) {
  std::vector<std::uint64_t> numbers;
  for (const OfferPtr& offer : view.offers()) {
    if (offer != nullptr) numbers.push_back(offer->number);
  }
  return numbers;
}

using Sequence = std::vector<std::uint64_t>;

TEST(OfferColumn, KeepsTheOrderOfNumbers) {
  OfferColumn column;
  for (const std::uint64_t number : {3, 1, 7, 2}) column.Put(Numbered(number));
  EXPECT_EQ(Numbers(column.View()), (Sequence{1, 2, 3, 7}));
  column.Remove(3);
  EXPECT_EQ(Numbers(column.View()), (Sequence{1, 2, 7}));
  column.Put(Numbered(3));
  EXPECT_EQ(Numbers(column.View()), (Sequence{1, 2, 3, 7}));
  EXPECT_EQ(column.size(), 4u);
}

TEST(OfferColumn, AViewStaysAsItWas) {
  OfferColumn column;
  column.Put(Numbered(1, "before"));
  column.Put(Numbered(2));
  const OfferView before = column.View();
  column.Put(Numbered(1, "after"));
  column.Remove(2);
  column.Put(Numbered(3));
  EXPECT_EQ(Numbers(before), (Sequence{1, 2}));
  EXPECT_EQ(before.offers()[0]->type, "before");
  EXPECT_EQ(Numbers(column.View()), (Sequence{1, 3}));
  EXPECT_EQ(column.View().offers()[0]->type, "after");
}

TEST(OfferColumn, LetsGoOfWhatWasRemoved) {
  OfferColumn column;
  for (std::uint64_t number = 1; number <= 1000; ++number) column.Put(Numbered(number));
  for (std::uint64_t number = 1; number <= 999; ++number) column.Remove(number);
  EXPECT_LE(column.View().offers().size(), 200u);
  EXPECT_EQ(Numbers(column.View()), Sequence{1000});
  EXPECT_EQ(column.size(), 1u);
}

}  // namespace
}  // namespace gsv::broker
