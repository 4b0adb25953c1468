#pragma once

#include <cstddef>

namespace gsv::rendering {

// What is kept of models.
struct DrawCopies {
  std::size_t meshes = 0;
  std::size_t textures = 0;
  std::size_t layouts = 0;
};

}  // namespace gsv::rendering
