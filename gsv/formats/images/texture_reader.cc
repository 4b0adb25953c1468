#include "gsv/formats/images/texture_reader.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include <turbojpeg.h>

#include "gsv/formats/images/stb_copy.h"
#include "gsv/formats/images/tiff_reader.h"

// Libraries that the program links may contain stb_image, too. STB_IMAGE_STATIC makes the functions
// of this copy private to this source file.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_NO_JPEG
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_NO_PSD
#define STBI_NO_PIC
#define STBI_NO_PNM
#define STBI_NO_GIF
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wshadow"
#define memcpy gsv::formats::CopyBytes
#include <stb/stb_image.h>
#undef memcpy
#pragma GCC diagnostic pop

namespace gsv::formats {
namespace {

using base::ErrorCode;
using model::Image;

bool HasTransparentPixel(const unsigned char* rgba, std::size_t pixels) {
  for (std::size_t i = 0; i < pixels; ++i) {
    if (rgba[4 * i + 3] != 255) return true;
  }
  return false;
}

std::vector<std::uint8_t> WithoutAlpha(const unsigned char* rgba, std::size_t pixels) {
  std::vector<std::uint8_t> rgb(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = rgba[4 * i + c];
  }
  return rgb;
}

bool IsJpeg(const unsigned char* bytes, std::size_t size) {
  return size > 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

// An image with a side beyond the limit is decoded if it has at most this number of pixels, and is
// then scaled down.
constexpr std::int64_t kMaxPixelsBeforeScaling = 128 << 20;

// Fails for an image without pixels. Also fails for an image that has a side beyond the limit and
// more than kMaxPixelsBeforeScaling pixels.
base::Status CheckSize(int width, int height, const std::string& source, const ReadLimits& limits) {
  const bool is_small = width <= limits.texture_side && height <= limits.texture_side;
  const std::int64_t pixels = static_cast<std::int64_t>(width) * height;
  const bool is_empty = width <= 0 || height <= 0;
  if (!is_empty && (is_small || pixels <= kMaxPixelsBeforeScaling)) return {};
  const std::string declared =
      "the image declares " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (is_empty) return Fail(ErrorCode::kBadModel, declared + "; it must have one or more", source);
  return Fail(ErrorCode::kBadModel,
              declared + "; the limit for an image with a side above " +
                  std::to_string(limits.texture_side) + " is " +
                  std::to_string(kMaxPixelsBeforeScaling) + " pixels in all",
              source);
}

// Each pixel becomes the mean of a square of pixels, such that no side exceeds the limit.
std::shared_ptr<Image> ScaledDown(std::shared_ptr<Image> image, const ReadLimits& limits) {
  const int longest = std::max(image->width, image->height);
  if (longest <= limits.texture_side) return image;
  const int square = (longest + limits.texture_side - 1) / limits.texture_side;
  auto small = std::make_shared<Image>(Image{std::max(image->width / square, 1),
                                             std::max(image->height / square, 1),
                                             image->channels,
                                             {},
                                             image->source});
  for (int y = 0; y < small->height; ++y) {
    for (int x = 0; x < small->width; ++x) {
      for (int channel = 0; channel < image->channels; ++channel) {
        unsigned sum = 0, count = 0;
        for (int row = y * square; row < std::min((y + 1) * square, image->height); ++row) {
          for (int column = x * square; column < std::min((x + 1) * square, image->width);
               ++column) {
            sum += image->pixels[(static_cast<std::size_t>(row) *
                                      static_cast<std::size_t>(image->width) +
                                  static_cast<std::size_t>(column)) *
                                     static_cast<std::size_t>(image->channels) +
                                 static_cast<std::size_t>(channel)];
            ++count;
          }
        }
        small->pixels.push_back(static_cast<std::uint8_t>((sum + count / 2) / count));
      }
    }
  }
  return small;
}

base::Result<std::shared_ptr<const Image>> DecodeJpeg(const unsigned char* bytes, std::size_t size,
                                                      const std::string& source,
                                                      const ReadLimits& limits) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(decoder.get(), bytes, size, &width, &height, &subsampling, &colours) !=
      0) {
    return Fail(ErrorCode::kBadModel,
                std::string("the image is damaged: ") + tjGetErrorStr2(decoder.get()), source);
  }
  if (auto status = CheckSize(width, height, source, limits); !status) return Fail(status.error());
  auto image = std::make_shared<Image>(Image{width, height, 3, {}, source});
  image->pixels.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const int failed = tjDecompress2(decoder.get(), bytes, size, image->pixels.data(), width, 0,
                                   height, TJPF_RGB, TJFLAG_LIMITSCANS);
  // After a warning, for example about a truncated file, the image is still valid.
  if (failed != 0 && tjGetErrorCode(decoder.get()) != TJERR_WARNING) {
    return Fail(ErrorCode::kBadModel,
                std::string("the image is damaged: ") + tjGetErrorStr2(decoder.get()), source);
  }
  return ScaledDown(std::move(image), limits);
}

base::Result<std::shared_ptr<const Image>> DecodeOther(const unsigned char* bytes, std::size_t size,
                                                       const std::string& source,
                                                       const ReadLimits& limits) {
  int width = 0, height = 0, channels = 0;
  const int length = static_cast<int>(size);
  if (stbi_info_from_memory(bytes, length, &width, &height, &channels) == 0) {
    return Fail(ErrorCode::kBadModel, "this is not a PNG, JPEG, TGA, BMP or TIFF image", source);
  }
  if (auto status = CheckSize(width, height, source, limits); !status) return Fail(status.error());
  const int wanted = channels == 4 || channels == 2 ? 4 : 3;
  const std::unique_ptr<unsigned char, void (*)(void*)> decoded(
      stbi_load_from_memory(bytes, length, &width, &height, &channels, wanted), stbi_image_free);
  if (decoded == nullptr) {
    return Fail(ErrorCode::kBadModel, std::string("the image is damaged: ") + stbi_failure_reason(),
                source);
  }
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  auto image = std::make_shared<Image>(Image{width, height, wanted, {}, source});
  if (wanted == 4 && !HasTransparentPixel(decoded.get(), pixels)) {
    image->channels = 3;
    image->pixels = WithoutAlpha(decoded.get(), pixels);
  } else {
    image->pixels.assign(decoded.get(), decoded.get() + pixels * static_cast<std::size_t>(wanted));
  }
  return ScaledDown(std::move(image), limits);
}

}  // namespace

