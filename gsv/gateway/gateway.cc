#include "gsv/gateway/gateway.h"

#include <optional>
#include <utility>

#include "gsv/gateway/http/static_files.h"
#include "gsv/gateway/route_set.h"
#include "gsv/gateway/server/worker_pool.h"

namespace gsv::gateway {
namespace {

constexpr std::size_t kReaderThreads = 2, kCommanderThreads = 2;
// A relay has more threads, because they wait for the responses of the other instance.
constexpr std::size_t kRelayReaderThreads = 4;

class LocalGateway final : public Gateway, private Handler {
 public:
  LocalGateway(const GatewayOptions& options, metrics::MetricsSources sources,
               std::size_t readers = kReaderThreads)
      : files_(options.web_root),
        documentation_(options.docs_root),
        monitor_(WithDrawnViews(std::move(sources))),
        readers_(readers, kWaitingRequests) {}

  ~LocalGateway() override { Stop(); }

  WorkerPool& commanders() { return commanders_; }

  base::Status Open(ServerOptions options, std::unique_ptr<RouteSet> set) {
    set_ = std::move(set);
    std::vector<Route> routes = set_->Routes();
    Append(routes, monitor_.Routes());
    Append(routes, documentation_.Routes());
    Append(routes, files_.Routes());
    router_.emplace(std::move(routes));
    options.traffic = monitor_.traffic();
    base::Result<std::unique_ptr<Server>> server = Server::Start(options, *this);
    if (!server) return base::Fail(server.error());
    server_ = std::move(*server);
    return {};
  }

  const Router& router() const override { return *router_; }
  std::uint16_t port() const override { return server_->port(); }
  std::string url() const override { return server_->url(); }

  void Stop() override {
    if (set_) set_->Stop();
    readers_.Stop();
    commanders_.Stop();
    if (server_) server_->Stop();
  }

 private:
  void Handle(const Route& route, Request request, Respond respond) override {
    if (route.later) return route.later(request, respond);
    WorkerPool& workers = route.pool == Pool::kReaders ? readers_ : commanders_;
    const bool is_accepted = workers.Submit(
        [&route, respond, request = std::move(request)] { respond(route.handler(request)); });
    if (!is_accepted) respond(ErrorResponse(503, "the server is busy; try again in a moment"));
  }

  metrics::MetricsSources WithDrawnViews(metrics::MetricsSources sources) {
    sources.drawn_views = [this] { return set_->drawn_views(); };
    return sources;
  }

  base::Status CheckControl(const std::string& viewer, const std::string& simulation) override {
    return set_->CheckControl(viewer, simulation);
  }

  // A member may use the members above it. So the order matters: members are destroyed from the
  // last to the first. Their threads have ended before, in Stop().
  const StaticFiles files_;
  const Documentation documentation_;
  const metrics::Monitor monitor_;
  WorkerPool readers_;
  WorkerPool commanders_{kCommanderThreads, kWaitingRequests};
  std::unique_ptr<RouteSet> set_;
  std::optional<Router> router_;
  std::unique_ptr<Server> server_;
};

base::Result<std::unique_ptr<Gateway>> Opened(std::unique_ptr<LocalGateway> gateway,
                                              const ServerOptions& options,
                                              std::unique_ptr<RouteSet> set) {
  if (base::Status opened = gateway->Open(options, std::move(set)); !opened) {
    return base::Fail(opened.error());
  }
  return gateway;
}

}  // namespace

base::Result<std::unique_ptr<Gateway>> Gateway::Start(
    const GatewayOptions& options, std::shared_ptr<SimulationDirectory> directory) {
  auto gateway = std::make_unique<LocalGateway>(
      options, metrics::MetricsSources{options.version, directory.get(), options.recordings,
                                       options.broker_calls});
  auto set = MakeLiveRoutes(options, std::move(directory), gateway->commanders());
  return Opened(std::move(gateway), options, std::move(set));
}

base::Result<std::unique_ptr<Gateway>> Gateway::StartReplay(const GatewayOptions& options,
                                                            ReplayPlayer& player) {
  auto gateway = std::make_unique<LocalGateway>(options, metrics::MetricsSources{options.version});
  return Opened(std::move(gateway), options, MakeReplayRoutes(options, player));
}

base::Result<std::unique_ptr<Gateway>> Gateway::StartRelay(const GatewayOptions& options,
                                                           const RelayedInstance& there) {
  auto gateway = std::make_unique<LocalGateway>(options, metrics::MetricsSources{options.version},
                                                kRelayReaderThreads);
  auto set = MakeRelayRoutes(there, gateway->commanders());
  if (!set) return base::Fail(set.error());
  return Opened(std::move(gateway), options, *std::move(set));
}

}  // namespace gsv::gateway
