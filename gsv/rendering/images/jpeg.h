// Encodes images as JPEG (ITU-T T.81, baseline).
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/image.h"

namespace gsv::rendering {

// `quality` is from 1 to 100. The alpha channel is dropped. Returns kInvalidArgument for an image
// without pixels.
base::Result<std::vector<std::uint8_t>> EncodeJpeg(const model::Image& image, int quality);

}  // namespace gsv::rendering
