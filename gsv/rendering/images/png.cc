#include "gsv/rendering/images/png.h"

#include <png.h>

namespace gsv::rendering {
namespace {

using base::Result;
using Bytes = std::vector<std::uint8_t>;

Result<Bytes> Encode(int width, int height, png_uint_32 format, const void* pixels) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(width);
  png.height = static_cast<png_uint_32>(height);
  png.format = format;
  png.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = width < 1 || height < 1 ? 0 : PNG_IMAGE_PNG_SIZE_MAX(png);
  Bytes bytes(size);
  if (size == 0 ||
      png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels, 0, nullptr) == 0) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "an image of " + std::to_string(width) +
                                                             " by " + std::to_string(height) +
                                                             " pixels cannot be encoded as a PNG");
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace

Result<Bytes> EncodePng(const model::Image& image) {
  return Encode(image.width, image.height, image.channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB,
                image.pixels.data());
}

Result<Bytes> EncodeGreyPng(int width, int height, std::span<const std::uint16_t> pixels) {
  const bool is_whole = width > 0 && height > 0 &&
                        pixels.size() == static_cast<std::size_t>(width) * std::size_t(height);
  return Encode(is_whole ? width : 0, height, PNG_FORMAT_LINEAR_Y, pixels.data());
}

}  // namespace gsv::rendering
