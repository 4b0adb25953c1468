// For tests: a server of simulations in a separate process, with a broker. It is called through the
// stubs of our IDL.
#pragma once

#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "gsv/base/error.h"
#include "idl/simulation.hh"
#include "tests/support/programs.h"

namespace gsv::testing {

// The number of repetitions of a case: one in `make test`, and the value of GSV_SOAK in `make
// soak`.
int Rounds();

// Returns the process's ORB. Its calls have the timeout that a build with a sanitizer needs.
base::Result<CORBA::ORB_var> StartOrbWithLongTimeout();

// The test fixture that starts the broker and the server.
class Served : public ::testing::Test {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite();
  Served();

  // Describes the playground with the fleet's seed, without an end, and with a deadline of 60 s.
  // The simulation continues after its creator has disconnected.
  static sba::SimulationSpecification Playground(sba::PacingMode pacing);
  static void SetOption(sba::SimulationSpecification& specification, const char* name,
                        const char* value);
  // Adds a pebble at (x, 0). `behaviour` is the name of an offer, or empty.
  static void AddPebble(sba::Simulation_ptr simulation, double x, const std::string& behaviour);
  // Adds the robots of FleetRun().
  static void AddFleet(sba::Simulation_ptr simulation);

  static void RunTo(sba::Simulation_ptr simulation, double seconds);
  static sba::SimulationPhase AwaitRest(sba::Simulation_ptr simulation);
  // Queries the state until `holds` returns true.
  template <typename Condition>
  static void AwaitState(sba::Simulation_ptr simulation, Condition holds) {
    const auto give_up = std::chrono::steady_clock::now() + kProgramTimeout;
    while (std::chrono::steady_clock::now() < give_up) {
      const sba::SimulationState_var state = simulation->state();
      if (holds(state.in())) return;
    }
    FAIL() << "it never came to that";
  }
  static std::string HashOf(sba::Simulation_ptr simulation);
  // Returns the number of robots whose behaviour is in that phase.
  static int CountOf(const sba::SimulationState& state, sba::AgentPhase phase);

  static inline CORBA::ORB_var orb_;
  const BrokerProcess broker_;
  Running server_{"gsv", {"serve", "--broker", broker_.reference(), "--headless"}};
  sba::SimulationService_var service_;
};

}  // namespace gsv::testing
