// Counters of the images that a server draws for viewers.
#pragma once

#include <cstdint>

namespace gsv::gateway::metrics {

// Counters of the images that a server draws for viewers. A view is a camera with its image size.
struct DrawnViews {
  std::uint64_t views = 0;    // number of different views that clients receive now
  std::uint64_t clients = 0;  // number of requests and streams that receive these views now
  std::uint64_t images = 0;   // number of images drawn since the start
};

}  // namespace gsv::gateway::metrics
