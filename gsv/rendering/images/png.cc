#include "gsv/rendering/images/png.h"

#include <png.h>

namespace gsv::rendering {

base::Result<std::vector<std::uint8_t>> EncodePng(const model::Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = image.channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  png.flags = PNG_IMAGE_FLAG_FAST;
  std::vector<std::uint8_t> bytes;
  png_alloc_size_t size = image.width < 1 || image.height < 1 ? 0 : PNG_IMAGE_PNG_SIZE_MAX(png);
  bytes.resize(size);
  if (size == 0 || png_image_write_to_memory(&png, bytes.data(), &size, 0, image.pixels.data(), 0,
                                             nullptr) == 0) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a picture of " + std::to_string(image.width) + " by " +
                          std::to_string(image.height) + " pixels cannot become a PNG");
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace gsv::rendering
