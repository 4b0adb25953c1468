// Any bytes as a picture: refused, or as many pixels as it says.
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
  const model::Image& picture = **image;
  GSV_CHECK(picture.width > 0 && picture.width <= limits.texture_side);
  GSV_CHECK(picture.height > 0 && picture.height <= limits.texture_side);
  GSV_CHECK(picture.channels == 3 || picture.channels == 4);
  GSV_CHECK(picture.pixels.size() == static_cast<std::size_t>(picture.width) *
                                         static_cast<std::size_t>(picture.height) *
                                         static_cast<std::size_t>(picture.channels));
  return 0;
}
