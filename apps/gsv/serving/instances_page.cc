#include "apps/gsv/serving/instances_page.h"

#include <nlohmann/json.hpp>

#include "apps/gsv/serving/remote_simulations.h"

namespace gsv::app {
namespace {

nlohmann::ordered_json ToJson(const RemoteInstance& instance, const std::string& here) {
  nlohmann::ordered_json simulations = nlohmann::ordered_json::array();
  for (const simulation::SimulationStatus& status : instance.simulations) {
    simulations.push_back({{"name", status.name},
                           {"phase", ToString(status.phase)},
                           {"mode", ToString(status.mode)},
                           {"time_s", base::ToSeconds(status.time)},
                           {"real_time_factor", status.real_time_factor},
                           {"robots", status.robots.size()}});
  }
  return {{"name", instance.server.name},
          {"place", instance.server.place},
          {"viewer_url", instance.server.viewer_url},
          {"is_here", instance.server.place == here},
          {"problem", instance.problem},
          {"simulations", std::move(simulations)}};
}

}  // namespace

gateway::Response InstancesPage::Handle(const gateway::Request& request) {
  if (request.method != "GET") return gateway::MethodNotAllowed("GET");
  if (request.target.segments.size() != 2) {
    return gateway::ErrorResponse(404, "there is nothing below /api/instances");
  }
  if (!asking_.try_lock()) {
    const base::MutexLock lock(mutex_);
    if (has_asked_) return last_;
    return gateway::ErrorResponse(503, "the others are being asked; try again in a moment");
  }
  const base::MutexLock asking(asking_, std::adopt_lock);
  gateway::Response answer = Ask();
  const base::MutexLock lock(mutex_);
  has_asked_ = true;
  last_ = answer;
  return answer;
}

gateway::Response InstancesPage::Ask() const {
  const auto instances = ListInstances(orb_, broker_);
  if (!instances) return gateway::ErrorResponse(instances.error());
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const RemoteInstance& instance : *instances) list.push_back(ToJson(instance, place_));
  const nlohmann::ordered_json json{{"broker", broker_}, {"instances", std::move(list)}};
  return gateway::JsonResponse(
      200, json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace gsv::app
