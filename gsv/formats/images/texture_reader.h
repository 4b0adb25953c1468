// A TextureReader reads images (PNG, JPEG, TGA, BMP, TIFF). It reads each file once and shares the
// result. An image with sides beyond the limit is scaled down; a TIFF image beyond it is refused.
//
// Errors   an error for a file that is missing, larger than the limits, or not an image. The number
//          of pixels that a file declares is checked before memory is allocated. An image that must
//          be scaled down may have at most 2^27 pixels.
// Threads  one thread at a time.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "gsv/base/error.h"
#include "gsv/formats/files/read_limits.h"
#include "gsv/model/image.h"

namespace gsv::formats {

// Decodes an image file. `source` is its name for messages. The result has 3 channels if no pixel
// is transparent.
base::Result<std::shared_ptr<const model::Image>> DecodeImage(const unsigned char* bytes,
                                                              std::size_t size,
                                                              const std::string& source,
                                                              const ReadLimits& limits);

// Reads image files, each once.
class TextureReader {
 public:
  explicit TextureReader(const ReadLimits& limits) : limits_(limits) {}
  // Reads an image file.
  base::Result<std::shared_ptr<const model::Image>> Read(const std::filesystem::path& path);

  // Combines two grey images into a metallic-roughness map of glTF: `roughness` becomes the green
  // channel and `metalness` becomes the blue channel. Either image may be null.
  std::shared_ptr<const model::Image> Combine(const std::shared_ptr<const model::Image>& roughness,
                                              const std::shared_ptr<const model::Image>& metalness);

  // Returns the image with 3 channels, for a material that ignores its alpha.
  std::shared_ptr<const model::Image> Opaque(const std::shared_ptr<const model::Image>& image);

 private:
  ReadLimits limits_;
  // The results of Read(), Combine() and Opaque(), by their arguments.
  std::map<std::filesystem::path, std::shared_ptr<const model::Image>> images_;
  std::map<std::pair<const void*, const void*>, std::shared_ptr<const model::Image>> combined_;
  std::map<std::shared_ptr<const model::Image>, std::shared_ptr<const model::Image>> opaque_;
};

}  // namespace gsv::formats
