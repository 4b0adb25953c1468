// Encodes images as PNG (ISO/IEC 15948), lossless.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/image.h"

namespace gsv::rendering {

// Returns kInvalidArgument for an image without pixels.
base::Result<std::vector<std::uint8_t>> EncodePng(const model::Image& image);

// Encodes one 16-bit grey value per pixel. Rows are given from the top.
base::Result<std::vector<std::uint8_t>> EncodeGreyPng(int width, int height,
                                                      std::span<const std::uint16_t> pixels);

}  // namespace gsv::rendering
