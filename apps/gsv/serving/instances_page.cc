#include "apps/gsv/serving/instances_page.h"

#include <memory>
#include <mutex>
#include <utility>

#include <nlohmann/json.hpp>

#include "apps/gsv/serving/remote_simulations.h"
#include "gsv/base/mutex.h"

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
                           {"robots", status.CountRobots()}});
  }
  return {{"name", instance.server.name},
          {"place", instance.server.place},
          {"viewer_url", instance.server.viewer_url},
          {"is_here", instance.server.place == here},
          {"problem", instance.problem},
          {"simulations", std::move(simulations)}};
}

class InstancesPage {
 public:
  InstancesPage(CORBA::ORB_ptr orb, std::string broker, std::string place)
      : orb_(CORBA::ORB::_duplicate(orb)), broker_(std::move(broker)), place_(std::move(place)) {}

  gateway::Response Get();

 private:
  gateway::Response Ask() const;

  const CORBA::ORB_var orb_;
  const std::string broker_, place_;
  base::Mutex asking_;
  base::Mutex mutex_;
  gateway::Response last_ GSV_GUARDED_BY(mutex_);
  bool has_asked_ GSV_GUARDED_BY(mutex_) = false;
};

gateway::Response InstancesPage::Get() {
  if (!asking_.try_lock()) {
    const base::MutexLock lock(mutex_);
    if (has_asked_) return last_;
    return gateway::ErrorResponse(503, "a search for instances is running; try again in a moment");
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

}  // namespace

std::vector<gateway::Route> InstancesRoutes(CORBA::ORB_ptr orb, const std::string& broker,
                                            const std::string& place) {
  const auto page = std::make_shared<InstancesPage>(orb, broker, place);
  return {{"GET", "/api/instances", gateway::Permission::kWatch, false, gateway::Pool::kReaders,
           [page](const gateway::Request&) { return page->Get(); },
           "List the gsv instances of the broker, and their simulations"}};
}

}  // namespace gsv::app
