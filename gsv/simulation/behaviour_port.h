// The interface through which a simulation calls a behaviour. Higher layers implement it for
// behaviours in this process and, by CORBA, for behaviours in other processes.
//
// Threads  calls for one behaviour come one after the other, from dedicated threads of the
//          simulation. The stepping thread never calls a behaviour, and no lock is held during a
//          call.
// Errors   every call ends within a time limit that the implementation sets.
#pragma once

#include <memory>
#include <string>

#include "gsv/base/error.h"

namespace gsv::simulation {

class Agent;
class LocalBehaviour;

// The interface through which the simulation calls one robot's behaviour.
class BehaviourPort {
 public:
  virtual ~BehaviourPort() = default;

  // Initialises the behaviour with the agent of its robot. The behaviour may open sensors in this
  // call.
  virtual base::Status Init(const std::shared_ptr<Agent>& agent) = 0;
  // Starts the behaviour at the start of the run.
  virtual base::Status Start() = 0;
  // Ends the behaviour at the end of the run.
  virtual base::Status Stop() = 0;
  // Notifies the behaviour that the run is paused.
  virtual base::Status Pause() = 0;
  // Notifies the behaviour that the run is resumed.
  virtual base::Status Resume() = 0;
  // Destroys the behaviour.
  virtual void Destroy() = 0;

  // Whether the behaviour is certainly dead: its process has ended, or its host refuses the
  // connection. An unresponsive behaviour is not dead. The check may take as long as a call.
  virtual bool IsDead() = 0;

  // Whether the behaviour uses only the simulation's clock. Otherwise the simulation never waits
  // for it.
  virtual bool time_managed() const = 0;
  // The name of the behaviour's service, such as "wander".
  virtual const std::string& name() const = 0;
  // The process in which the behaviour runs, as "HOST:PID".
  virtual const std::string& place() const = 0;
  // The local behaviour, if the simulation runs it in turns (see local_behaviour.h), else null.
  virtual LocalBehaviour* local() { return nullptr; }
};

}  // namespace gsv::simulation
