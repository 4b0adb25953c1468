#include "gsv/gateway/gateway.h"

#include <optional>
#include <utility>

#include "gsv/formats/gltf/gltf_writer.h"
#include "gsv/gateway/access/viewers_api.h"
#include "gsv/gateway/api/api.h"
#include "gsv/gateway/http/static_files.h"
#include "gsv/gateway/live/publisher.h"
#include "gsv/gateway/recordings/recordings_api.h"
#include "gsv/gateway/server/worker_pool.h"
#include "gsv/gateway/uploads/uploads_api.h"

namespace gsv::gateway {
namespace {

constexpr std::size_t kWaitingReadings = 64;

// Who is there and who holds control is told at once, whatever else is under way.
bool IsOfViewers(const Target& target) {
  return target.segments.size() > 1 && target.segments[0] == "api" &&
         target.segments[1] == "viewers";
}

class LocalGateway final : public Gateway, private Handler {
 public:
  LocalGateway(const GatewayOptions& options, std::shared_ptr<SimulationDirectory> directory)
      : directory_(directory),
        files_(options.web_root),
        api_(directory, &formats::WriteGlb, options.recordings, options.factory,
             !options.recordings_folder.empty(),
             [this](const auto& simulation, const std::string& robot) {
               publisher_.WantSensorsOf(simulation, robot);
             }),
        pages_(options.pages),
        takes_uploads_(options.factory != nullptr),
        uploads_(options.uploads),
        monitor_({options.version, directory.get(), options.recordings, options.broker_calls}),
        publisher_(std::move(directory), watchers_, commanders_, options.recordings,
                   &viewers_.desk()) {
    if (!options.recordings_folder.empty()) {
      replays_.emplace(options.recordings_folder, options.only_recording, options.replays);
    }
  }

  ~LocalGateway() override { Stop(); }

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
    publisher_.Stop();
    watchers_.Stop();
    readers_.Stop();
    commanders_.Stop();
    if (replays_) replays_->sessions().Stop();
    if (server_) server_->Stop();
  }

 private:
  void Handle(Request request, Respond respond) override {
    // What commands may block (a reset calls behaviours), and must not hold up those who look.
    const bool only_looks = request.method == "GET" || request.raw_target == "/api/preview" ||
                            recordings::IsOfReplaySession(request.target) ||
                            IsOfViewers(request.target);
    WorkerPool& workers = only_looks ? readers_ : commanders_;
    const bool accepted =
        workers.Submit([this, respond, request = std::move(request)] { respond(Answer(request)); });
    if (!accepted) respond(ErrorResponse(503, "the server is busy; try again in a moment"));
  }

  Response Answer(const Request& request) {
    const std::vector<std::string>& path = request.target.segments;
    if (auto answer = monitor_.Answer(request)) return *std::move(answer);
    if (path.size() > 1 && path[0] == "api") {
      if (const auto page = pages_.find(path[1]); page != pages_.end())
        return page->second(request);
    }
    if (IsOfViewers(request.target)) return viewers_.Handle(request);
    if (takes_uploads_ && path.size() > 1 && path[0] == "api" && path[1] == "uploads") {
      return uploads_.Handle(request);
    }
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
    std::shared_ptr<simulation::Simulation> simulation;
    if (name != target.query.end()) {
      simulation = directory_->Find(name->second);
    } else if (const auto all = directory_->List(); !all.empty()) {
      simulation = all.front();
    }
    if (simulation) return publisher_.HubOf(simulation);
    return base::Fail(base::ErrorCode::kNotFound,
                      name != target.query.end()
                          ? "there is no simulation '" + name->second + "'"
                          : "there is no simulation yet; create one, then connect again");
  }

  // In the order in which the threads may start; Stop() ends them in the opposite sense.
  const std::shared_ptr<SimulationDirectory> directory_;
  StaticFiles files_;
  Api api_;
  access::ViewersApi viewers_;
  std::optional<recordings::RecordingsApi> replays_;
  const std::map<std::string, std::function<Response(const Request&)>> pages_;
  const bool takes_uploads_;
  uploads::UploadsApi uploads_;
  const metrics::Monitor monitor_;
  WorkerPool readers_{2, kWaitingRequests};
  WorkerPool commanders_{2, kWaitingRequests};
  WorkerPool watchers_{2, kWaitingReadings};
  Publisher publisher_;
  std::unique_ptr<Server> server_;
};

}  // namespace

base::Result<std::unique_ptr<Gateway>> Gateway::Start(
    const GatewayOptions& options, std::shared_ptr<SimulationDirectory> directory) {
  auto gateway = std::make_unique<LocalGateway>(options, std::move(directory));
  if (base::Status opened = gateway->Open(static_cast<const ServerOptions&>(options)); !opened)
    return base::Fail(opened.error());
  return gateway;
}

}  // namespace gsv::gateway
