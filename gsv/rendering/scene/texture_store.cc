#include "gsv/rendering/scene/texture_store.h"

namespace gsv::rendering {
namespace {

using model::Image;

bool Usable(const Image& image, int largest) {
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

}  // namespace

std::shared_ptr<const DrawTexture> TextureStore::Find(const std::shared_ptr<const Image>& image) {
  if (image == nullptr || !Usable(*image, max_side_)) return nullptr;
  Entry& entry = entries_[image.get()];
  // To compare addresses is not sufficient: a destroyed image may have had the same address.
  if (entry.texture == nullptr || entry.image.lock() != image) {
    std::shared_ptr<DrawTexture> texture = make_(*image);
    texture->is_transparent = SeeThrough(*image);
    entry = {image, std::move(texture)};
  }
  return entry.texture;
}

void TextureStore::Sweep() {
  std::erase_if(entries_, [](const auto& item) { return item.second.image.expired(); });
}

}  // namespace gsv::rendering