base::Result<std::shared_ptr<const Image>> DecodeImage(const unsigned char* bytes, std::size_t size,
                                                       const std::string& source,
                                                       const ReadLimits& limits) {
  if (size > limits.texture_bytes || size > 0x7fffffff) {
    return Fail(
        ErrorCode::kBadModel,
        "the image is larger than the limit of " + std::to_string(limits.texture_bytes) + " bytes",
        source);
  }
  if (IsTiff(bytes, size)) {
    auto image = DecodeTiff(bytes, size, source, limits);
    if (!image) return Fail(image.error());
    return ScaledDown(*std::move(image), limits);
  }
  return IsJpeg(bytes, size) ? DecodeJpeg(bytes, size, source, limits)
                             : DecodeOther(bytes, size, source, limits);
}

base::Result<std::shared_ptr<const Image>> TextureReader::Read(const std::filesystem::path& path) {
  if (const auto it = images_.find(path); it != images_.end()) return it->second;
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) return Fail(ErrorCode::kNotFound, "the image cannot be read", path.string());
  if (size > limits_.texture_bytes) {
    return Fail(
        ErrorCode::kBadModel,
        "the image is larger than the limit of " + std::to_string(limits_.texture_bytes) + " bytes",
        path.string());
  }
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file),
                                std::istreambuf_iterator<char>()};
  auto image = DecodeImage(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                           path.string(), limits_);
  if (image) images_[path] = *image;
  return image;
}

std::shared_ptr<const Image> TextureReader::Opaque(const std::shared_ptr<const Image>& image) {
  if (image == nullptr || image->channels != 4) return image;
  auto& opaque = opaque_[image];
  if (opaque != nullptr) return opaque;
  auto copy = std::make_shared<Image>(Image{image->width, image->height, 3, {}, image->source});
  copy->pixels = WithoutAlpha(image->pixels.data(), image->pixels.size() / 4);
  return opaque = copy;
}

std::shared_ptr<const Image> TextureReader::Combine(const std::shared_ptr<const Image>& roughness,
                                                    const std::shared_ptr<const Image>& metalness) {
  if (roughness == nullptr && metalness == nullptr) return nullptr;
  auto& combined = combined_[{roughness.get(), metalness.get()}];
  if (combined != nullptr) return combined;
  const Image& size = roughness != nullptr ? *roughness : *metalness;
  auto image = std::make_shared<Image>(Image{size.width, size.height, 3, {}, size.source});
  image->pixels.reserve(static_cast<std::size_t>(size.width) *
                        static_cast<std::size_t>(size.height) * 3);
  // The value is the first channel of the nearest pixel, because both maps are grey.
  const auto sample = [&](const Image* map, int x, int y) -> std::uint8_t {
    if (map == nullptr) return 255;
    const int column = x * map->width / size.width, row = y * map->height / size.height;
    return map->pixels[static_cast<std::size_t>((row * map->width + column) * map->channels)];
  };
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      image->pixels.push_back(255);
      image->pixels.push_back(sample(roughness.get(), x, y));
      image->pixels.push_back(sample(metalness.get(), x, y));
    }
  }
  return combined = image;
}

}  // namespace gsv::formats
