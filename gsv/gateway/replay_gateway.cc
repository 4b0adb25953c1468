#include "gsv/gateway/replay_gateway.h"

#include <optional>
#include <utility>

#include "gsv/gateway/access/viewers_api.h"
#include "gsv/gateway/api/replay_api.h"
#include "gsv/gateway/http/static_files.h"
#include "gsv/gateway/recordings/recordings_api.h"
#include "gsv/gateway/server/worker_pool.h"

namespace gsv::gateway {
namespace {

class LocalReplayGateway final : public ReplayGateway, private Handler {
 public:
  LocalReplayGateway(const GatewayOptions& options, ReplayPlayer& player)
      : player_(player),
        files_(options.web_root),
        api_(player, options.only_recording),
        monitor_({options.version}) {
    if (!options.recordings_folder.empty()) {
      replays_.emplace(options.recordings_folder, options.only_recording, options.replays);
    }
  }

  ~LocalReplayGateway() override { Stop(); }

  base::Status Open(ServerOptions options) {
    options.traffic = monitor_.traffic();
    base::Result<std::unique_ptr<Server>> server = Server::Start(options, *this);
    if (!server) return base::Fail(server.error());
    server_ = std::move(*server);
    return {};
  }

  std::uint16_t port() const override { return server_->port(); }
  std::string url() const override { return server_->url(); }

  void Stop() override {
    player_.Stop();
    workers_.Stop();
    if (replays_) replays_->sessions().Stop();
    if (server_) server_->Stop();
  }

 private:
  void Handle(Request request, Respond respond) override {
    const bool accepted = workers_.Submit(
        [this, respond, request = std::move(request)] { respond(Answer(request)); });
    if (!accepted) respond(ErrorResponse(503, "the server is busy; try again in a moment"));
  }

  Response Answer(const Request& request) {
    const std::vector<std::string>& path = request.target.segments;
    if (auto answer = monitor_.Answer(request)) return *std::move(answer);
    if (path.size() > 1 && path[0] == "api" && path[1] == "viewers")
      return viewers_.Handle(request);
    if (replays_ && path.size() > 1 && path[0] == "api" && path[1] == "recordings") {
      return replays_->Handle(request);
    }
    if (!path.empty() && path[0] == "api") return api_.Handle(request);
    if (replays_ && recordings::IsOfReplaySession(request.target)) {
      return replays_->sessions().Handle(request);
    }
    if (request.method != "GET") return MethodNotAllowed("GET");
    if (path == std::vector<std::string>{"ws"}) {
      return ErrorResponse(426, "this address is for WebSockets that speak foxglove.sdk.v1");
    }
    return files_.Get(request);
  }

  base::Status MayAct(const std::string& viewer, const std::string& simulation) override {
    return viewers_.MayAct(viewer, simulation);
  }

  base::Result<std::shared_ptr<Hub>> FindHub(const Target& target) override {
    if (replays_ && recordings::IsOfReplaySession(target)) {
      return replays_->sessions().FindHub(target);
    }
    const auto name = target.query.find("simulation");
    if (name == target.query.end() || name->second == player_.name()) return player_.hub();
    return base::Fail(base::ErrorCode::kNotFound, "there is no simulation '" + name->second +
                                                      "'; this is a replay of '" + player_.name() +
                                                      "'");
  }

  ReplayPlayer& player_;
  StaticFiles files_;
  ReplayApi api_;
  access::ViewersApi viewers_;
  std::optional<recordings::RecordingsApi> replays_;
  const metrics::Monitor monitor_;
  WorkerPool workers_{2, kWaitingRequests};
  std::unique_ptr<Server> server_;
};

}  // namespace

base::Result<std::unique_ptr<ReplayGateway>> ReplayGateway::Start(const GatewayOptions& options,
                                                                  ReplayPlayer& player) {
  auto gateway = std::make_unique<LocalReplayGateway>(options, player);
  if (base::Status opened = gateway->Open(static_cast<const ServerOptions&>(options)); !opened)
    return base::Fail(opened.error());
  return gateway;
}

}  // namespace gsv::gateway
