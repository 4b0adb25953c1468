// The simulations that run on the servers of some brokers, found for the command line.
//
// Errors   see broker::BrokerClient.
// Threads  one at a time. Starts this process's ORB.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/simulation/types.h"
#include "idl/simulation.hh"

namespace gsv::app {

struct RemoteServer {
  std::string name;   // "gsv run"
  std::string place;  // "host:pid"
  std::string pid;
  std::string viewer_url;  // empty: none
  std::string broker;      // where it is offered

  std::string Describe() const { return name + " (" + place + ")"; }
};

struct FoundSimulation {
  RemoteServer server;
  sba::Simulation_var reference;
  simulation::SimulationStatus status;  // as it was when it was found
};

// Which simulations are meant.
struct Selection {
  std::string broker;      // empty: those of this user's running instances, the newest first
  std::string server;      // empty: any; else an offer's name, its pid or "host:pid"
  std::string simulation;  // empty: any
};

// Servers that do not answer are told in `silent`, a sentence each. A broker that does not answer
// is an error when it was named.
base::Result<std::vector<FoundSimulation>> FindSimulations(const Selection& selection,
                                                           std::vector<std::string>& silent);

// The one that is meant. When nothing narrows the choice: that of the newest instance.
base::Result<FoundSimulation> FindOneSimulation(const Selection& selection);

// The instance that is meant, whether or not it runs a simulation. When nothing narrows the choice:
// the newest of this user's.
base::Result<RemoteServer> FindOneInstance(const Selection& selection);

// A server that a broker knows, and what runs there.
struct RemoteInstance {
  RemoteServer server;
  std::vector<simulation::SimulationStatus> simulations;
  std::string problem;  // why nothing is known of them; empty: all is well
};

// Asks all servers that are offered at a broker, at most 64, at the same time. Takes a few seconds
// where some do not answer. May be called from any thread.
base::Result<std::vector<RemoteInstance>> ListInstances(CORBA::ORB_ptr orb,
                                                        const std::string& broker);

base::Result<simulation::SimulationStatus> StatusOf(const FoundSimulation& simulation);

}  // namespace gsv::app
