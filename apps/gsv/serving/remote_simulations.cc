#include "apps/gsv/serving/remote_simulations.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "apps/gsv/machine/running_instances.h"
#include "gsv/base/spelling.h"
#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/corbaloc.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/orb/errors.h"
#include "gsv/orb/orb.h"
#include "gsv/services/conversions.h"

namespace gsv::app {
namespace {

constexpr std::chrono::milliseconds kBrokerTimeout{3000};
// Longer than other time limits: a server that stops or resets a simulation calls its behaviours,
// and each of these calls may take 10 s.
constexpr std::chrono::milliseconds kCallTimeout{30'000};
constexpr std::size_t kMaxOfferedServers = 1000;
// maximum number of instances that are called at the same time
constexpr std::size_t kMaxInstances = 64;

std::string TextOf(const broker::PropertyList& properties, const char* name) {
  const broker::Value* value = properties.Find(name);
  return value == nullptr ? "" : std::string(value->AsText().value_or(""));
}

RemoteServer ServerFrom(const broker::PropertyList& properties, const std::string& broker) {
  RemoteServer server;
  server.name = TextOf(properties, "name");
  server.viewer_url = TextOf(properties, "viewer_url");
  server.broker = broker;
  if (const broker::Value* pid = properties.Find("pid"); pid != nullptr && pid->AsInteger()) {
    server.pid = std::to_string(*pid->AsInteger());
  }
  server.place = TextOf(properties, "host") + ":" + server.pid;
  return server;
}

bool IsMeant(const Selection& selection, const RemoteServer& server) {
  return selection.server.empty() || selection.server == server.name ||
         selection.server == server.pid || selection.server == server.place;
}

base::Status AddSimulationsOf(const RemoteServer& server, CORBA::Object_ptr object,
                              const Selection& selection, std::vector<FoundSimulation>& found,
                              std::chrono::milliseconds call_timeout = kCallTimeout) {
  orb::LimitCalls(object, kBrokerTimeout);
  return orb::Call(server.Describe(), [&] {
    const sba::SimulationService_var service = sba::SimulationService::_narrow(object);
    if (CORBA::is_nil(service)) throw sba::Failed("the offer is not a SimulationService");
    const sba::Simulations_var simulations = service->list();
    for (CORBA::ULong i = 0; i < simulations->length(); ++i) {
      FoundSimulation simulation;
      simulation.server = server;
      simulation.reference = sba::Simulation::_duplicate(simulations.in()[i]);
      orb::LimitCalls(simulation.reference, call_timeout);
      const sba::SimulationState_var state = simulation.reference->state();
      simulation.status = services::FromIdl(state.in());
      if (selection.simulation.empty() || selection.simulation == simulation.status.name)
        found.push_back(std::move(simulation));
    }
  });
}

base::Status AddSimulationsAt(CORBA::ORB_ptr orb, const std::string& reference,
                              const Selection& selection, std::vector<FoundSimulation>& found,
                              std::vector<std::string>& silent) {
  auto client = broker::BrokerClient::Connect(orb, reference, kBrokerTimeout);
  if (!client) return base::Fail(client.error());
  const auto offers =
      client->Query(broker::SimulationServiceType().name, "", "first", kMaxOfferedServers);
  if (!offers) {
    // The broker does not know the service type, because no simulation was ever offered there.
    if (offers.error().code == base::ErrorCode::kNotFound) return {};
    return base::Fail(offers.error());
  }
  for (const broker::FoundOffer& offer : *offers) {
    const RemoteServer server = ServerFrom(offer.properties, client->reference());
    if (!IsMeant(selection, server)) continue;
    if (auto ok = AddSimulationsOf(server, offer.object, selection, found); !ok)
      silent.push_back(ok.error().Sentence());
  }
  return {};
}

// Returns each broker of this user's instances once. The broker of the newest instance is the
// first.
std::vector<std::string> BrokersOfInstances() {
  std::vector<std::string> brokers;
  for (const Instance& instance : RunningInstances()) {
    if (std::find(brokers.begin(), brokers.end(), instance.broker) == brokers.end())
      brokers.push_back(instance.broker);
  }
  return brokers;
}

const RemoteServer& ServerOf(const RemoteServer& server) { return server; }
const RemoteServer& ServerOf(const FoundSimulation& simulation) { return simulation.server; }

// Keeps the servers or simulations of this user's newest instance that has any of them. If no
// instance of this user has any, all are kept.
template <typename Found>
void KeepThoseOfTheNewestInstance(std::vector<Found>& found) {
  for (const Instance& instance : RunningInstances()) {
    const std::string pid = std::to_string(instance.pid);
    const auto is_elsewhere = [&](const Found& one) { return ServerOf(one).pid != pid; };
    if (std::all_of(found.begin(), found.end(), is_elsewhere)) continue;
    std::erase_if(found, is_elsewhere);
    return;
  }
}

std::string NamesOf(const std::vector<FoundSimulation>& simulations) {
  std::string names;
  for (const FoundSimulation& simulation : simulations) {
    names += (names.empty() ? "" : ", ") + simulation.status.name + " on " +
             simulation.server.Describe();
  }
  return names;
}

}  // namespace

base::Error NoSuchSimulation(const Selection& selection) {
  const std::string where = selection.broker.empty() ? "" : selection.broker;
  Selection all;
  all.broker = selection.broker;
  std::vector<std::string> silent;
  const auto there = FindSimulations(all, silent);
  if (there && !there->empty()) {
    std::vector<std::string> names;
    for (const FoundSimulation& each : *there) names.push_back(each.status.name);
    return {base::ErrorCode::kInvalidArgument,
            std::string("there is no simulation ") +
                (selection.simulation.empty() ? "on this server" : "of this name") +
                "; there are: " + NamesOf(*there) + base::DidYouMean(selection.simulation, names),
            selection.simulation.empty() ? where : selection.simulation};
  }
  if (!silent.empty()) return {base::ErrorCode::kUnavailable, silent.front(), where};
  return {base::ErrorCode::kUnavailable,
          selection.broker.empty() ? "you have no running simulation on this machine; use --broker "
                                     "for simulations of other machines"
                                   : "the broker has no simulations",
          where};
}

base::Result<std::vector<RemoteInstance>> ListInstances(CORBA::ORB_ptr orb,
                                                        const std::string& broker) {
  auto client = broker::BrokerClient::Connect(orb, broker, kBrokerTimeout);
  if (!client) return base::Fail(client.error());
  const auto offers =
      client->Query(broker::SimulationServiceType().name, "", "first", kMaxInstances);
  if (!offers) {
    if (offers.error().code == base::ErrorCode::kNotFound) return std::vector<RemoteInstance>();
    return base::Fail(offers.error());
  }
  std::vector<RemoteInstance> instances(offers->size());
  std::vector<std::jthread> askers;
  for (std::size_t i = 0; i < offers->size(); ++i) {
    askers.emplace_back([&instance = instances[i], &offer = (*offers)[i], &broker] {
      instance.server = ServerFrom(offer.properties, broker);
      std::vector<FoundSimulation> found;
      const auto ok = AddSimulationsOf(instance.server, offer.object, {}, found, kBrokerTimeout);
      if (!ok) instance.problem = ok.error().Sentence();
      for (FoundSimulation& simulation : found)
        instance.simulations.push_back(std::move(simulation.status));
    });
  }
  askers.clear();  // waits for the threads; the calls of each thread have time limits
  return instances;
}

base::Result<std::vector<FoundSimulation>> FindSimulations(const Selection& selection,
                                                           std::vector<std::string>& silent) {
  std::vector<FoundSimulation> found;
  const bool is_named = !selection.broker.empty();
  const auto brokers = is_named ? std::vector<std::string>{selection.broker} : BrokersOfInstances();
  if (brokers.empty()) return found;
  if (auto ok = broker::NormaliseReference(brokers.front()); !ok) return base::Fail(ok.error());
  auto orb = orb::StartOrb({});
  if (!orb) return base::Fail(orb.error());
  for (const std::string& broker : brokers) {
    const auto ok = AddSimulationsAt(*orb, broker, selection, found, silent);
    if (ok) continue;
    if (is_named) return base::Fail(ok.error());
    silent.push_back(ok.error().Sentence());
  }
  return found;
}

base::Result<FoundSimulation> FindOneSimulation(const Selection& selection) {
  std::vector<std::string> silent;
  auto found = FindSimulations(selection, silent);
  if (!found) return base::Fail(found.error());
  if (found->empty()) return base::Fail(NoSuchSimulation(selection));
  const bool is_open =
      selection.broker.empty() && selection.server.empty() && selection.simulation.empty();
  if (is_open) KeepThoseOfTheNewestInstance(*found);
  if (found->size() != 1) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "several simulations match; give one by name, and add --server if several "
                      "have the same name: " +
                          NamesOf(*found));
  }
  return std::move(found->front());
}

