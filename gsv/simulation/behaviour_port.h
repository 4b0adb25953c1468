// How a simulation reaches a behaviour, wherever that runs: in another process through CORBA, or in
// this one. Implemented above this layer.
//
// Threads  calls for one behaviour come one after the other, from threads of the simulation that
//          do nothing else; never from the stepping thread, never under a lock.
// Errors   every call ends within the implementation's own time limit.
#pragma once

#include <memory>
#include <string>

#include "gsv/base/error.h"

namespace gsv::simulation {

class Agent;
class LocalBehaviour;

class BehaviourPort {
 public:
  virtual ~BehaviourPort() = default;

  // Hands the behaviour its name and hardware. It may open sensors before it returns.
  virtual base::Status Init(const std::shared_ptr<Agent>& agent) = 0;
  virtual base::Status Start() = 0;
  virtual base::Status Stop() = 0;
  virtual base::Status Pause() = 0;
  virtual base::Status Resume() = 0;
  // The behaviour is not needed any more.
  virtual void Destroy() = 0;

  // Whether it is certainly dead: its process has ended, its host refuses the connection. A
  // behaviour that merely does not answer is not dead. May take as long as a call.
  virtual bool IsDead() = 0;

  // Whether it tells the time by its simulation's clock (else it is never waited for).
  virtual bool time_managed() const = 0;
  // Its service's name: "wander".
  virtual const std::string& name() const = 0;
  // Where it runs: "host:pid".
  virtual const std::string& place() const = 0;
  // Itself, where the simulation is to run it, see local_behaviour.h.
  virtual LocalBehaviour* local() { return nullptr; }
};

}  // namespace gsv::simulation
