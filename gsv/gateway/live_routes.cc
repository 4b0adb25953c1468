// The routes of the simulations of this program.
#include <optional>
#include <utility>

#include "gsv/formats/gltf/gltf_writer.h"
#include "gsv/gateway/access/viewers_api.h"
#include "gsv/gateway/api/api.h"
#include "gsv/gateway/drawing/pushed_views.h"
#include "gsv/gateway/drawing/view_routes.h"
#include "gsv/gateway/history/history_api.h"
#include "gsv/gateway/http/openapi.h"
#include "gsv/gateway/live/publisher.h"
#include "gsv/gateway/recordings/recordings_api.h"
#include "gsv/gateway/route_set.h"
#include "gsv/gateway/uploads/uploads_api.h"

namespace gsv::gateway {
namespace {

constexpr std::size_t kWaitingReadings = 64;

class LiveRoutes final : public RouteSet {
 public:
  LiveRoutes(const GatewayOptions& options, std::shared_ptr<SimulationDirectory> directory,
             WorkerPool& commanders)
      : more_routes_(options.routes),
        directory_(directory),
        api_(directory, &formats::WriteGlb, options.recordings, options.factory,
             !options.recordings_folder.empty(),
             [this](const auto& simulation, const std::string& robot) {
               publisher_.WantSensorsOf(simulation, robot);
             }),
        publisher_(std::move(directory), watchers_, commanders, options.recordings,
                   &viewers_.registry()) {
    if (options.factory != nullptr) uploads_.emplace(options.uploads);
    if (!options.recordings_folder.empty()) {
      recordings_.emplace(options.recordings_folder, options.only_recording, options.replays);
    }
    if (recordings_ && options.history_bytes > 0) {
      histories_.emplace(directory_, options.history_bytes, [this](const auto& simulation) {
        return publisher_.IsWatched(simulation);
      });
    }
    history_.emplace(directory_, histories_ ? &*histories_ : nullptr,
                     recordings_ ? &recordings_->sessions() : nullptr, api_.models());
  }

  std::vector<Route> Routes() override {
    std::vector<Route> routes = api_.Routes();
    Append(routes, viewers_.Routes());
    Append(routes, history_->Routes());
    if (uploads_) Append(routes, uploads_->Routes());
    if (recordings_) Append(routes, recordings_->Routes(drawer_));
    Append(routes, more_routes_);
    Append(routes, drawing::ViewRoutes("", drawer_, [this](const Request& request) {
             return FindViewed(request);
           }));
    routes.push_back(OpenApiRoute());
    routes.push_back(SocketRoute(
        "/ws", true, [this](const Request& request) { return FindHub(request); },
        "Open the live stream of a simulation"));
    return routes;
  }

  base::Status CheckControl(const std::string& viewer, const std::string& simulation) override {
    return viewers_.CheckControl(viewer, simulation);
  }

  std::optional<metrics::DrawnViews> drawn_views() override { return drawer_.Counts(); }

  void Stop() override {
    drawer_.Stop();
    if (histories_) histories_->Stop();
    publisher_.Stop();
    watchers_.Stop();
    if (recordings_) recordings_->sessions().Stop();
  }

 private:
  base::Result<std::shared_ptr<simulation::Simulation>> FindSimulation(const Request& request) {
    const auto& query = request.target.query;
    const auto name = query.find("simulation");
    std::shared_ptr<simulation::Simulation> simulation;
    if (name != query.end()) {
      simulation = directory_->Find(name->second);
    } else if (const auto all = directory_->List(); !all.empty()) {
      simulation = all.front();
    }
    if (simulation) return simulation;
    return base::Fail(base::ErrorCode::kNotFound,
                      name != query.end()
                          ? "there is no simulation '" + name->second + "'"
                          : "there is no simulation yet; create one, then connect again");
  }

  base::Result<std::shared_ptr<Hub>> FindHub(const Request& request) {
    const auto simulation = FindSimulation(request);
    if (!simulation) return base::Fail(simulation.error());
    std::shared_ptr<Hub> hub = publisher_.HubOf(*simulation);
    hub->Offer(std::make_shared<drawing::PushedViews>(
        drawer_, [weak = std::weak_ptr(*simulation)] { return ViewedOf(weak.lock()); }));
    return hub;
  }

  base::Result<drawing::ViewedWorld> FindViewed(const Request& request) {
    const auto found = FindSimulation(request);
    if (!found) return base::Fail(found.error());
    return ViewedOf(*found);
  }

  static base::Result<drawing::ViewedWorld> ViewedOf(
      const std::shared_ptr<simulation::Simulation>& simulation) {
    if (simulation == nullptr) {
      return base::Fail(base::ErrorCode::kEnded, "the simulation has been removed");
    }
    return drawing::ViewedWorld{simulation->specification().name, simulation,
                                [simulation] { return drawing::MakeLiveSource(simulation); }};
  }

  const std::vector<Route> more_routes_;
  const std::shared_ptr<SimulationDirectory> directory_;
  Api api_;
  access::ViewersApi viewers_;
  std::optional<recordings::RecordingsApi> recordings_;
  std::optional<uploads::UploadsApi> uploads_;
  WorkerPool watchers_{2, kWaitingReadings};
  Publisher publisher_;
  std::optional<history::Histories> histories_;
  std::optional<history::HistoryApi> history_;
  drawing::ViewDrawer drawer_;
};

}  // namespace

std::unique_ptr<RouteSet> MakeLiveRoutes(const GatewayOptions& options,
                                         std::shared_ptr<SimulationDirectory> directory,
                                         WorkerPool& commanders) {
  return std::make_unique<LiveRoutes>(options, std::move(directory), commanders);
}

}  // namespace gsv::gateway
