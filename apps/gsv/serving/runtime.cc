#include "apps/gsv/serving/runtime.h"

#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <thread>

#include <fmt/format.h>

#include "apps/gsv/lost/lost_page.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/serving/broker_page.h"
#include "apps/gsv/serving/instances_page.h"
#include "apps/gsv/simulations/recordings.h"
#include "apps/gsv/simulations/simulation_builder.h"
#include "gsv/base/host_name.h"
#include "gsv/base/log.h"
#include "gsv/broker/client/client_errors.h"
#include "gsv/broker/client/corbaloc.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/broker/transport/message_check.h"
#include "gsv/orb/orb.h"
#include "gsv/rendering/renderer.h"
#include "gsv/scenario/scenario.h"

namespace gsv::app {
namespace {

// Starting a broker takes 0.1 s, but must also succeed on a very busy machine.
constexpr std::chrono::seconds kBrokerStartTimeout{60};
// Time limit for behaviour programs to end after EndSoon().
constexpr std::chrono::milliseconds kHurriedPrograms{500};

std::vector<broker::Property> WithLoad(std::vector<broker::Property> properties,
                                       services::ServerLoad& load) {
  std::ranges::move(load.Properties(), std::back_inserter(properties));
  return properties;
}

class HostDirectory final : public gateway::SimulationDirectory {
 public:
  explicit HostDirectory(std::shared_ptr<services::SimulationHost> host) : host_(std::move(host)) {}
  std::vector<std::shared_ptr<simulation::Simulation>> List() override { return host_->List(); }
  std::shared_ptr<simulation::Simulation> Find(const std::string& name) override {
    return host_->Find(name);
  }

