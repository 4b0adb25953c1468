#include "gsv/gateway/live/live_operations.h"

#include <algorithm>
#include <utility>

#include "gsv/simulation/commands/command_table.h"

namespace gsv::gateway {
namespace {

using simulation::Simulation;

constexpr const char* kFactor = "/gsv/real_time_factor";
constexpr const char* kFormerFactor = "/gsv/factor";  // deprecated name of the real-time factor

base::Result<std::string> Gone() {
  return base::Fail(base::ErrorCode::kEnded, "the simulation was removed");
}

// Starts or stops the recording, and returns its path.
base::Result<std::string> Record(const std::shared_ptr<Simulation>& simulation,
                                 RecordingSwitch& recordings, bool begins) {
  const std::string& name = simulation->specification().name;
  const base::Status done = begins ? recordings.Record(simulation) : recordings.StopRecording(name);
  if (!done) return base::Fail(done.error());
  return recordings.RecordingOf(name).path;
}

std::vector<CommandServices::Service> ServicesOf(const std::weak_ptr<Simulation>& simulation,
                                                 RecordingSwitch* recordings) {
  std::vector<CommandServices::Service> services;
  for (const simulation::Command& command : simulation::CommandsWithFormerNames()) {
    services.push_back(
        {command, [simulation, apply = command.apply](const simulation::Arguments& arguments) {
           const auto locked = simulation.lock();
           return locked ? NoMessage(apply(*locked, arguments)) : Gone();
         }});
  }
  if (recordings == nullptr) return services;
  for (const bool begins : {true, false}) {
    services.push_back({{.name = begins ? "start_recording" : "stop_recording"},
                        [simulation, recordings, begins](const simulation::Arguments&) {
                          const auto locked = simulation.lock();
                          return locked ? Record(locked, *recordings, begins) : Gone();
                        }});
  }
  return services;
}

std::vector<foxglove::Parameter> ParametersOf(const Simulation& simulation) {
  const simulation::Specification& specification = simulation.specification();
  return {{"/gsv/name", specification.name},
          {"/gsv/world", specification.world->name},
          {"/gsv/mode", std::string(ToString(specification.mode))},
          // The seed is a text, because a JSON number may not have enough digits.
          {"/gsv/seed", std::to_string(specification.seed)},
          {"/gsv/duration_s", base::ToSeconds(specification.duration)},
          {"/gsv/step_size_s",
           base::ToSeconds(specification.step.count() > 0 ? specification.step
                                                          : specification.world->max_step_size)}};
}

}  // namespace

LiveOperations::LiveOperations(const std::shared_ptr<Simulation>& simulation, WorkerPool& workers,
                               RecordingSwitch* recordings)
    : simulation_(simulation),
      workers_(workers),
      recordings_(recordings),
      services_(ServicesOf(simulation, recordings)),
      fixed_(ParametersOf(*simulation)) {}

void LiveOperations::Call(const foxglove::ServiceCall& call, Answer answer) {
  auto command = services_.Prepare(call);
  if (!command) return answer(base::Fail(command.error()));
  const bool is_accepted = workers_.Submit([run = *std::move(command), answer] { answer(run()); });
  if (!is_accepted) {
    answer(base::Fail(base::ErrorCode::kUnavailable, "the server is busy; try again in a moment"));
  }
}

std::vector<foxglove::Parameter> LiveOperations::parameters() const {
  std::vector<foxglove::Parameter> parameters = fixed_;
  if (const auto simulation = simulation_.lock()) {
    const simulation::Phase phase = simulation->WaitForPhase({}, std::chrono::milliseconds(0));
    parameters.push_back({"/gsv/phase", std::string(ToString(phase))});
    const auto snapshot = simulation->snapshot();
    parameters.push_back({"/gsv/gravity_z_m_s2", snapshot->layout->description->gravity.z});
    parameters.push_back({kFactor, simulation->real_time_factor()});
    parameters.push_back({kFormerFactor, simulation->real_time_factor()});
    if (recordings_ != nullptr) {
      const std::string& name = simulation->specification().name;
      parameters.push_back({"/gsv/recording", recordings_->RecordingOf(name).is_recording});
    }
  }
  return parameters;
}

base::Status LiveOperations::Set(const foxglove::Parameter& parameter) {
  if (parameter.name == kFactor || parameter.name == kFormerFactor) {
    return SetRealTimeFactor(parameter.value);
  }
  const std::vector<foxglove::Parameter> all = parameters();
  const bool is_known = std::any_of(all.begin(), all.end(),
                                    [&](const auto& each) { return each.name == parameter.name; });
  const std::string name = "'" + parameter.name.substr(0, 100) + "'";
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    is_known
                        ? "the parameter " + name + " cannot be changed while a simulation runs"
                        : "there is no parameter " + name);
}

base::Status LiveOperations::SetRealTimeFactor(const foxglove::ParameterValue& value) {
  const auto* factor = std::get_if<double>(&value);
  if (factor == nullptr) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the parameter '/gsv/real_time_factor' must be a number");
  }
  const auto simulation = simulation_.lock();
  return simulation ? simulation->SetRealTimeFactor(*factor) : base::Fail(Gone().error());
}

}  // namespace gsv::gateway
