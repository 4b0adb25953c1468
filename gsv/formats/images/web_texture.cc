#include "gsv/formats/images/web_texture.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "gsv/formats/images/stb_copy.h"

// The functions of stb_image_write are private to this source file (STB_IMAGE_WRITE_STATIC).
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define memcpy gsv::formats::CopyBytes
#include <stb/stb_image_write.h>
#define STB_IMAGE_RESIZE_STATIC
#define STB_IMAGE_RESIZE_IMPLEMENTATION
#include <stb/stb_image_resize.h>
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#include <stb/stb_image.h>
#undef memcpy
#pragma GCC diagnostic pop

namespace gsv::formats {
namespace {

using model::Image;

constexpr int kJpegQuality = 88;
constexpr std::streamsize kMaxFileBytes = 16 << 20;

bool IsUsable(const Image& image) {
  return image.width > 0 && image.height > 0 && (image.channels == 3 || image.channels == 4) &&
         image.pixels.size() ==
             static_cast<std::size_t>(image.width) * image.height * image.channels;
}

std::string MimeTypeOf(const std::vector<std::uint8_t>& bytes) {
  const auto begins = [&](std::initializer_list<std::uint8_t> magic) {
    return bytes.size() > magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
  };
  if (begins({0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'})) return "image/png";
  if (begins({0xff, 0xd8, 0xff})) return "image/jpeg";
  return "";
}

// Returns the image's own file. The result is empty if the file does not exist, if browsers do not
// read its format, or if its size differs from the image's size.
WebTexture Original(const Image& image) {
  std::ifstream file(image.source, std::ios::binary | std::ios::ate);
  if (!file || file.tellg() <= 0 || file.tellg() > kMaxFileBytes) return {};
  file.seekg(0);
  WebTexture texture;
  texture.bytes.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(texture.bytes.data(), static_cast<int>(texture.bytes.size()), &width,
                             &height, &channels) ||
      width != image.width || height != image.height) {
    return {};
  }
  texture.mime_type = MimeTypeOf(texture.bytes);
  return texture;
}

// Scales the image down so that no side exceeds `max_side`.
Image Reduced(const Image& image, int max_side) {
  const double scale = static_cast<double>(max_side) / std::max(image.width, image.height);
  Image reduced;
  reduced.width = std::max(1, static_cast<int>(std::lround(image.width * scale)));
  reduced.height = std::max(1, static_cast<int>(std::lround(image.height * scale)));
  reduced.channels = image.channels;
  reduced.pixels.resize(static_cast<std::size_t>(reduced.width) * reduced.height * image.channels);
  stbir_resize_uint8(image.pixels.data(), image.width, image.height, 0, reduced.pixels.data(),
                     reduced.width, reduced.height, 0, image.channels);
  return reduced;
}

void Append(void* bytes, void* data, int size) {
  auto& out = *static_cast<std::vector<std::uint8_t>*>(bytes);
  const auto* begin = static_cast<const std::uint8_t*>(data);
  out.insert(out.end(), begin, begin + size);
}

WebTexture Encode(const Image& image) {
  WebTexture texture;
  if (image.channels == 4) {
    texture.mime_type = "image/png";
    stbi_write_png_to_func(Append, &texture.bytes, image.width, image.height, 4,
                           image.pixels.data(), 0);
  } else {
    texture.mime_type = "image/jpeg";
    stbi_write_jpg_to_func(Append, &texture.bytes, image.width, image.height, 3,
                           image.pixels.data(), kJpegQuality);
  }
  return texture;
}

}  // namespace

WebTexture EncodeForWeb(const Image& image, bool original_allowed, int max_side) {
  if (!IsUsable(image)) return {};
  if (std::max(image.width, image.height) > max_side) return Encode(Reduced(image, max_side));
  if (original_allowed && !image.source.empty()) {
    if (WebTexture original = Original(image); !original.mime_type.empty()) return original;
  }
  return Encode(image);
}

}  // namespace gsv::formats
