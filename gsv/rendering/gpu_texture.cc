#include "gsv/rendering/gpu_texture.h"

#include <algorithm>
#include <bit>

#include <epoxy/gl.h>

namespace gsv::rendering {
namespace {

using model::Image;

bool Usable(const Image& image) {
  int largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  return image.width > 0 && image.height > 0 && image.width <= largest && image.height <= largest &&
         (image.channels == 3 || image.channels == 4) &&
         image.pixels.size() ==
             static_cast<std::size_t>(image.width) * image.height * image.channels;
}

bool SeeThrough(const Image& image) {
  if (image.channels != 4) return false;
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
    if (image.pixels[i] < 250) return true;
  }
  return false;
}

std::shared_ptr<const GpuTexture> Upload(const Image& image) {
  GlTexture texture = CreateTexture2D();
  const unsigned name = texture.name();
  const int levels = std::bit_width(static_cast<unsigned>(std::max(image.width, image.height)));
  // Four bytes a pixel even without alpha: cards and Mesa sample nothing else as fast.
  glTextureStorage2D(name, levels, GL_RGBA8, image.width, image.height);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(name, 0, 0, 0, image.width, image.height,
                      image.channels == 4 ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE,
                      image.pixels.data());
  glGenerateTextureMipmap(name);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_REPEAT);
  return std::make_shared<GpuTexture>(GpuTexture{std::move(texture), SeeThrough(image)});
}

}  // namespace

std::shared_ptr<const GpuTexture> GpuTextures::Find(const std::shared_ptr<const Image>& image) {
  if (image == nullptr || !Usable(*image)) return nullptr;
  Entry& entry = entries_[image.get()];
  // An address may be that of an earlier picture that is gone.
  if (entry.texture == nullptr || entry.image.lock() != image) {
    entry = {image, Upload(*image)};
  }
  return entry.texture;
}

void GpuTextures::Sweep() {
  std::erase_if(entries_, [](const auto& item) { return item.second.image.expired(); });
}

}  // namespace gsv::rendering
