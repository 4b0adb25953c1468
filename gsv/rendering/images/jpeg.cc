#include "gsv/rendering/images/jpeg.h"

#include <memory>

#include <turbojpeg.h>

namespace gsv::rendering {

base::Result<std::vector<std::uint8_t>> EncodeJpeg(const model::Image& image, int quality) {
  struct Close {
    void operator()(void* handle) const { tjDestroy(handle); }
  };
  // Each thread keeps one compressor, because creating one costs more than compressing a small
  // image.
  thread_local const std::unique_ptr<void, Close> compressor(tjInitCompress());
  const int format = image.channels == 4 ? TJPF_RGBA : TJPF_RGB;
  std::vector<std::uint8_t> jpeg(tjBufSize(image.width, image.height, TJSAMP_420));
  unsigned char* out = jpeg.data();
  unsigned long size = jpeg.size();
  if (image.width < 1 || image.height < 1 ||
      tjCompress2(compressor.get(), image.pixels.data(), image.width, 0, image.height, format, &out,
                  &size, TJSAMP_420, quality, TJFLAG_NOREALLOC) != 0) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "an image of " + std::to_string(image.width) + " by " +
                          std::to_string(image.height) + " pixels cannot be encoded as a JPEG");
  }
  jpeg.resize(size);
  return jpeg;
}

}  // namespace gsv::rendering
