// Textures on the graphics card.
//
// Threads  the render thread only.
#pragma once

#include "gsv/rendering/opengl/gl_objects.h"
#include "gsv/rendering/scene/texture_store.h"

namespace gsv::rendering {

// A texture on the graphics card.
struct GpuTexture final : DrawTexture {
  GlTexture texture;
};

// The maximum side length of a texture on the card, in pixels.
int MaxTextureSide();

// Copies an image to the graphics card, and makes its mipmaps.
std::shared_ptr<DrawTexture> UploadTexture(const model::Image& image);

}  // namespace gsv::rendering
