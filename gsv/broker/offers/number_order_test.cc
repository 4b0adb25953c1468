#include "gsv/broker/offers/number_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace gsv::broker {
namespace {

using LongNumbers = std::vector<long double>;
using Order = std::vector<std::uint32_t>;

constexpr long double kInfinity = std::numeric_limits<long double>::infinity();
constexpr long double kNone = std::numeric_limits<long double>::quiet_NaN();

TEST(NumberOrder, EqualNumbersKeepTheirOrderAndNanComesLast) {
  EXPECT_EQ(AscendingOrder(LongNumbers()), Order());
  EXPECT_EQ(AscendingOrder({2, kNone, -1, 2, kInfinity, -kInfinity, kNone, 0}),
            (Order{5, 2, 7, 0, 3, 4, 1, 6}));
  EXPECT_EQ(AscendingOrder({0.0L, -0.0L, 0.0L}), (Order{0, 1, 2}));
}

TEST(NumberOrder, DistinguishesIntegersThatAreEqualAsDoubles) {
  const long double large = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(AscendingOrder({large, large - 2, large - 1, large - 2, 1}), (Order{4, 1, 3, 2, 0}));
}

TEST(NumberOrder, FirstNumbersAreThoseOfTheWholeOrder) {
  std::mt19937_64 random(3);
  for (const std::size_t size : {0u, 1u, 9u, 100u, 3000u}) {
    for (const unsigned values : {2u, 50u, 1u << 30}) {  // few values make many numbers equal
      std::vector<double> numbers(size);
      for (double& number : numbers) {
        const auto value = static_cast<double>(random() % values);
        number = random() % 20 == 0 ? static_cast<double>(kNone) : value - values / 2.0;
      }
      const Order all = AscendingOrder(std::span<const double>(numbers));
      for (const std::size_t count : {0u, 1u, 3u, 10u, 370u, 5000u}) {
        const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(count, size));
        EXPECT_EQ(AscendingOrder(numbers, count), Order(all.begin(), end)) << size << " " << count;
      }
    }
  }
}

// The expected order is that of the standard library's sort.
TEST(NumberOrder, EqualsStandardSortForManyNumbers) {
  std::mt19937_64 random(7);
  for (const bool large : {false, true}) {
    LongNumbers numbers;
    for (int i = 0; i < 5000; ++i) {
      const auto integer = static_cast<std::int64_t>(random());
      if (i % 50 == 0) {
        numbers.push_back(kNone);
      } else if (i % 3 == 0) {
        numbers.push_back(static_cast<long double>(integer % 100) / 8);
      } else {
        numbers.push_back(
            large ? static_cast<long double>(integer)
                  : static_cast<long double>(std::ldexp(static_cast<double>(integer), -(i % 200))));
      }
    }
    Order expected(numbers.size());
    std::iota(expected.begin(), expected.end(), 0);
    std::stable_sort(expected.begin(), expected.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (std::isnan(numbers[a]) || std::isnan(numbers[b]))
        return std::isnan(numbers[b]) && !std::isnan(numbers[a]);
      return numbers[a] < numbers[b];
    });
    EXPECT_EQ(AscendingOrder(numbers), expected);
    if (large) continue;  // these numbers are no doubles
    const std::vector<double> doubles(numbers.begin(), numbers.end());
    EXPECT_EQ(AscendingOrder(std::span<const double>(doubles)), expected);
  }
}

}  // namespace
}  // namespace gsv::broker
