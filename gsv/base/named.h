// Constant tables of named values: a function searches an array, which needs no construction and,
// unlike a std::map, little time of the compiler.
//
//   constexpr base::Named<int> kSizes[] = {{"int8", 1}, {"int16", 2}};
//   if (const int* size = base::FindNamed(kSizes, name)) ...
#pragma once

#include <cstddef>
#include <string_view>

namespace gsv::base {

template <typename T>
struct Named {
  std::string_view name;
  T value;
};

// Returns the value of the first entry with this name, or null. Compares the names one by one.
template <typename T, std::size_t N>
constexpr const T* FindNamed(const Named<T> (&table)[N], std::string_view name) {
  for (const Named<T>& each : table) {
    if (each.name == name) return &each.value;
  }
  return nullptr;
}

}  // namespace gsv::base
