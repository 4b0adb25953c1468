// What stb's code is given for memcpy: a PNG's empty chunk has it copy nothing to nowhere, which
// memcpy leaves undefined. Included after <cstring> and before stb's files, by those that compile
// them.
#pragma once

#include <cstddef>
#include <cstring>

namespace gsv::formats {

inline void* CopyIfAny(void* to, const void* from, std::size_t bytes) {
  return bytes == 0 ? to : std::memcpy(to, from, bytes);
}

}  // namespace gsv::formats
