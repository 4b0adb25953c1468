// A server of simulations in a process of its own, with a broker, called through our IDL's stubs.
#pragma once

#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "gsv/base/error.h"
#include "idl/simulation.hh"
#include "tests/support/programs.h"

namespace gsv::testing {

// How often a case is run: once in make test, GSV_SOAK times in make soak.
int Rounds();

// The process's ORB, whose calls wait as long as a build with a sanitizer may take.
base::Result<CORBA::ORB_var> StartOrbWithLongTimeout();

class Served : public ::testing::Test {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite();
  Served();

  // The playground, kept, with the fleet's seed and without end. Deadline: 60 s.
  static sba::SimulationSpecification Playground(sba::PacingMode pacing);
  static void SetOption(sba::SimulationSpecification& specification, const char* name,
                        const char* value);
  // A pebble at (x, 0); `behaviour` is an offer's name, or empty.
  static void AddPebble(sba::Simulation_ptr simulation, double x, const std::string& behaviour);
  // The robots of FleetRun().
  static void AddFleet(sba::Simulation_ptr simulation);

  static void RunTo(sba::Simulation_ptr simulation, double seconds);
  static sba::SimulationPhase AwaitRest(sba::Simulation_ptr simulation);
  // Asks until `holds` does.
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
  // How many robots' behaviours are in that phase.
  static int CountOf(const sba::SimulationState& state, sba::AgentPhase phase);

  static inline CORBA::ORB_var orb_;
  const BrokerProcess broker_;
  Running server_{"gsv", {"serve", "--broker", broker_.reference(), "--headless"}};
  sba::SimulationService_var service_;
};

}  // namespace gsv::testing
