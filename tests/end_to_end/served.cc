#include "tests/end_to_end/served.h"

#include <algorithm>
#include <cstdlib>

#include "gsv/base/sanitizer.h"
#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/orb/orb.h"

namespace gsv::testing {

int Rounds() {
  const char* soak = std::getenv("GSV_SOAK");
  return soak == nullptr ? 1 : std::max(1, std::atoi(soak));
}

base::Result<CORBA::ORB_var> StartOrbWithLongTimeout() {
  orb::OrbOptions options;
  options.call_timeout *= base::kSlowdown;
  return orb::StartOrb(options);
}

void Served::SetUpTestSuite() {
  auto orb = StartOrbWithLongTimeout();
  ASSERT_TRUE(orb);
  orb_ = *orb;
}

void Served::TearDownTestSuite() { orb_->destroy(); }

Served::Served() {
  server_.AwaitLine("broker: ");
  auto client = broker::BrokerClient::Connect(orb_, broker_.reference()).value();
  const auto offers = client.Query(broker::SimulationServiceType().name, "", "first", 1).value();
  service_ = sba::SimulationService::_narrow(offers.front().object);
}

sba::SimulationSpecification Served::Playground(sba::PacingMode pacing) {
  sba::SimulationSpecification specification;
  specification.world = "playground";
  specification.pacing = pacing;
  specification.factor = 1;
  specification.step_ns = 0;
  specification.seed = 7;
  specification.duration_ns = 0;
  specification.keep = true;
  SetOption(specification, "deadline_s", "60");
  return specification;
}

void Served::SetOption(sba::SimulationSpecification& specification, const char* name,
                       const char* value) {
  sba::NameValues& options = specification.options;
  CORBA::ULong i = 0;
  while (i < options.length() && std::string(options[i].name) != name) ++i;
  if (i == options.length()) options.length(i + 1);
  options[i].name = name;
  options[i].value = value;
}

void Served::AddPebble(sba::Simulation_ptr simulation, double x, const std::string& behaviour) {
  sba::RobotSpecification robot;
  robot.model = "pebble";
  robot.start = {x, 0, 0, 0, 0, 0};
  if (!behaviour.empty()) robot.behaviour_constraint = ("name == '" + behaviour + "'").c_str();
  const CORBA::String_var name(simulation->add_robot(robot));
}

void Served::AddFleet(sba::Simulation_ptr simulation) {
  AddPebble(simulation, -1.2, "wander");
  AddPebble(simulation, 0, "wander");
  AddPebble(simulation, 1.2, "follow-wall");
}

void Served::RunTo(sba::Simulation_ptr simulation, double seconds) {
  simulation->run_until(static_cast<CORBA::LongLong>(seconds * 1e9));
  ASSERT_EQ(AwaitRest(simulation), sba::PHASE_PAUSED);
}

sba::SimulationPhase Served::AwaitRest(sba::Simulation_ptr simulation) {
  const auto give_up = std::chrono::steady_clock::now() + kProgramTimeout;
  auto phase = sba::PHASE_RUNNING;
  while ((phase == sba::PHASE_RUNNING || phase == sba::PHASE_STARTING) &&
         std::chrono::steady_clock::now() < give_up) {
    phase = simulation->await_change(phase);
  }
  return phase;
}

std::string Served::HashOf(sba::Simulation_ptr simulation) {
  return std::string(CORBA::String_var(simulation->state_hash()));
}

int Served::CountOf(const sba::SimulationState& state, sba::AgentPhase phase) {
  int count = 0;
  for (CORBA::ULong i = 0; i < state.robots.length(); ++i) count += state.robots[i].phase == phase;
  return count;
}

}  // namespace gsv::testing
