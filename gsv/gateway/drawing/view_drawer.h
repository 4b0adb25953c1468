// A ViewDrawer renders the images that viewers request. It has its own thread, so stepping threads
// do not wait for it.
//
// A viewer asks for the next image with the number of the last image that it got. So images are
// drawn only if something has changed, and only as fast as the viewer requests them. Equal requests
// share one image.
//
// Threads  any. Answers are called on the drawer's thread. The answer to a refused request is
//          called on the thread of the caller.
// Bounded  views: see DrawingLimits.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/gateway/drawing/view_source.h"
#include "gsv/gateway/foxglove/shared_bytes.h"
#include "gsv/gateway/metrics/drawn_views.h"
#include "gsv/rendering/renderer.h"

namespace gsv::gateway::drawing {

// Limits on the work of a ViewDrawer.
struct DrawingLimits {
  std::size_t views = 8;              // number of different ViewRequests at the same time
  std::size_t viewers = 64;           // number of requests and streams at the same time
  std::int64_t pixels = 3840 * 2160;  // number of pixels of one image
};

enum class ImageFormat { kJpeg, kPng };

// A request for an image. Equal requests share one image.
struct ViewRequest {
  std::string world;  // name of the world, the key of its source
  view::Camera camera;
  ImageFormat format = ImageFormat::kJpeg;
  int quality = 80;  // quality of the JPEG, 1 to 100
  // Distance in pixels between the depths that the JPEG contains (depth_segment.h); 0: no depths.
  int depth_spacing = 0;
  friend bool operator==(const ViewRequest&, const ViewRequest&) = default;
};

// An encoded image, and the state of the world that it shows.
struct DrawnImage {
  SharedBytes bytes;
  std::uint64_t number = 0;  // increases with each change of the world
  base::SimTime time{};
  std::chrono::system_clock::time_point seen{};  // when the drawer first saw the shown state
};

// Renders the images that viewers request, on its own thread.
class ViewDrawer {
 public:
  using Clock = std::chrono::steady_clock;
  using Answer = std::function<void(base::Result<DrawnImage>)>;
  using MakeSource = std::function<std::unique_ptr<ViewSource>()>;

  explicit ViewDrawer(const DrawingLimits& limits = {});
  ~ViewDrawer();

  // Reserves a Seat for one request or stream (see DrawingLimits::viewers). Destroying the Seat
  // releases it. Fails with kUnavailable if the limit of viewers or views is reached, and with
  // kInvalidArgument if the image is too large.
  class Seat;
  base::Result<std::shared_ptr<Seat>> Take(const ViewRequest& request);

  // Sets the source of the world with that name. `identity` is the simulation or replay itself. If
  // `identity` differs from the previous identity, the source is replaced.
  void SetSource(const std::string& world, const std::weak_ptr<const void>& identity,
                 const MakeSource& make);

  // Answers with an image of the world as soon as the number of the world's state differs from
  // `after`, but not before `earliest`. If `after` is 0, this is the case at once. If nothing has
  // changed for `timeout`, answers with the present image.
  void Ask(std::shared_ptr<Seat> seat, std::uint64_t after, Clock::time_point earliest,
           std::chrono::milliseconds timeout, Answer answer);

  // Cancels the pending request of a seat. Returns true if no answer will come, and false if the
  // image is being drawn or the request was answered already.
  bool Withdraw(const Seat& seat);

  // Returns the numbers of different views, of occupied seats and of drawn images.
  metrics::DrawnViews Counts();

  // Answers all pending requests with kEnded, and refuses further requests.
  void Stop();

 private:
  // A world that is drawn: its source, and the newest state of it.
  struct World {
    std::weak_ptr<const void> identity;  // see SetSource()
    std::shared_ptr<ViewSource> source;
    std::shared_ptr<const world::Snapshot> snapshot;  // newest state seen by the drawer
    std::uint64_t number = 0;                         // number of this state
    std::chrono::system_clock::time_point seen{};     // when the drawer first saw this state
    Clock::time_point used{};                         // time of the last request for an image
  };
  // A request that is not answered yet: the arguments of Ask().
  struct Pending {
    std::shared_ptr<Seat> seat;
    std::uint64_t after = 0;  // number of the state that the requester already has
    // time of the earliest answer, and time of the answer if nothing changes
    Clock::time_point earliest, deadline;
    Answer answer;
  };
  // An image for one request, which equal requests share.
  struct CachedImage {
    ViewRequest request;
    DrawnImage image;
  };

  // Returns the different requests of the occupied seats.
  std::vector<ViewRequest> Views() const GSV_REQUIRES(mutex_);
  // The main function of the drawing thread.
  void Run();
  // Removes each world that nobody has requested for kUnusedSourceTimeout. If no world is left,
  // also removes the cached images.
  void DropUnused();
  // Answers the requests of one world that are due. Returns whether any request was due.
  bool Serve(const std::string& name);
  // Removes and returns the requests of a world that are due.
  std::vector<Pending> TakeDue(const std::string& name, std::uint64_t number);
  // The number of a state, and the time at which the drawer first saw it.
  struct Seen {
    std::uint64_t number = 0;
    std::chrono::system_clock::time_point at{};  // when the drawer first saw the state
  };
  // Draws the images of these requests and answers them.
  void Draw(const ViewInstant& instant, const Seen& seen, std::vector<Pending> due);
  // Draws the image of a request and encodes it in the requested format.
  static base::Result<SharedBytes> DrawEncoded(rendering::Renderer& renderer,
                                               const ViewInstant& instant,
                                               const rendering::CameraView& view,
                                               const ViewRequest& request);

  const DrawingLimits limits_;
  // Only the drawing thread uses these three members.
  std::shared_ptr<rendering::Renderer> renderer_;  // null until the first image
  std::uint64_t next_number_ = 0;                  // number of the newest state of any world
  std::vector<CachedImage> kept_;                  // the images that were drawn last

  base::Mutex mutex_;
  base::ConditionVariable changed_;                             // notified by Ask() and Stop()
  std::map<std::string, World> worlds_ GSV_GUARDED_BY(mutex_);  // by name
  std::vector<Pending> pending_ GSV_GUARDED_BY(mutex_);  // requests that are not answered yet
  std::vector<std::weak_ptr<Seat>> seats_ GSV_GUARDED_BY(mutex_);  // occupied seats
  std::uint64_t images_ GSV_GUARDED_BY(mutex_) = 0;                // number of images drawn so far
  bool stopping_ GSV_GUARDED_BY(mutex_) = false;                   // set by Stop()
  std::thread thread_;  // the drawing thread: it executes Run()
};

// A place among the requests and streams that a ViewDrawer serves at the same time.
class ViewDrawer::Seat {
 public:
  explicit Seat(ViewRequest request) : request_(std::move(request)) {}
  const ViewRequest& request() const { return request_; }

 private:
  const ViewRequest request_;
};

}  // namespace gsv::gateway::drawing
