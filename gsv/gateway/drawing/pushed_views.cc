#include "gsv/gateway/drawing/pushed_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "gsv/gateway/foxglove/foxglove_operations.h"

namespace gsv::gateway::drawing {
namespace {

using base::ErrorCode;

// The ViewDrawer answers after this time even if nothing has changed.
constexpr std::chrono::milliseconds kPushTimeout{5000};
// If a client reports an image as shown within this time, one further image may be sent before the
// next report.
constexpr std::chrono::milliseconds kFast{100};

struct Detail {
  double scale = 1;   // factor for the width and the height of the image
  int quality = 100;  // maximum quality of the JPEG
};
constexpr std::array<Detail, 5> kDetails{{{1, 100}, {1, 55}, {0.75, 45}, {0.5, 40}, {0.35, 30}}};
// The time in seconds that the transfer of an image over a slow connection may take. If it takes
// longer, the next image is coarser (the next entry of kDetails). If it takes less than a quarter
// of this time, the next image may be finer.
constexpr double kImageTime = 0.4;
// Images that become coarser stay so for at least kFirstCoarse the first time. This time doubles
// each further time, up to kMaxCoarse. kBetweenSteps is the minimum time between two steps to finer
// images.
constexpr std::chrono::seconds kFirstCoarse{5}, kMaxCoarse{300}, kBetweenSteps{1};

ViewRequest Coarsened(ViewRequest view, std::size_t detail) {
  const auto side = [&](int pixels) {
    const int smallest = std::min(pixels, view::kMinSide);
    return std::max(smallest, static_cast<int>(std::lround(kDetails[detail].scale * pixels)));
  };
  view.camera.width = side(view.camera.width);
  view.camera.height = side(view.camera.height);
  view.quality = std::min(view.quality, kDetails[detail].quality);
  return view;
}

template <typename Number>
void AppendNumber(Number value, std::string& bytes) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    bytes.push_back(static_cast<char>(value >> (8 * i)));
  }
}

base::Result<ViewQuery> QueryOf(const foxglove::WatchView& request) {
  const auto target = ParseTarget("/view.mjpeg?" + request.camera);
  if (target) return ParseViewQuery(*target, true);
  return base::Fail(ErrorCode::kInvalidArgument,
                    "cannot read the camera of a view: " + target.error().message);
}

}  // namespace

void PushedViews::Handle(const std::shared_ptr<Client>& client,
                         const foxglove::WatchView& request) {
  const Key key{client.get(), request.id};
  const auto refuse = [&](const base::Error& error) {
    client->SendText(SharedBytes(foxglove::ViewFailureText(request.id, error.Sentence())));
  };
  const auto query = QueryOf(request);
  if (!query) {
    Remove(key);
    return refuse(query.error());
  }
  WatchedPtr watched;
  std::shared_ptr<ViewDrawer::Seat> former;
  {
    const base::MutexLock lock(mutex_);
    const auto of_client = std::count_if(watched_.begin(), watched_.end(), [&](const auto& each) {
      return each.first.first == client.get();
    });
    if (!watched_.contains(key) && static_cast<std::size_t>(of_client) >= kMaxViewsOfClient) {
      return refuse({ErrorCode::kUnavailable,
                     "a client can have at most " + std::to_string(kMaxViewsOfClient) +
                         " views; unsubscribe one of them",
                     {}});
    }
    WatchedPtr& known = watched_[key];
    if (known == nullptr) known = std::make_shared<Watched>();
    watched = known;
    watched->client = client;
    watched->id = request.id;
    watched->query = *query;
    watched->sequence = request.sequence;
    watched->last = 0;
    former = std::exchange(watched->seat, nullptr);
  }
  if (former != nullptr && drawer_.Withdraw(*former)) {
    const base::MutexLock lock(mutex_);
    watched->is_asked = false;
  }
  former.reset();
  Continue(watched);
}

void PushedViews::Handle(const std::shared_ptr<Client>& client,
                         const foxglove::UnwatchView& request) {
  Remove({client.get(), request.id});
}

void PushedViews::Handle(const std::shared_ptr<Client>& client,
                         const foxglove::ViewShown& request) {
  const WatchedPtr watched = Find({client.get(), request.id});
  if (watched == nullptr) return;  // the view ended while the report was in transit
  {
    const base::MutexLock lock(mutex_);
    if (watched->unshown == 0) return;
    --watched->unshown;
    watched->reported_after = Clock::now() - watched->sent;
  }
  Continue(watched);
}

void PushedViews::Forget(Client* client) {
  std::vector<Key> keys;
  {
    const base::MutexLock lock(mutex_);
    for (const auto& [key, watched] : watched_) {
      if (key.first == client) keys.push_back(key);
    }
  }
  for (const Key& key : keys) Remove(key);
}

PushedViews::WatchedPtr PushedViews::Find(const Key& key) const {
  const base::MutexLock lock(mutex_);
  const auto found = watched_.find(key);
  return found == watched_.end() ? nullptr : found->second;
}

void PushedViews::Remove(const Key& key) {
  std::shared_ptr<ViewDrawer::Seat> seat;
  {
    const base::MutexLock lock(mutex_);
    const auto found = watched_.find(key);
    if (found == watched_.end()) return;
    seat = std::exchange(found->second->seat, nullptr);
    found->second->client.reset();
    watched_.erase(found);
  }
  if (seat != nullptr) drawer_.Withdraw(*seat);
}

