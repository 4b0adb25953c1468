// A render target for images of one size. It has several layers, so that the first images are read
// back while the last images are still rendered.
//
// Threads  the render thread only.
#pragma once

#include <memory>
#include <vector>

#include "gsv/model/image.h"
#include "gsv/rendering/opengl/gl_objects.h"

namespace gsv::rendering {

// A framebuffer with several layers, one for each image.
class RenderTarget {
 public:
  RenderTarget(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  // The maximum number of images before Read() must be called.
  int capacity() const { return capacity_; }

  // Begins an image: clears the depth and binds the target. The caller must draw all pixels. Alpha
  // must be the number of the pixel's surface, from which Read() finds the edges to antialias.
  void Begin();
  // Returns the images since the last Read(), in the order of Begin(), antialiased. Waits for the
  // card.
  std::vector<std::shared_ptr<const model::Image>> Read();

 private:
  // The colour buffer of one image.
  struct Layer {
    GlRenderbuffer colour;
    GlFramebuffer frame;
  };

  int width_, height_, capacity_;   // size in pixels; maximum number of layers
  std::size_t begun_ = 0;           // number of images since the last Read()
  GlRenderbuffer depth_;            // the depth buffer, which all layers share
  std::vector<Layer> layers_;       // layers are added when they are needed
  std::vector<std::uint8_t> rgba_;  // working memory of Read()
};

}  // namespace gsv::rendering
