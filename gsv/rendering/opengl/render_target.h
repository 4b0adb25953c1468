// Where pictures of one size are drawn, and from where they are read back: one layer for each of
// several pictures, so that the first are read while the last are still being drawn.
//
// Threads  the render thread only.
#pragma once

#include <memory>
#include <vector>

#include "gsv/model/image.h"
#include "gsv/rendering/opengl/gl_objects.h"

namespace gsv::rendering {

class RenderTarget {
 public:
  RenderTarget(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  // How many pictures it holds at most before they must be read.
  int capacity() const { return capacity_; }

  // Clears depth and makes it what is drawn to. All pixels must be drawn, with the number of the
  // surface they show as alpha.
  void Begin();
  // The pictures since the last Read(), in the order of Begin(), with smooth edges; waits for the
  // card.
  std::vector<std::shared_ptr<const model::Image>> Read();

 private:
  struct Layer {
    GlRenderbuffer colour;
    GlFramebuffer frame;
  };

  int width_, height_, capacity_;
  std::size_t begun_ = 0;
  GlRenderbuffer depth_;
  std::vector<Layer> layers_;  // as many as were ever needed
  std::vector<std::uint8_t> rgba_;
};

}  // namespace gsv::rendering
