// Encodes animated PNG files (APNG), part by part; lossless. A reader that does not support APNG
// shows the first frame.
// Format  Portable Network Graphics (PNG) Specification (Third Edition), section 11.3.6.
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/image.h"

namespace gsv::rendering {

// Encodes an animated PNG file, frame by frame.
class ApngEncoder {
 public:
  // `frames_a_second` is from 0.1 to 240, and is rounded to hundredths. The animation plays once.
  ApngEncoder(std::uint32_t frames, double frames_a_second);

  // Returns the bytes of the next frame. The first call also returns the beginning of the file. All
  // frames must have the same size. Fails with kInvalidArgument for an image without pixels, or
  // with a size that differs from the first frame.
  base::Result<std::vector<std::uint8_t>> Add(const model::Image& image);
  // Returns the end of the file.
  static std::vector<std::uint8_t> End();

 private:
  std::uint32_t frames_;             // number of frames of the whole animation
  std::uint16_t delay_denominator_;  // denominator of the delay; its numerator is 100
  std::uint32_t next_ = 0;           // sequence number of the next chunk
  int width_ = 0, height_ = 0;       // size of the first frame; 0 before it
};

}  // namespace gsv::rendering
