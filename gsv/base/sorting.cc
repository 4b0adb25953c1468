#include "gsv/base/sorting.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace gsv::base::internal {

void Sort(void* values, std::size_t count, std::size_t size,
          bool (*is_before)(const void* context, const void* a, const void* b), const void* context,
          void (*swap)(void* a, void* b)) {
  if (count < 2) return;
  const auto at = [&](std::size_t i) { return static_cast<std::byte*>(values) + i * size; };
  // The element that belongs at index i is now at index from[i].
  std::vector<std::size_t> from(count);
  std::iota(from.begin(), from.end(), std::size_t{0});
  std::stable_sort(from.begin(), from.end(),
                   [&](std::size_t a, std::size_t b) { return is_before(context, at(a), at(b)); });
  // Follows each cycle of this permutation. A swap puts the right element at index `to`, and passes
  // on the element that was at index `start` before.
  for (std::size_t start = 0; start < count; ++start) {
    std::size_t to = start;
    while (from[to] != start) {
      const std::size_t next = from[to];
      swap(at(to), at(next));
      from[to] = to;
      to = next;
    }
    from[to] = to;
  }
}

}  // namespace gsv::base::internal
