// For tests: sets each field of a message, in order, to the next value n of a simple
// series.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

namespace gsv::messages {

class SampleFiller {
 public:
  explicit SampleFiller(std::uint32_t seed) : next_(seed) {}

  // A sequence gets n mod 4 elements.
  std::size_t Count() { return next_++ % 4; }
  // A flag is true if n is odd.
  void Value(bool& value) { value = next_++ % 2 == 1; }
  // A string gets n mod 7 times "x".
  void Value(std::string& value) { value.assign(next_++ % 7, 'x'); }
  // Integers are n mod 100, and negative if the type allows that and n is odd. Other numbers are n
  // + 0.5.
  template <typename Number>
  void Value(Number& value) {
    const std::uint32_t n = next_++;
    if constexpr (std::is_floating_point_v<Number>) {
      value = static_cast<Number>(n) + Number(0.5);
    } else {
      const auto size = static_cast<Number>(n % 100);
      value = std::is_signed_v<Number> && n % 2 == 1 ? static_cast<Number>(-size) : size;
    }
  }

 private:
  std::uint32_t next_;  // the number from which the next value is made
};

}  // namespace gsv::messages
