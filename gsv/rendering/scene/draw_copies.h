#pragma once

#include <cstddef>

namespace gsv::rendering {

// The number of cached objects.
struct DrawCopies {
  std::size_t meshes = 0;
  std::size_t textures = 0;
  std::size_t layouts = 0;
};

}  // namespace gsv::rendering
