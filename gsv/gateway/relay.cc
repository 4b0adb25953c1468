#include "gsv/gateway/relay.h"

#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include <boost/asio/executor_work_guard.hpp>

#include "gsv/gateway/http/static_files.h"
#include "gsv/gateway/server/worker_pool.h"
#include "gsv/gateway/upstream/fetch.h"
#include "gsv/gateway/upstream/relayed_operations.h"
#include "gsv/gateway/upstream/stream.h"

namespace gsv::gateway {
namespace {

constexpr std::size_t kMostStreams = 64;
constexpr std::chrono::seconds kProbeTime{5};
// A reset waits for behaviours, a large model is written once.
constexpr std::chrono::seconds kRequestTime{60};

class LocalRelay final : public Relay, private Handler {
 public:
  LocalRelay(const GatewayOptions& options, upstream::Address address)
      : address_(std::move(address)), files_(options.web_root), monitor_({options.version}) {}

  ~LocalRelay() override { Stop(); }

  base::Status Open(ServerOptions options) {
    options.traffic = monitor_.traffic();
    if (base::Status answered = Probe(); !answered) return answered;
    base::Result<std::unique_ptr<Server>> server = Server::Start(options, *this);
    if (!server) return base::Fail(server.error());
    server_ = std::move(*server);
    thread_ = std::thread([this] { io_.run(); });
    return {};
  }

  std::uint16_t port() const override { return server_->port(); }
  std::string url() const override { return server_->url(); }

  void Stop() override {
    readers_.Stop();
    commanders_.Stop();
    if (server_) server_->Stop();
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      for (const auto& [name, stream] : streams_) stream->Stop();
    }
    work_.reset();
    thread_.join();
  }

 private:
  base::Status Probe() const {
    Request request;
    request.method = "GET";
    request.raw_target = "/api/simulations";
    const base::Result<Response> answer = upstream::Fetch(address_, request, kProbeTime);
    if (!answer) return base::Fail(answer.error());
    if (answer->status == 200 && answer->content_type == "application/json") return {};
    return base::Fail(base::ErrorCode::kUnavailable,
                      "this is not a gsv that may be watched: it answers " +
                          std::to_string(answer->status) + " " +
                          std::string(answer->body.view().substr(0, 200)),
                      address_.Url());
  }

  void Handle(Request request, Respond respond) override {
    WorkerPool& workers = request.method == "GET" ? readers_ : commanders_;
    const bool accepted =
        workers.Submit([this, respond, request = std::move(request)] { respond(Answer(request)); });
    if (!accepted) respond(ErrorResponse(503, "the server is busy; try again in a moment"));
  }

  Response Answer(const Request& request) const {
    const std::vector<std::string>& path = request.target.segments;
    if (auto answer = monitor_.Answer(request)) return *std::move(answer);
    if (!path.empty() && (path[0] == "api" || path[0] == "replays")) {
      base::Result<Response> answer = upstream::Fetch(address_, request, kRequestTime);
      return answer ? *answer : ErrorResponse(answer.error());
    }
    if (request.method != "GET") return MethodNotAllowed("GET");
    return files_.Get(request);
  }

  base::Result<std::shared_ptr<Hub>> FindHub(const Target& target) override {
    const auto query = target.query.find("simulation");
    const std::string name = query == target.query.end() ? std::string() : query->second;
    const bool is_replay = target.segments.size() > 1;
    const std::string socket = is_replay ? "/replays/" + Escape(target.segments[1]) + "/ws" : "/ws";
    const std::lock_guard lock(mutex_);
    std::erase_if(streams_, [](const auto& entry) { return entry.second->has_ended(); });
    const auto known = streams_.find({socket, name});
    if (known != streams_.end()) return known->second->hub();
    if (streams_.size() >= kMostStreams) {
      return base::Fail(base::ErrorCode::kUnavailable,
                        "too many simulations are watched through this relay; restart it");
    }
    // A replay of one's own is moved over HTTP.
    auto operations =
        is_replay ? nullptr
                  : std::make_shared<upstream::RelayedOperations>(address_, name, commanders_);
    auto stream = upstream::Stream::Make(io_, address_, name, socket, std::move(operations));
    return streams_.emplace(std::pair(socket, name), std::move(stream)).first->second->hub();
  }

  const upstream::Address address_;
  StaticFiles files_;
  const metrics::Monitor monitor_;
  boost::asio::io_context io_{1};
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_{
      io_.get_executor()};
  std::mutex mutex_;
  // By socket and name; "": the first.
  std::map<std::pair<std::string, std::string>, std::shared_ptr<upstream::Stream>> streams_;
  WorkerPool readers_{4, kWaitingRequests};
  WorkerPool commanders_{2, kWaitingRequests};
  std::unique_ptr<Server> server_;
  std::thread thread_;
};

}  // namespace

base::Result<std::unique_ptr<Relay>> Relay::Start(const GatewayOptions& options,
                                                  const Instance& there) {
  base::Result<upstream::Address> address = upstream::ParseAddress(there.url, there.authority);
  if (!address) return base::Fail(address.error());
  address->token = there.token;
  auto relay = std::make_unique<LocalRelay>(options, std::move(*address));
  if (base::Status opened = relay->Open(static_cast<const ServerOptions&>(options)); !opened)
    return base::Fail(opened.error());
  return relay;
}

}  // namespace gsv::gateway
