// The routes of a gateway that replays a recording.
#include <optional>
#include <utility>

#include "gsv/gateway/access/viewers_api.h"
#include "gsv/gateway/api/replay_api.h"
#include "gsv/gateway/drawing/pushed_views.h"
#include "gsv/gateway/drawing/view_routes.h"
#include "gsv/gateway/http/openapi.h"
#include "gsv/gateway/recordings/recordings_api.h"
#include "gsv/gateway/route_set.h"

namespace gsv::gateway {
namespace {

class ReplayRouteSet final : public RouteSet {
 public:
  ReplayRouteSet(const GatewayOptions& options, ReplayPlayer& player)
      : player_(player), only_recording_(options.only_recording) {
    if (!options.recordings_folder.empty()) {
      recordings_.emplace(options.recordings_folder, options.only_recording, options.replays);
    }
  }

  std::vector<Route> Routes() override {
    const std::shared_ptr<ReplayPlayer> player(std::shared_ptr<void>(), &player_);
    std::vector<Route> routes =
        ReplayRoutes([replay = Replay{player, only_recording_}](const Request&) { return replay; });
    Append(routes, viewers_.Routes());
    if (recordings_) Append(routes, recordings_->Routes(drawer_));
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
    player_.Stop();
    if (recordings_) recordings_->sessions().Stop();
  }

 private:
  base::Result<std::shared_ptr<Hub>> FindHub(const Request& request) {
    if (auto ok = CheckName(request); !ok) return base::Fail(ok.error());
    std::shared_ptr<Hub> hub = player_.hub();
    hub->Offer(std::make_shared<drawing::PushedViews>(drawer_, [this] { return Viewed(); }));
    return hub;
  }

  base::Result<drawing::ViewedWorld> FindViewed(const Request& request) const {
    if (auto ok = CheckName(request); !ok) return base::Fail(ok.error());
    return Viewed();
  }

  base::Result<drawing::ViewedWorld> Viewed() const {
    return drawing::ViewedWorld{player_.name(), player_pointer_, [player = player_pointer_] {
                                  return drawing::MakeReplaySource(player);
                                }};
  }

  base::Status CheckName(const Request& request) const {
    const auto& query = request.target.query;
    const auto name = query.find("simulation");
    if (name == query.end() || name->second == player_.name()) return {};
    return base::Fail(base::ErrorCode::kNotFound, "there is no simulation '" + name->second +
                                                      "'; this is a replay of '" + player_.name() +
                                                      "'");
  }

  ReplayPlayer& player_;
  const std::shared_ptr<ReplayPlayer> player_pointer_{&player_, [](ReplayPlayer*) {}};
  const std::string only_recording_;
  access::ViewersApi viewers_;
  std::optional<recordings::RecordingsApi> recordings_;
  drawing::ViewDrawer drawer_;
};

}  // namespace

std::unique_ptr<RouteSet> MakeReplayRoutes(const GatewayOptions& options, ReplayPlayer& player) {
  return std::make_unique<ReplayRouteSet>(options, player);
}

}  // namespace gsv::gateway
