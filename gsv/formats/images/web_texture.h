// Pictures as the files that a browser reads.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gsv/model/image.h"

namespace gsv::formats {

struct WebTexture {
  std::string mime_type;  // "image/png" or "image/jpeg"; empty: the picture cannot be used
  std::vector<std::uint8_t> bytes;
};

// The file that the picture came from, if `original_allowed` and it is a PNG or JPEG of its size
// and no side is above `most_side`; else JPEG, or PNG where something is see-through, scaled down
// to `most_side`.
WebTexture EncodeForWeb(const model::Image& image, bool original_allowed, int most_side = 1024);

}  // namespace gsv::formats
