// Writes the parts of a stream of JPEG images (multipart/x-mixed-replace).
#pragma once

#include <string>
#include <string_view>

#include "gsv/gateway/foxglove/shared_bytes.h"

namespace gsv::gateway::drawing {

// The content type of a stream of images.
inline constexpr const char* kImageStreamType = "multipart/x-mixed-replace; boundary=gsv-image";

// Returns the part of one image. `time` is the simulated time of the image in seconds, for the
// header Gsv-Time. A part ends with the boundary, so that browsers show the image at once.
inline SharedBytes ImagePart(std::string_view jpeg, std::string_view time, bool is_first) {
  constexpr std::string_view kBoundary = "--gsv-image\r\n";
  std::string part(is_first ? kBoundary : "");
  part += "Content-Type: image/jpeg\r\nContent-Length: " + std::to_string(jpeg.size());
  part += "\r\nGsv-Time: ";
  part += time;
  part += "\r\n\r\n";
  part += jpeg;
  part += "\r\n";
  part += kBoundary;
  return SharedBytes(std::move(part));
}

}  // namespace gsv::gateway::drawing