void PushedViews::Continue(const WatchedPtr& watched) {
  {
    const base::MutexLock lock(mutex_);
    const int allowed = watched->reported_after < kFast ? 1 : 0;
    if (watched->is_asked || watched->unshown > allowed || watched->client.expired()) return;
    watched->is_asked = true;
  }
  if (const base::Status asked = Ask(watched); !asked) Fail(watched, asked.error());
}

base::Status PushedViews::Ask(const WatchedPtr& watched) {
  const auto world = find_();
  if (!world) return base::Fail(world.error());
  ViewRequest view;
  std::shared_ptr<ViewDrawer::Seat> seat;
  std::uint32_t sequence = 0;
  std::uint64_t last = 0;
  std::size_t detail = 0;
  Clock::time_point earliest;
  {
    const base::MutexLock lock(mutex_);
    detail = watched->detail;
    view = Coarsened(watched->query.view, detail);
    seat = watched->seat;
    sequence = watched->sequence;
    last = watched->last;
    earliest = std::max(watched->due, Clock::now());
  }
  view.world = world->name;
  if (seat == nullptr) {
    auto taken = drawer_.Take(view);
    if (!taken && detail > 0) {
      // A smaller image counts as a separate view, and the limit on the number of views is reached.
      // Try the full size: if another viewer has this view in full size, both can share it.
      {
        const base::MutexLock lock(mutex_);
        watched->detail = 0;
        view = watched->query.view;
      }
      view.world = world->name;
      taken = drawer_.Take(view);
    }
    if (!taken) return base::Fail(taken.error());
    seat = *std::move(taken);
    const base::MutexLock lock(mutex_);
    // If the client has chosen another camera in the meantime, this image still uses the old
    // camera, and the next image uses the new one.
    if (watched->sequence == sequence && !watched->client.expired()) watched->seat = seat;
  }
  drawer_.SetSource(world->name, world->identity, world->make);
  drawer_.Ask(std::move(seat), last, earliest, kPushTimeout,
              [weak = weak_from_this(), watched, sequence,
               earliest](const base::Result<DrawnImage>& image) {
                if (const auto self = weak.lock()) {
                  self->OnImage(watched, sequence, earliest, image);
                }
              });
  return {};
}

void PushedViews::OnImage(const WatchedPtr& watched, std::uint32_t sequence,
                          Clock::time_point earliest, const base::Result<DrawnImage>& image) {
  if (!image) {
    {
      const base::MutexLock lock(mutex_);
      watched->is_asked = false;
    }
    return Fail(watched, image.error());
  }
  std::shared_ptr<Client> client;
  {
    const base::MutexLock lock(mutex_);
    watched->is_asked = false;
    watched->due =
        earliest + std::chrono::duration_cast<Clock::duration>(
                       std::chrono::duration<double>(1 / watched->query.frames_a_second));
    client = watched->client.lock();
    const bool is_current = watched->sequence == sequence;
    const bool is_known = is_current && watched->last == image->number;
    if (is_current) watched->last = image->number;
    if (is_known) client = nullptr;
    if (client != nullptr) {
      ++watched->unshown;
      watched->sent = Clock::now();
      ChooseDetail(*watched, client->slow_rate(), image->bytes.size());
    }
  }
  if (client != nullptr) client->SendBytes(MessageOf(*watched, sequence, *image));
  Continue(watched);
}

void PushedViews::ChooseDetail(Watched& watched, double slow_rate, std::size_t bytes) {
  const Clock::time_point now = Clock::now();
  const double aimed =
      slow_rate > 0 ? kImageTime * slow_rate : 4.0 * static_cast<double>(bytes) + 1;
  std::size_t detail = watched.detail;
  if (static_cast<double>(bytes) > aimed) {
    if (detail + 1 == kDetails.size()) return;
    ++detail;
    watched.coarse_for =
        std::clamp<Clock::duration>(2 * watched.coarse_for, kFirstCoarse, kMaxCoarse);
    watched.coarse_until = now + watched.coarse_for;
  } else if (detail > 0 && 4.0 * static_cast<double>(bytes) < aimed &&
             now >= watched.coarse_until) {
    --detail;
    watched.coarse_until = now + kBetweenSteps;
  }
  if (detail == watched.detail) return;
  watched.detail = detail;
  watched.seat = nullptr;  // the next image has another size and needs a new Seat
  watched.last = 0;
}

// Ends the view and sends the client the reason. The client may subscribe to it again.
void PushedViews::Fail(const WatchedPtr& watched, const base::Error& error) {
  std::shared_ptr<Client> client;
  {
    const base::MutexLock lock(mutex_);
    client = watched->client.lock();
  }
  if (client == nullptr) return;
  Remove({client.get(), watched->id});
  client->SendText(SharedBytes(foxglove::ViewFailureText(watched->id, error.Sentence())));
}

SharedBytes PushedViews::MessageOf(const Watched& watched, std::uint32_t sequence,
                                   const DrawnImage& image) {
  const foxglove::BinaryHeader header =
      foxglove::MessageDataHeader(watched.id, base::NanosecondsOf(image.time));
  const auto seen =
      std::chrono::duration_cast<std::chrono::microseconds>(image.seen.time_since_epoch());
  std::string message;
  message.reserve(header.size + kImageHeaderSize + image.bytes.size());
  message.append(reinterpret_cast<const char*>(header.bytes.data()), header.size);
  AppendNumber(sequence, message);
  AppendNumber(image.number, message);
  AppendNumber(static_cast<std::uint64_t>(seen.count()), message);
  message += image.bytes.view();
  return SharedBytes(std::move(message));
}

}  // namespace gsv::gateway::drawing
