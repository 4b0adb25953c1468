// Where pictures of one size are drawn, and from where they are read back: an anti-aliased picture
// that is drawn over and over, and a column of finished ones.
//
// Threads  the render thread only.
#pragma once

#include <memory>
#include <vector>

#include "gsv/model/image.h"
#include "gsv/rendering/gl_objects.h"

namespace gsv::rendering {

class PictureTarget {
 public:
  PictureTarget(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  // How many pictures it holds at most before they must be read.
  int capacity() const { return capacity_; }

  // Clears depth and makes it what is drawn to.
  void Begin();
  // The picture is complete.
  void End();
  // The pictures since the last Read(), in the order of Begin(); waits for the card.
  std::vector<std::shared_ptr<const model::Image>> Read();

 private:
  int width_, height_, capacity_;
  int finished_count_ = 0;
  GlRenderbuffer colour_, depth_, finished_;
  GlFramebuffer drawing_, column_;
  std::vector<std::uint8_t> rgba_;
};

}  // namespace gsv::rendering
