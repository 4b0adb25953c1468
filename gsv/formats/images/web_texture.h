// Encodes images as files that a browser can read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gsv/model/image.h"

namespace gsv::formats {

// An image file that a browser can read.
struct WebTexture {
  std::string mime_type;  // "image/png" or "image/jpeg"; empty: the image cannot be encoded
  std::vector<std::uint8_t> bytes;
};

// Returns the image's original file if `original_allowed`, if it is a PNG or JPEG of the same size
// with at most 16 MiB, and if no side exceeds `max_side`. Otherwise encodes a JPEG, or a PNG if the
// image has an alpha channel, scaled down to `max_side`.
WebTexture EncodeForWeb(const model::Image& image, bool original_allowed, int max_side = 1024);

}  // namespace gsv::formats
