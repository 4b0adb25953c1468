#include "gsv/rendering/picture_target.h"

#include <algorithm>

#include <epoxy/gl.h>

#include "gsv/base/check.h"

namespace gsv::rendering {
namespace {

constexpr int kSamples = 4;
// Above this many pixels there is no anti-aliasing: it would take a gigabyte.
constexpr int kMostAntiAliased = 4 << 20;
constexpr int kMostInColumn = 16;
constexpr int kColumnPixels = 4 << 20;

}  // namespace

PictureTarget::PictureTarget(int width, int height)
    : width_(width),
      height_(height),
      capacity_(
          std::clamp(std::min(kColumnPixels / (width * height), 16384 / height), 1, kMostInColumn)),
      colour_(CreateRenderbuffer()),
      depth_(CreateRenderbuffer()),
      finished_(CreateRenderbuffer()),
      drawing_(CreateFramebuffer()),
      column_(CreateFramebuffer()) {
  const int samples = width * height <= kMostAntiAliased ? kSamples : 0;
  glNamedRenderbufferStorageMultisample(colour_.name(), samples, GL_RGBA8, width, height);
  glNamedRenderbufferStorageMultisample(depth_.name(), samples, GL_DEPTH_COMPONENT32F, width,
                                        height);
  glNamedRenderbufferStorage(finished_.name(), GL_RGBA8, width, height * capacity_);
  glNamedFramebufferRenderbuffer(drawing_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                 colour_.name());
  glNamedFramebufferRenderbuffer(drawing_.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                 depth_.name());
  glNamedFramebufferRenderbuffer(column_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                 finished_.name());
}

void PictureTarget::Begin() {
  GSV_CHECK(finished_count_ < capacity_);
  glBindFramebuffer(GL_FRAMEBUFFER, drawing_.name());
  glViewport(0, 0, width_, height_);
  glDepthMask(GL_TRUE);
  const float farthest = 0;
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void PictureTarget::End() {
  const int top = finished_count_++ * height_;
  glBlitNamedFramebuffer(drawing_.name(), column_.name(), 0, 0, width_, height_, 0, top, width_,
                         top + height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

std::vector<std::shared_ptr<const model::Image>> PictureTarget::Read() {
  std::vector<std::shared_ptr<const model::Image>> pictures;
  if (finished_count_ == 0) return pictures;
  const std::size_t pixels = static_cast<std::size_t>(width_) * height_;
  rgba_.resize(pixels * finished_count_ * 4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, column_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_ * finished_count_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  for (int i = 0; i < finished_count_; ++i) {
    auto picture = std::make_shared<model::Image>();
    picture->width = width_, picture->height = height_, picture->channels = 3;
    picture->pixels.resize(pixels * 3);
    const std::uint8_t* from = rgba_.data() + pixels * 4 * i;
    std::uint8_t* to = picture->pixels.data();
    for (std::size_t p = 0; p < pixels; ++p, from += 4, to += 3) {
      to[0] = from[0], to[1] = from[1], to[2] = from[2];
    }
    pictures.push_back(std::move(picture));
  }
  finished_count_ = 0;
  return pictures;
}

}  // namespace gsv::rendering