base::Result<RemoteServer> FindOneInstance(const Selection& selection) {
  const bool is_named = !selection.broker.empty();
  const auto brokers = is_named ? std::vector<std::string>{selection.broker} : BrokersOfInstances();
  std::vector<RemoteServer> found;
  auto orb = orb::StartOrb({});
  if (!orb) return base::Fail(orb.error());
  for (const std::string& broker : brokers) {
    auto client = broker::BrokerClient::Connect(*orb, broker, kBrokerTimeout);
    const auto offers = client ? client->Query(broker::SimulationServiceType().name, "", "first",
                                               kMaxOfferedServers)
                               : base::Fail(client.error());
    if (!offers && is_named) return base::Fail(offers.error());
    if (!offers) continue;  // the broker's instance may just have ended, so this is no error
    for (const broker::FoundOffer& offer : *offers) {
      RemoteServer server = ServerFrom(offer.properties, client->reference());
      if (IsMeant(selection, server)) found.push_back(std::move(server));
    }
  }
  if (found.empty()) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "there is no such instance; see `gsv ps`, or give its broker with --broker",
                      selection.server);
  }
  if (found.size() > 1 && !selection.server.empty()) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "several instances have this name; give one as HOST:PID", selection.server);
  }
  if (!is_named) KeepThoseOfTheNewestInstance(found);
  return std::move(found.front());
}

base::Result<simulation::SimulationStatus> StatusOf(const FoundSimulation& simulation) {
  return orb::Call(simulation.server.Describe(), [&] {
    const sba::SimulationState_var state = simulation.reference->state();
    return services::FromIdl(state.in());
  });
}

std::map<std::string, RemoteHealth> HealthOf(const FoundSimulation& simulation) {
  std::map<std::string, RemoteHealth> robots;
  // Servers of earlier releases do not know this operation. The result is then empty.
  (void)orb::Call(simulation.server.Describe(), [&] {
    sba::RobotHealths_var list = simulation.reference->health();
    for (CORBA::ULong i = 0; i < list->length(); ++i) {
      const sba::RobotHealth& each = list[i];
      robots[std::string(each.name)] = {std::string(each.state), std::string(each.sentence),
                                        each.level,
                                        base::SimTime(static_cast<std::int64_t>(each.since_ns))};
    }
  });
  return robots;
}

}  // namespace gsv::app
