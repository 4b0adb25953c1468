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

// The side of the largest texture that the card takes, pixels.
int MaxTextureSide();

std::shared_ptr<DrawTexture> UploadTexture(const model::Image& image);

}  // namespace gsv::rendering
