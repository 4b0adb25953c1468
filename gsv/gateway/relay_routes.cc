// The routes of a relay. It forwards requests to another gsv, which answers them. The relay also
// checks permissions, with its own tokens.
#include <map>
#include <thread>
#include <utility>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

#include "gsv/base/mutex.h"
#include "gsv/gateway/relayed_images.h"
#include "gsv/gateway/route_set.h"
#include "gsv/gateway/upstream/fetch.h"
#include "gsv/gateway/upstream/relayed_operations.h"
#include "gsv/gateway/upstream/stream.h"

namespace gsv::gateway {
namespace {

constexpr const char* kSocket = "/ws";
constexpr std::size_t kMaxStreams = 64;
constexpr std::chrono::seconds kProbeTime{5};
// Time limit for a request to the other instance. It is long, because a reset waits for behaviours,
// and writing a large model takes long.
constexpr std::chrono::seconds kRequestTime{60};

base::Status Probe(const upstream::Address& address) {
  Request request;
  request.method = "GET";
  request.raw_target = "/api/simulations";
  const base::Result<Response> answer = upstream::Fetch(address, request, kProbeTime);
  if (!answer) return base::Fail(answer.error());
  if (answer->status == 200 && answer->content_type == "application/json") return {};
  return base::Fail(base::ErrorCode::kUnavailable,
                    "this is not a gsv instance that can be relayed: it returns " +
                        std::to_string(answer->status) + " " +
                        std::string(answer->body.view().substr(0, 200)),
                    address.Url());
}

class RelayRoutes final : public RouteSet {
 public:
  RelayRoutes(upstream::Address address, WorkerPool& commanders)
      : address_(std::move(address)), commanders_(commanders), thread_([this] { io_.run(); }) {}

  ~RelayRoutes() override {
    images_.Stop();
    {
      const base::MutexLock lock(mutex_);
      for (const auto& [name, stream] : streams_) stream->Stop();
    }
    work_.reset();
    thread_.join();
  }

  std::vector<Route> Routes() override {
    using enum Permission;
    using enum Pool;
    const Route::Handler forward = [this](const Request& request) {
      base::Result<Response> answer = upstream::Fetch(address_, request, kRequestTime);
      return answer ? *std::move(answer) : ErrorResponse(answer.error());
    };
    // These routes do not check whether another viewer holds control: the other instance does.
    std::vector<Route> routes{
        {"GET", "/api/{path...}", kWatch, false, kReaders, forward},
        {"POST", "/api/{path...}", kControl, false, kCommanders, forward},
        {"PUT", "/api/{path...}", kControl, false, kCommanders, forward},
        {"DELETE", "/api/{path...}", kControl, false, kCommanders, forward},
        {"GET", "/api/recordings", kWatch, false, kReaders, forward},
        {"POST", "/api/recordings/{recording}/replay", kWatch, false, kCommanders, forward},
        {"POST", "/api/simulations/{name}/history", kWatch, false, kCommanders, forward},
        {"GET", "/api/viewers", kWatch, false, kReaders, forward},
        {"POST", "/api/viewers", kWatch, false, kCommanders, forward},
        {"POST", "/api/viewers/me", kWatch, false, kCommanders, forward},
        {"DELETE", "/api/viewers/me", kWatch, false, kCommanders, forward},
        {"POST", "/api/viewers/me/{action}", kControl, false, kCommanders, forward},
        {"POST", "/api/uploads", kControl, false, kCommanders, forward},
        {"PUT", "/api/uploads/{upload}/{path...}", kControl, false, kCommanders, forward},
        {"GET", "/replays/{session}/api/{path...}", kWatch, false, kReaders, forward},
        {"POST", "/replays/{session}/api/{path...}", kWatch, false, kCommanders, forward},
    };
    for (const char* const image :
         {"/view.jpg", "/view.png", "/replays/{session}/view.jpg", "/replays/{session}/view.png"}) {
      routes.push_back({"GET", image, kWatch, false, kReaders,
                        [this](const Request& request) { return ForwardImage(request); }});
      routes.back().accepts_token_in_query = true;
    }
    for (const char* const stream : {"/view.mjpeg", "/replays/{session}/view.mjpeg"}) {
      routes.push_back({"GET", stream, kWatch, false, kReaders, [this](const Request& request) {
                          return images_.Open(request, ImageRequest(request, true));
                        }});
      routes.back().accepts_token_in_query = true;
    }
    for (Route& route : routes) {
      route.summary = "Forwarded";
      route.takes_file = route.pattern.starts_with("/api/uploads/");
    }
    routes.push_back(SocketRoute(
        "/ws", true, [this](const Request& request) { return FindHub(request, kSocket); },
        "Open the live stream of a simulation"));
    routes.push_back(SocketRoute(
        "/replays/{session}/ws", false,
        [this](const Request& request) {
          return FindHub(request, "/replays/" + Escape(request.Parameter("session")) + kSocket);
        },
        "Open the live stream of your replay"));
    return routes;
  }

