// Textures on the graphics card, shared by all materials that use the same picture.
//
// Threads  the render thread only.
#pragma once

#include <map>
#include <memory>

#include "gsv/model/image.h"
#include "gsv/rendering/gl_objects.h"

namespace gsv::rendering {

// As its picture is encoded: whoever samples colours decodes them.
struct GpuTexture {
  GlTexture texture;
  bool see_through = false;  // some pixel's alpha is below 1
};

class GpuTextures {
 public:
  // Null for a null or unusable picture: its material then has no such map.
  std::shared_ptr<const GpuTexture> Find(const std::shared_ptr<const model::Image>& image);

  // Forgets the textures whose picture is gone.
  void Sweep();
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::weak_ptr<const model::Image> image;
    std::shared_ptr<const GpuTexture> texture;
  };
  std::map<const model::Image*, Entry> entries_;
};

}  // namespace gsv::rendering
