// RelayedImages serves streams of images (view.mjpeg) through a relay. It requests one image after
// another from the other instance, and sends them as its own stream.
//
// Threads  any. Open() requests the first image of a stream on the caller's thread, and this
//          object's own thread pool requests the others.
// Bounded  kMaxImageStreams streams.
#pragma once

#include <chrono>
#include <memory>

#include "gsv/gateway/http/http.h"
#include "gsv/gateway/server/worker_pool.h"
#include "gsv/gateway/upstream/address.h"

namespace boost::asio {
class io_context;
}

namespace gsv::gateway {

inline constexpr long kMaxImageStreams = 8;

// Serves streams of images through a relay.
class RelayedImages {
 public:
  // `io` must outlive this object and run during its whole lifetime.
  RelayedImages(boost::asio::io_context& io, upstream::Address address);
  ~RelayedImages();

  // Returns the response to GET …/view.mjpeg. `image` is the same request for view.jpg, without
  // `fps` and `token`. Waits for the first image.
  Response Open(const Request& request, const Request& image);
  // Ends the streams.
  void Stop();

 private:
  boost::asio::io_context& io_;
  const upstream::Address address_;         // the other instance
  const std::shared_ptr<WorkerPool> pool_;  // makes the requests to the other instance
  // Each open stream has a copy, so use_count() counts the open streams.
  const std::shared_ptr<int> seats_ = std::make_shared<int>(0);
};

}  // namespace gsv::gateway