 private:
  // Returns the request for an image at the other instance, without the client's token, which is
  // valid only for the relay. `is_stream` means that the request is for view.mjpeg.
  static Request ImageRequest(const Request& request, bool is_stream) {
    Request forwarded = request;
    forwarded.raw_target.clear();
    for (const std::string& segment : request.target.segments) {
      const bool is_name = &segment == &request.target.segments.back();
      forwarded.raw_target += "/" + (is_name && is_stream ? "view.jpg" : Escape(segment));
    }
    char separator = '?';
    for (const auto& [name, value] : request.target.query) {
      if (name == "token" || (name == "fps" && is_stream)) continue;
      forwarded.raw_target += separator + Escape(name) + "=" + Escape(value);
      separator = '&';
    }
    return forwarded;
  }

  Response ForwardImage(const Request& request) {
    base::Result<Response> answer =
        upstream::Fetch(address_, ImageRequest(request, false), kRequestTime);
    if (!answer) return ErrorResponse(answer.error());
    answer->allows_other_sites = true;
    return *std::move(answer);
  }

  // Returns the hub for a client. `socket` is the path of the stream at the other instance.
  base::Result<std::shared_ptr<Hub>> FindHub(const Request& request, const std::string& socket) {
    const auto& query = request.target.query;
    const auto found = query.find("simulation");
    const std::string name = found == query.end() ? std::string() : found->second;
    const base::MutexLock lock(mutex_);
    std::erase_if(streams_, [](const auto& entry) { return entry.second->has_ended(); });
    const auto known = streams_.find({socket, name});
    if (known != streams_.end()) return known->second->hub();
    if (streams_.size() >= kMaxStreams) {
      return base::Fail(base::ErrorCode::kUnavailable,
                        "too many simulations are open through this relay; restart it");
    }
    // Viewers control a replay over HTTP, so the stream of a replay has no operations.
    auto operations = socket == kSocket ? std::make_shared<upstream::RelayedOperations>(
                                              address_, name, commanders_)
                                        : nullptr;
    auto stream = upstream::Stream::Make(io_, address_, name, socket, std::move(operations));
    return streams_.emplace(std::pair(socket, name), std::move(stream)).first->second->hub();
  }

  const upstream::Address address_;
  WorkerPool& commanders_;
  boost::asio::io_context io_{1};
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_{
      io_.get_executor()};
  base::Mutex mutex_;
  // Streams by path at the other instance and name of the simulation. An empty name means the first
  // simulation.
  std::map<std::pair<std::string, std::string>, std::shared_ptr<upstream::Stream>> streams_
      GSV_GUARDED_BY(mutex_);
  std::thread thread_;
  RelayedImages images_{io_, address_};
};

}  // namespace

base::Result<std::unique_ptr<RouteSet>> MakeRelayRoutes(const RelayedInstance& there,
                                                        WorkerPool& commanders) {
  base::Result<upstream::Address> address = upstream::ParseAddress(there.url, there.authority);
  if (!address) return base::Fail(address.error());
  address->token = there.token;
  if (base::Status answered = Probe(*address); !answered) return base::Fail(answered.error());
  return std::make_unique<RelayRoutes>(*std::move(address), commanders);
}

}  // namespace gsv::gateway
