// Finds the simulations on the servers of brokers, for the command line.
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
  std::string broker;      // the broker that offers it

  std::string Describe() const { return name + " (" + place + ")"; }
};

struct FoundSimulation {
  RemoteServer server;
  sba::Simulation_var reference;
  simulation::SimulationStatus status;  // at the time of the search
};

// Selects simulations.
struct Selection {
  std::string broker;      // empty: the brokers of this user's running instances, the newest first
  std::string server;      // empty: any; else an offer's name, its pid or "host:pid"
  std::string simulation;  // empty: any
};

// Adds a sentence to `silent` for each server that does not answer. A broker that does not answer
// is an error if it was named.
base::Result<std::vector<FoundSimulation>> FindSimulations(const Selection& selection,
                                                           std::vector<std::string>& silent);

// The selected simulation. Without a selection: that of the newest instance.
base::Result<FoundSimulation> FindOneSimulation(const Selection& selection);

// The selected instance, whether it runs a simulation or not. Without a selection: this user's
// newest.
base::Result<RemoteServer> FindOneInstance(const Selection& selection);

// A server that a broker offers, and its simulations.
struct RemoteInstance {
  RemoteServer server;
  std::vector<simulation::SimulationStatus> simulations;
  std::string problem;  // why they are not known; empty: no problem
};

// Queries all servers that a broker offers, at most 64, at the same time. Takes a few seconds if
// some do not answer. Any thread.
base::Result<std::vector<RemoteInstance>> ListInstances(CORBA::ORB_ptr orb,
                                                        const std::string& broker);

base::Result<simulation::SimulationStatus> StatusOf(const FoundSimulation& simulation);

}  // namespace gsv::app
