// An image in memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gsv::model {

// Rows are from top to bottom, pixels from left to right. A pixel has `channels` bytes (3: RGB, 4:
// RGBA), sRGB-encoded. pixels.size() == width * height * channels.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 3;
  std::vector<std::uint8_t> pixels;
  std::string source;  // the file of the image, named in error messages
};

}  // namespace gsv::model
