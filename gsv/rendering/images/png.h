// Pictures as PNG (ISO/IEC 15948): every byte comes back.
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/image.h"

namespace gsv::rendering {

// kInvalidArgument for a picture without pixels.
base::Result<std::vector<std::uint8_t>> EncodePng(const model::Image& image);

}  // namespace gsv::rendering
