// PushedViews sends images of views to clients over their WebSockets, without a request for each
// image.
//
// An image is drawn when the world or the camera has changed, at most as often as the client wants.
// The client reports each image that it has shown. The next image is drawn only after this report.
// If the client has reported the previous image quickly, one more image is drawn before the next
// report. So a slow client gets fewer images, and never outdated images.
//
// If the connection is too slow for an image (Client::slow_rate), the next images are coarser.
// First the JPEG quality is lower, then the images have fewer pixels than the client requested. The
// images become finer again when the connection is fast enough, but not before a waiting time has
// passed. The waiting time doubles each time the images become coarser.
//
// Format   docs/formats/live.md: a binary message for the client's subscription. It has a header of
//          kImageHeaderSize bytes, then a JPEG.
// Threads  any.
// Bounded  the views of each client (here), and all views (ViewDrawer).
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "gsv/base/mutex.h"
#include "gsv/gateway/drawing/view_drawer.h"
#include "gsv/gateway/drawing/view_routes.h"
#include "gsv/gateway/foxglove/views.h"

namespace gsv::gateway::drawing {

// Maximum number of views of one client at the same time.
inline constexpr std::size_t kMaxViewsOfClient = 4;
// Size in bytes of the header before each image. It contains, in little endian: the sequence (4
// bytes), the number of the image (8), and a time in microseconds since 1970 (8). At this time, the
// ViewDrawer first saw the state of the world that the image shows.
inline constexpr std::size_t kImageHeaderSize = 20;

// Sends images to the clients of one Hub (foxglove/hub.h), for all views that they have started.
// Each new image is sent over the client's WebSocket without a request, see above.
class PushedViews final : public Views, public std::enable_shared_from_this<PushedViews> {
 public:
  // Returns the world that the Hub serves, or an error if this world does not exist any more.
  using FindWorldOfHub = std::function<base::Result<ViewedWorld>()>;

  // `drawer` must outlive the clients of the Hub.
  PushedViews(ViewDrawer& drawer, FindWorldOfHub find) : drawer_(drawer), find_(std::move(find)) {}

  // Starts a view, or changes its camera.
  void Handle(const std::shared_ptr<Client>& client, const foxglove::WatchView& request) override;
  // Ends a view.
  void Handle(const std::shared_ptr<Client>& client, const foxglove::UnwatchView& request) override;
  // Records that the client has shown an image.
  void Handle(const std::shared_ptr<Client>& client, const foxglove::ViewShown& request) override;
  // Ends all views of a client.
  void Forget(Client* client) override;

 private:
  using Clock = ViewDrawer::Clock;
  using Key = std::pair<Client*, foxglove::SubscriptionId>;  // a client, and its id of a view
  // A view of a client, with the state of its images.
  struct Watched {
    std::weak_ptr<Client> client;
    foxglove::SubscriptionId id = 0;
    ViewQuery query;                         // the requested camera, quality and rate
    std::uint32_t sequence = 0;              // number of the camera, see WatchView
    std::shared_ptr<ViewDrawer::Seat> seat;  // null if the camera has changed
    std::uint64_t last = 0;                  // number of the last image of this camera; 0: none
    bool is_asked = false;                   // whether an answer of the ViewDrawer is pending
    int unshown = 0;                         // number of sent images not yet reported as shown
    Clock::time_point due{};                 // earliest time of the next image
    Clock::time_point sent{};                // time at which the last image was sent
    Clock::duration reported_after{};        // time from then to the last report of the client
    // index in kDetails (pushed_views.cc); 0: the quality and size that the client requested
    std::size_t detail = 0;
    Clock::time_point coarse_until{};  // earliest time of a finer image
    // minimum time that the images stay coarse; doubles each time that they become coarser; 0: they
    // were never coarse
    Clock::duration coarse_for{};
  };
  using WatchedPtr = std::shared_ptr<Watched>;

  // Returns the view, or null if it does not exist.
  WatchedPtr Find(const Key& key) const;
  // Removes a view and cancels its pending request.
  void Remove(const Key& key);
  // Asks for the next image, if the client may get another image now.
  void Continue(const WatchedPtr& watched);
  // Requests an image from the ViewDrawer.
  base::Status Ask(const WatchedPtr& watched);
  // Sends an image. `earliest`: the value that was passed to ViewDrawer::Ask() for this image.
  void OnImage(const WatchedPtr& watched, std::uint32_t sequence, Clock::time_point earliest,
               const base::Result<DrawnImage>& image);
  // Chooses the detail of the next image. `slow_rate`: see Client. `bytes`: size of the image that
  // is sent now.
  static void ChooseDetail(Watched& watched, double slow_rate, std::size_t bytes);
  // Ends a view and sends the client the reason.
  void Fail(const WatchedPtr& watched, const base::Error& error);
  // Returns the message with an image: the header, then the JPEG.
  static SharedBytes MessageOf(const Watched& watched, std::uint32_t sequence,
                               const DrawnImage& image);

  ViewDrawer& drawer_;
  const FindWorldOfHub find_;  // returns the world that is drawn
  mutable base::Mutex mutex_;
  std::map<Key, WatchedPtr> watched_ GSV_GUARDED_BY(mutex_);  // mutex_ also guards each Watched
};

}  // namespace gsv::gateway::drawing
