// Textures on the graphics card.
//
// Threads  the render thread only.
#pragma once

#include "gsv/rendering/opengl/gl_objects.h"
#include "gsv/rendering/scene/texture_store.h"

namespace gsv::rendering {

struct GpuTexture final : DrawTexture {
  GlTexture texture;
};

// The largest texture side of the card, in pixels.
int MaxTextureSide();

std::shared_ptr<DrawTexture> UploadTexture(const model::Image& image);

}  // namespace gsv::rendering