 private:
  const std::shared_ptr<services::SimulationHost> host_;
};

}  // namespace

base::Result<std::unique_ptr<Runtime>> Runtime::Start(const RuntimeOptions& options) {
  std::unique_ptr<Runtime> runtime(new Runtime);
  auto renderer = rendering::Renderer::Start();
  if (!renderer) spdlog::warn("no cameras: {}", renderer.error().Sentence());
  auto sensors = MakeSensorTypes(options.sensors, std::move(renderer));
  if (!sensors) return base::Fail(sensors.error());
  if (options.has_broker) {
    if (auto ok = runtime->StartBroker(options); !ok) return base::Fail(ok.error());
  }
  auto library = options.library;
  if (library == nullptr) {
    formats::ReadOptions reading;
    reading.model_path = options.model_path;
    reading.drives = options.drives;
    reading.limits = options.limits;
    reading.check_sensor = CheckBy(*sensors);
    library = std::make_shared<formats::ModelLibrary>(std::move(reading));
  }
  simulation::ProcessLimits() = options.server_limits.simulation;
  runtime->host_ = std::make_shared<services::SimulationHost>(
      *std::move(sensors), std::move(library), options.server_limits.simulations);
  auto folder = RecordingsFolder(options.web.recordings);
  if (!folder) return base::Fail(folder.error());
  runtime->recordings_ = std::make_unique<Recordings>(*std::move(folder));
  if (!options.noted_as.empty()) {
    runtime->lost_ = std::make_unique<LostSimulations>(
        LostSimulations::Server{options.noted_as, runtime->broker_->reference(),
                                runtime->recordings_->folder()},
        *runtime->host_, *runtime->recordings_);
  }
  if (!options.has_broker) return runtime;
  const PortableServer::POA_var poa = orb::RootPoa(runtime->orb_);
  runtime->behaviours_ = std::make_unique<services::BrokerBehaviours>(*runtime->broker_, poa);
  runtime->launcher_ = std::make_unique<BehaviourLauncher>(
      *runtime->broker_, [host = runtime->host_] { return host->List(); });
  runtime->builder_ = std::make_unique<SimulationBuilder>(
      *runtime->host_, *runtime->behaviours_, *runtime->broker_, *runtime->recordings_,
      options.model_path, options.server_limits.reading);
  auto access = Ros2Access::Start(options.ros2, *runtime->builder_, runtime->host_->library(),
                                  [host = runtime->host_] { return host->List(); });
  if (!access) return base::Fail(access.error());
  runtime->ros2_ = *std::move(access);
  runtime->builder_->PublishThrough(runtime->ros2_.get());
  if (options.viewer) {
    if (auto ok = runtime->StartGateway(options); !ok) return base::Fail(ok.error());
  }
  return runtime;
}

base::Status Runtime::StartBroker(const RuntimeOptions& options) {
  std::string reference = options.broker;
  if (reference.empty()) {
    auto child = ChildProcess::Start({ProgramPath(), "broker", "--port", "0", "--memory",
                                      "--exit-with-parent", std::to_string(getpid())},
                                     false);
    if (!child) return base::Fail(child.error());
    broker_process_ = *std::move(child);
    const auto line = broker_process_->ReadLine(kBrokerStartTimeout);
    if (!line) {
      const std::string ending = broker_process_->Ending();
      return base::Fail(base::ErrorCode::kUnavailable,
                        fmt::format("the embedded broker did not start: {}",
                                    ending.empty() ? fmt::format("it did not respond for {} s",
                                                                 kBrokerStartTimeout.count())
                                                   : ending));
    }
    reference = *line;
  }
  auto normalised = broker::NormaliseReference(reference);
  if (!normalised) return base::Fail(normalised.error());
  orb::OrbOptions orb_options;
  orb_options.local_socket = true;
  // Checks calls of evalDP, with which brokers request this server's load. Invalid arguments are
  // removed before they can crash omniORB.
  orb_options.check_request = &broker::CheckRequest;
  if (const std::string host = broker::HostOf(*normalised); !host.empty()) {
    auto local = orb::LocalAddressTowards(host);
    if (!local) return base::Fail(local.error());
    orb_options.host = *local;
  }
  auto orb = orb::StartOrb(orb_options);
  if (!orb) return base::Fail(orb.error());
  orb_ = *orb;
  auto client = broker::BrokerClient::Connect(orb_, *normalised);
  if (!client) return base::Fail(client.error());
  broker_ = std::make_unique<broker::BrokerClient>(*std::move(client));
  return {};
}

base::Status Runtime::StartGateway(const RuntimeOptions& options) {
  gateway::GatewayOptions gateway;
  gateway.web_root = ShareFolder() / "web";
  gateway.docs_root = ShareFolder() / "docs";
  gateway.broker_calls = [] {
    const broker::CallCounts& counts = broker::ProcessCallCounts();
    return gateway::metrics::BrokerCalls{counts.made, counts.failed};
  };
  gateway.routes = BrokerRoutes(orb_, broker_->reference());
  Append(gateway.routes, InstancesRoutes(orb_, broker_->reference(),
                                         base::HostName() + ":" + std::to_string(getpid())));
  if (lost_ != nullptr) Append(gateway.routes, LostRoutes(*lost_));
  gateway.limits = options.server_limits.web;
  gateway.uploads = options.server_limits.uploads;
  gateway.replays = options.server_limits.replays;
  gateway.recordings = recordings_.get();
  gateway.recordings_folder = recordings_->folder();
  gateway.history_bytes = static_cast<std::size_t>(options.web.history_mib) << 20;
  gateway.factory = builder_.get();
  auto directory = std::make_shared<HostDirectory>(host_);
  auto started = StartViewer(options.web, gateway, [&](const auto& there) {
    return gateway::Gateway::Start(there, directory);
  });
  if (!started) return base::Fail(started.error());
  gateway_ = *std::move(started);
  viewer_url_ = gateway_->url();
  return {};
}

services::ServiceHooks Runtime::Hooks() {
  services::ServiceHooks hooks;
  hooks.find_world = [](const std::string& world) {
    return FindWorld(world.empty() ? scenario::DefaultScenario().world : world);
  };
  hooks.viewer_url = [this](const std::string& simulation) {
    return viewer_url_.empty() ? "" : viewer_url_ + "?simulation=" + simulation;
  };
  hooks.start_recording = [this](std::shared_ptr<simulation::Simulation> simulation,
                                 const std::string& path) {
    return recordings_->Start(std::move(simulation), path);
  };
  hooks.stop_recording = [this](const std::string& simulation) {
    return recordings_->Stop(simulation);
  };
  return hooks;
}

base::Status Runtime::OfferService(const std::string& name, int scenarios) {
  const PortableServer::POA_var poa = orb::RootPoa(orb_);
  if (scenarios > 0) scenarios_ = new ScenarioServiceServant(poa, scenarios);
  load_ = new services::ServerLoad(
      *host_, [this] { return scenarios_.in() == nullptr ? 0 : scenarios_->running(); });
  const PortableServer::ObjectId_var load_id = poa->activate_object(load_);
  service_ = new services::SimulationServiceServant(poa, *host_, behaviours_.get(), Hooks());
  for (const auto& simulation : host_->List()) service_->Publish(simulation);
  builder_->OfferThrough(service_);
  const PortableServer::ObjectId_var id = poa->activate_object(service_);
  const CORBA::Object_var reference = poa->id_to_reference(id);
  if (auto ok = broker_->EnsureServiceType(broker::SimulationServiceType()); !ok) return ok;
  broker::SimulationServiceOffer offer;
  offer.name = name;
  offer.host = base::HostName();
  offer.pid = static_cast<std::int32_t>(getpid());
  offer.viewer_url = viewer_url_;
  offer.cores = static_cast<std::int32_t>(std::thread::hardware_concurrency());
  auto exported = broker_->Export(broker::SimulationServiceType().name, reference,
                                  WithLoad(PropertiesOf(offer), *load_));
  if (!exported) return base::Fail(exported.error());
  offers_.push_back(*exported);
  if (scenarios > 0) {
    if (auto ok = OfferScenarios(name, scenarios); !ok) return ok;
  }
  if (auto record = InstanceRecord::Write(broker_->reference())) {
    record_ = *std::move(record);
  } else {
    spdlog::warn("`gsv ps` will need --broker: {}", record.error().Sentence());
  }
  return {};
}

base::Status Runtime::OfferScenarios(const std::string& name, int scenarios) {
  const PortableServer::POA_var poa = orb::RootPoa(orb_);
  const PortableServer::ObjectId_var id = poa->activate_object(scenarios_);
  const CORBA::Object_var reference = poa->id_to_reference(id);
  const broker::ServiceType& type = broker::ScenarioServiceType();
  if (auto ok = broker_->EnsureServiceType(type); !ok) return ok;
  broker::ScenarioServiceOffer offer;
  offer.name = name;
  offer.host = base::HostName();
  offer.pid = static_cast<std::int32_t>(getpid());
  offer.slots = scenarios;
  offer.cores = static_cast<std::int32_t>(std::thread::hardware_concurrency());
  auto exported = broker_->Export(type.name, reference, WithLoad(PropertiesOf(offer), *load_));
  if (!exported) return base::Fail(exported.error());
  offers_.push_back(*exported);
  return {};
}

void Runtime::EndSoon() {
  if (behaviours_ != nullptr) behaviours_->stop_timeout()->Shorten();
  if (launcher_ != nullptr) launcher_->SetEndTimeout(kHurriedPrograms);
}

Runtime::~Runtime() {
  record_.reset();
  // a call may fail, because the broker may have ended
  for (const std::string& offer : offers_) (void)broker_->Withdraw(offer);
  if (scenarios_.in() != nullptr) scenarios_->Close();
  gateway_.reset();
  if (builder_ != nullptr) builder_->PublishThrough(nullptr);
  ros2_.reset();
  builder_.reset();
  if (host_ != nullptr) {
    for (const auto& simulation : host_->List()) (void)simulation->Stop();
  }
  if (recordings_ != nullptr) {
    if (const auto ok = recordings_->StopAll(); !ok) spdlog::error("{}", ok.error().Sentence());
  }
  lost_.reset();  // from here on no simulation is reported as lost
  if (service_.in() != nullptr) service_->Close();
  if (host_ != nullptr) {
    // Ending a simulation calls its behaviours, so this happens before their programs end.
    for (const auto& simulation : host_->List())
      (void)host_->Remove(simulation->specification().name);
  }
  launcher_.reset();
  if (!CORBA::is_nil(orb_)) {
    orb_->shutdown(true);
    service_ = nullptr;
    scenarios_ = nullptr;
    load_ = nullptr;
    orb_->destroy();
  }
}

}  // namespace gsv::app
