#include "gsv/rendering/opengl/render_target.h"

#include <algorithm>

#include "gsv/base/check.h"
#include "gsv/rendering/opengl/gl.h"
#include "gsv/rendering/scene/antialiasing.h"

namespace gsv::rendering {
namespace {

constexpr int kMaxLayers = 16;
// maximum number of pixels in all layers; if one image has more pixels, there is only one layer
constexpr int kMaxPixels = 4 << 20;

}  // namespace

RenderTarget::RenderTarget(int width, int height)
    : width_(width),
      height_(height),
      capacity_(std::clamp(kMaxPixels / (width * height), 1, kMaxLayers)),
      depth_(CreateRenderbuffer()) {
  glNamedRenderbufferStorage(depth_.name(), GL_DEPTH_COMPONENT32F, width, height);
}

void RenderTarget::Begin() {
  GSV_CHECK(begun_ < static_cast<std::size_t>(capacity_));
  if (begun_ == layers_.size()) {
    Layer& layer = layers_.emplace_back(Layer{CreateRenderbuffer(), CreateFramebuffer()});
    glNamedRenderbufferStorage(layer.colour.name(), GL_RGBA8, width_, height_);
    glNamedFramebufferRenderbuffer(layer.frame.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                   layer.colour.name());
    glNamedFramebufferRenderbuffer(layer.frame.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                   depth_.name());
  }
  glBindFramebuffer(GL_FRAMEBUFFER, layers_[begun_++].frame.name());
  glViewport(0, 0, width_, height_);
  glDepthMask(GL_TRUE);
  const float farthest = 0;
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

std::vector<std::shared_ptr<const model::Image>> RenderTarget::Read() {
  std::vector<std::shared_ptr<const model::Image>> images;
  rgba_.resize(static_cast<std::size_t>(width_) * height_ * 4);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  for (std::size_t i = 0; i < begun_; ++i) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, layers_[i].frame.name());
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
    images.push_back(
        std::make_shared<const model::Image>(SmoothAliasedEdges(width_, height_, rgba_.data())));
  }
  begun_ = 0;
  return images;
}

}  // namespace gsv::rendering
