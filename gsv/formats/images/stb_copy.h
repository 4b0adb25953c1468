// The memcpy of stb's code. For a PNG's empty chunk, stb copies zero bytes to a null pointer, which
// is undefined for memcpy. Sources that compile stb include this after <cstring> and before stb's
// files.
#pragma once

#include <cstddef>
#include <cstring>

namespace gsv::formats {

inline void* CopyBytes(void* to, const void* from, std::size_t bytes) {
  return bytes == 0 ? to : std::memcpy(to, from, bytes);
}

}  // namespace gsv::formats
