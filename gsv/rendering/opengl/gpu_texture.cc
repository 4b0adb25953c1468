#include "gsv/rendering/opengl/gpu_texture.h"

#include <algorithm>
#include <bit>

#include "gsv/rendering/opengl/gl.h"

namespace gsv::rendering {

using model::Image;

int MaxTextureSide() {
  int largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  return largest;
}

std::shared_ptr<DrawTexture> UploadTexture(const Image& image) {
  GlTexture texture = CreateTexture2D();
  const unsigned name = texture.name();
  const int levels = std::bit_width(static_cast<unsigned>(std::max(image.width, image.height)));
  // Textures without alpha also use four bytes per pixel, because cards and Mesa sample this format
  // fastest.
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
  auto uploaded = std::make_shared<GpuTexture>();
  uploaded->texture = std::move(texture);
  return uploaded;
}

}  // namespace gsv::rendering
