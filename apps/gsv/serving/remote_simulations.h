// Finds the simulations on the servers of brokers, for the command line.
//
// Errors   see broker::BrokerClient.
// Threads  one at a time. The functions start this process's ORB.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/simulation/types.h"
#include "idl/simulation.hh"

namespace gsv::app {

// A server that a broker offers.
struct RemoteServer {
  std::string name;   // such as "gsv run"
  std::string place;  // the process as "host:pid"
  std::string pid;
  std::string viewer_url;  // empty if it has no viewer
  std::string broker;      // the reference of the broker that offers it

  // Returns the name and the place.
  std::string Describe() const { return name + " (" + place + ")"; }
};

// A simulation on a server.
struct FoundSimulation {
  RemoteServer server;
  sba::Simulation_var reference;
  simulation::SimulationStatus status;  // the status at the time of the search
};

// The options by which a command selects a simulation or a server.
struct Selection {
  std::string broker;  // empty for the brokers of this user's running instances, the newest first
  std::string server;  // an offer's name, its pid or "host:pid"; empty for any server
  std::string simulation;  // empty for any simulation
};

// Finds the selected simulations. Adds a sentence to `silent` for each server that does not answer.
// Returns an error if a broker was named and does not answer.
base::Result<std::vector<FoundSimulation>> FindSimulations(const Selection& selection,
                                                           std::vector<std::string>& silent);

// Returns the selected simulation. If nothing is selected, returns the simulation of this user's
// newest instance. Fails if several simulations match.
base::Result<FoundSimulation> FindOneSimulation(const Selection& selection);

// Returns the selected instance, even if it runs no simulation. If nothing is selected, it is
// the first offer at the broker of this user's newest instance.
base::Result<RemoteServer> FindOneInstance(const Selection& selection);

// A server that a broker offers, with its simulations.
struct RemoteInstance {
  RemoteServer server;
  std::vector<simulation::SimulationStatus> simulations;
  std::string problem;  // the reason why the simulations are unknown; empty if they are known
};

// Queries all servers that a broker offers (at most 64) at the same time. Takes a few seconds if
// some servers do not answer. Any thread may call it.
base::Result<std::vector<RemoteInstance>> ListInstances(CORBA::ORB_ptr orb,
                                                        const std::string& broker);

// Returns the error for a selection that no simulation matches. The error has the names of the
// running simulations.
base::Error NoSuchSimulation(const Selection& selection);

// Queries the server for the present status.
base::Result<simulation::SimulationStatus> StatusOf(const FoundSimulation& simulation);

// The health of a robot, as its server reports it.
struct RemoteHealth {
  std::string state, sentence;  // name of the state; a sentence for users
  int level = 0;                // a health::Level as a number
  base::SimTime since{0};       // simulated time since which the state applies
};
// Returns the health of the simulation's robots, by name; empty if the server does not report it.
std::map<std::string, RemoteHealth> HealthOf(const FoundSimulation& simulation);

}  // namespace gsv::app
