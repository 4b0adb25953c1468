// A behaviour in another process, called through sba::AgentBehaviour.
//
// Threads  as simulation::BehaviourPort.
#pragma once

#include <memory>
#include <string>

#include "gsv/base/mutex.h"
#include "gsv/services/hardware_servants.h"
#include "gsv/services/stop_timeout.h"
#include "gsv/simulation/behaviour_port.h"
#include "idl/behaviour.hh"

namespace gsv::services {

// The properties of a behaviour that its offer states.
struct BehaviourIdentity {
  std::string name;          // name of the behaviour's service, such as "wander"
  std::string place;         // "host:pid"
  bool time_managed = true;  // whether it uses only the simulation's clock
};

class RemoteBehaviour final : public simulation::BehaviourPort {
 public:
  // The robot's hardware objects are activated on `poa`. If `stop_timeout` is null, the normal
  // limit applies.
  RemoteBehaviour(sba::AgentBehaviour_ptr behaviour, BehaviourIdentity identity,
                  PortableServer::POA_ptr poa,
                  std::shared_ptr<const StopTimeout> stop_timeout = nullptr);
  ~RemoteBehaviour() override;

  base::Status Init(const std::shared_ptr<simulation::Agent>& agent) override;
  base::Status Start() override;
  base::Status Stop() override;
  base::Status Pause() override;
  base::Status Resume() override;
  void Destroy() override;
  bool IsDead() override;

  bool time_managed() const override { return identity_.time_managed; }
  const std::string& name() const override { return identity_.name; }
  const std::string& place() const override { return identity_.place; }

 private:
  // Makes a remote call. Errors name the behaviour and the operation.
  template <typename Function>
  base::Status Call(const char* operation, Function call) const;
  // Deactivates the hardware objects of the previous run, and stores the new hardware objects (or
  // null).
  void ReplaceHardware(std::shared_ptr<ServantGroup> hardware);

  const BehaviourIdentity identity_;
  sba::AgentBehaviour_var behaviour_;
  PortableServer::POA_var poa_;
  const std::shared_ptr<const StopTimeout> stop_timeout_;
  bool has_not_stopped_ = false;  // whether the last call of stop() failed
  base::Mutex mutex_;
  // The robot's hardware objects; null before Init().
  std::shared_ptr<ServantGroup> hardware_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::services
