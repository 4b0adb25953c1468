// Fuzz test: decodes the input as an image. The decoder must refuse it, or return as many pixels as
// the image's size requires.
#include <cstdint>

#include "gsv/base/check.h"
#include "gsv/formats/images/texture_reader.h"

using namespace gsv;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  formats::ReadLimits limits;
  limits.texture_side = 1024;
  const auto image = formats::DecodeImage(data, size, "input", limits);
  if (!image) {
    GSV_CHECK(!image.error().message.empty());
    return 0;
  }
  const model::Image& decoded = **image;
  GSV_CHECK(decoded.width > 0 && decoded.width <= limits.texture_side);
  GSV_CHECK(decoded.height > 0 && decoded.height <= limits.texture_side);
  GSV_CHECK(decoded.channels == 3 || decoded.channels == 4);
  GSV_CHECK(decoded.pixels.size() == static_cast<std::size_t>(decoded.width) *
                                         static_cast<std::size_t>(decoded.height) *
                                         static_cast<std::size_t>(decoded.channels));
  return 0;
}
