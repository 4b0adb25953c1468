// Gives each field of a message, in order, the next value of a simple series, for tests. The same
// rule stands in interop_test.mjs: it is what both sides agree on without sharing code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

namespace gsv::messages {

class SampleFiller {
 public:
  explicit SampleFiller(std::uint32_t seed) : next_(seed) {}

  // n mod 4 elements.
  std::size_t Count() { return next_++ % 4; }
  // n odd.
  void Value(bool& value) { value = next_++ % 2 == 1; }
  // n times "x", at most six.
  void Value(std::string& value) { value.assign(next_++ % 7, 'x'); }
  // Whole numbers: n mod 100, negative where that can be and n is odd. Others: n + 0.5.
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
  std::uint32_t next_;
};

}  // namespace gsv::messages
