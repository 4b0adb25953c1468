#include "gsv/broker/offers/number_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace gsv::broker {
namespace {

struct Keyed {
  std::uint64_t key;
  std::uint32_t index;
};

constexpr int kDigitBits = 11;
constexpr int kDigits = 6;  // digits of a key; together they have 66 bits, and a key has 64
constexpr std::size_t kDigitValues = std::size_t{1} << kDigitBits;

std::size_t Digit(std::uint64_t key, int digit) {
  return (key >> (kDigitBits * digit)) % kDigitValues;
}

// Returns a sort key that increases with the number. +0 and -0 have the same key, and NaN has the
// largest.
std::uint64_t KeyOf(double number) {
  if (std::isnan(number)) return std::numeric_limits<std::uint64_t>::max();
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
  const auto bits = std::bit_cast<std::uint64_t>(number + 0.0);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

// Sorts by the digits of the key, beginning with the last digit (radix sort).
void SortByKey(std::vector<Keyed>& entries) {
  std::array<std::vector<std::uint32_t>, kDigits> places;
  for (auto& place : places) place.resize(kDigitValues);
  for (const Keyed& entry : entries) {
    for (int digit = 0; digit < kDigits; ++digit) {
      ++places[static_cast<std::size_t>(digit)][Digit(entry.key, digit)];
    }
  }
  std::vector<Keyed> sorted(entries.size());
  for (int digit = 0; digit < kDigits; ++digit) {
    auto& place = places[static_cast<std::size_t>(digit)];
    if (place[Digit(entries.front().key, digit)] == entries.size()) continue;
    std::uint32_t next = 0;
    for (std::uint32_t& count : place) next += std::exchange(count, next);
    for (const Keyed& entry : entries) sorted[place[Digit(entry.key, digit)]++] = entry;
    entries.swap(sorted);
  }
}

bool HasSmallerKey(const Keyed& a, const Keyed& b) { return a.key < b.key; }

// Sorts by key. Entries with equal keys keep their order.
void Sort(std::vector<Keyed>& entries) {
  constexpr std::size_t kFew = 512;
  if (entries.size() < kFew) {
    std::stable_sort(entries.begin(), entries.end(), HasSmallerKey);
  } else {
    SortByKey(entries);
  }
}

std::vector<std::uint32_t> IndicesOf(const std::vector<Keyed>& entries) {
  std::vector<std::uint32_t> indices;
  indices.reserve(entries.size());
  for (const Keyed& entry : entries) indices.push_back(entry.index);
  return indices;
}

}  // namespace

std::vector<std::uint32_t> AscendingOrder(std::span<const double> numbers) {
  std::vector<Keyed> entries;
  entries.reserve(numbers.size());
  for (const double number : numbers) {
    entries.push_back({KeyOf(number), static_cast<std::uint32_t>(entries.size())});
  }
  Sort(entries);
  return IndicesOf(entries);
}

std::vector<std::uint32_t> AscendingOrder(std::span<const double> numbers, std::size_t count) {
  // If more than 1/kMaxPart of the numbers are needed, sorting all numbers is as fast.
  constexpr std::size_t kMaxPart = 8;
  if (count > numbers.size() / kMaxPart) {
    std::vector<std::uint32_t> order = AscendingOrder(numbers);
    order.resize(std::min(count, order.size()));
    return order;
  }
  if (count == 0) return {};
  // Collects the numbers that may be among the first `count`. When there are twice as many as
  // needed, the larger half is removed. Then the largest remaining key is a bound for all later
  // numbers.
  const auto is_before = [](const Keyed& a, const Keyed& b) {
    return a.key != b.key ? a.key < b.key : a.index < b.index;
  };
  std::vector<Keyed> first;
  first.reserve(2 * count);
  const auto remove_larger = [&] {
    const auto end = first.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(first.begin(), end - 1, first.end(), is_before);
    first.erase(end, first.end());
    return first.back().key;
  };
  std::uint64_t bound = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::uint64_t key = KeyOf(numbers[i]);
    // `first` has at least `count` numbers whose keys are at most `bound`. Equal keys keep their
    // order, so a later number with the key `bound` or a larger key is not among the first `count`.
    if (key >= bound && first.size() >= count) continue;
    first.push_back({key, static_cast<std::uint32_t>(i)});
    if (first.size() == 2 * count) bound = remove_larger();
  }
  remove_larger();
  std::sort(first.begin(), first.end(), is_before);
  return IndicesOf(first);
}

std::vector<std::uint32_t> AscendingOrder(const std::vector<long double>& numbers) {
  std::vector<Keyed> entries;
  entries.reserve(numbers.size());
  bool exact = true;
  for (const long double number : numbers) {
    const auto rounded = static_cast<double>(number);
    exact = exact && (static_cast<long double>(rounded) == number || std::isnan(rounded));
    entries.push_back({KeyOf(rounded), static_cast<std::uint32_t>(entries.size())});
  }
  Sort(entries);
  // Rounding to double keeps the order, but may make different numbers equal. Runs of equal numbers
  // are sorted again by their exact values.
  for (auto run = entries.begin(); !exact && run != entries.end();) {
    const auto end = std::upper_bound(run, entries.end(), *run, HasSmallerKey);
    std::stable_sort(run, end, [&](const Keyed& a, const Keyed& b) {
      return numbers[a.index] < numbers[b.index];
    });
    run = end;
  }
  return IndicesOf(entries);
}

}  // namespace gsv::broker
