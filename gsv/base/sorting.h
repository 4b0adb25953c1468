// Sorts small arrays with one compiled function for all types of elements.
//
// std::sort and std::stable_sort are compiled again for each type and each comparison, which takes
// the compiler 0.05 to 0.3 s. Use Sort() wherever the time to sort does not matter. Use std::sort
// in steps, sensors, images and messages.
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <type_traits>
#include <utility>

namespace gsv::base {
namespace internal {

// Sorts `count` elements of `size` bytes each, which begin at `values`. `is_before` gets `context`
// and two elements. `swap` exchanges two elements.
void Sort(void* values, std::size_t count, std::size_t size,
          bool (*is_before)(const void* context, const void* a, const void* b), const void* context,
          void (*swap)(void* a, void* b));

}  // namespace internal

// Sorts a contiguous container or a std::span, such that `is_before(a, b)` holds for no element `a`
// after an element `b`. `is_before` must be a strict weak ordering. Elements that are equal in this
// order keep their order (the sort is stable), so the result is the same with every standard
// library. Each comparison costs a call through a pointer. Elements are moved, not copied.
template <typename Values, typename IsBefore = std::less<>>
void Sort(Values&& values, IsBefore is_before = {}) {
  using T = std::remove_reference_t<decltype(*std::data(values))>;
  internal::Sort(
      std::data(values), std::size(values), sizeof(T),
      [](const void* context, const void* a, const void* b) -> bool {
        return (*static_cast<const IsBefore*>(context))(*static_cast<const T*>(a),
                                                        *static_cast<const T*>(b));
      },
      &is_before, [](void* a, void* b) { std::swap(*static_cast<T*>(a), *static_cast<T*>(b)); });
}

}  // namespace gsv::base
