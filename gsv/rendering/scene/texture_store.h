// A cache of a back end's textures, shared by materials with the same image.
//
// Threads  the render thread only.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include "gsv/model/image.h"

namespace gsv::rendering {

// Base class of a back end's texture. Texels are encoded as in the image; shaders decode colours.
struct DrawTexture {
  virtual ~DrawTexture() = default;
  bool is_transparent = false;  // whether some pixel has an alpha below 250 of 255
};

// Keeps one texture for each image that materials use.
class TextureStore {
 public:
  // Makes a texture of a valid image with sides of at most `max_side` pixels.
  using Make = std::function<std::shared_ptr<DrawTexture>(const model::Image&)>;
  TextureStore(Make make, int max_side) : make_(std::move(make)), max_side_(max_side) {}

  // Returns null for a null or invalid image. The material is then drawn without this texture.
  std::shared_ptr<const DrawTexture> Find(const std::shared_ptr<const model::Image>& image);

  // Removes textures whose image was destroyed.
  void Sweep();
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::weak_ptr<const model::Image> image;
    std::shared_ptr<const DrawTexture> texture;
  };
  const Make make_;     // makes the back end's textures
  const int max_side_;  // pixels; images with a longer side are not used
  std::map<const model::Image*, Entry> entries_;
};

}  // namespace gsv::rendering
