// Pictures as PNG (ISO/IEC 15948): every byte comes back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/image.h"

namespace gsv::rendering {

// kInvalidArgument for a picture without pixels.
base::Result<std::vector<std::uint8_t>> EncodePng(const model::Image& image);

// One grey value of 16 bits a pixel, rows from the top.
base::Result<std::vector<std::uint8_t>> EncodeGreyPng(int width, int height,
                                                      std::span<const std::uint16_t> pixels);

}  // namespace gsv::rendering
