// Textures as a back end samples them, shared by all materials that use the same picture.
//
// Threads  the render thread only.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include "gsv/model/image.h"

namespace gsv::rendering {

// A texture as a back end keeps it; each has its own kind. As its picture is encoded: whoever
// samples colours decodes them.
struct DrawTexture {
  virtual ~DrawTexture() = default;
  bool is_transparent = false;  // some pixel's alpha is below 1
};

class TextureStore {
 public:
  // Is given usable pictures of at most `largest_side` pixels.
  using Make = std::function<std::shared_ptr<DrawTexture>(const model::Image&)>;
  TextureStore(Make make, int largest_side) : make_(std::move(make)), largest_(largest_side) {}

  // Null for a null or unusable picture: its material then has no such map.
  std::shared_ptr<const DrawTexture> Find(const std::shared_ptr<const model::Image>& image);

  // Forgets the textures whose picture is gone.
  void Sweep();
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::weak_ptr<const model::Image> image;
    std::shared_ptr<const DrawTexture> texture;
  };
  const Make make_;
  const int largest_;
  std::map<const model::Image*, Entry> entries_;
};

}  // namespace gsv::rendering
