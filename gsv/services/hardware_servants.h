// The emulated hardware of one robot as the behaviour's process sees it: sba::Hardware with its
// sensors, base and clocks, over a simulation::Agent.
//
// Threads  ORB threads; all state is the agent's.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "gsv/simulation/agent.h"
#include "idl/hardware.hh"

namespace gsv::services {

// The objects that belong to one robot's hardware. Its owner ends them together; whoever calls them
// afterwards gets OBJECT_NOT_EXIST.
class ServantGroup {
 public:
  explicit ServantGroup(PortableServer::POA_ptr poa);

  // Takes the servant over and gives a reference to it. Raises sba::Ended after DeactivateAll().
  template <typename Interface>
  typename Interface::_ptr_type Activate(PortableServer::ServantBase* servant) {
    const CORBA::Object_var object = Adopt(servant);
    return Interface::_narrow(object);
  }
  void Deactivate(PortableServer::ServantBase* servant);
  void DeactivateAll();

 private:
  CORBA::Object_ptr Adopt(PortableServer::ServantBase* servant);
  void DeactivateId(const std::string& id);

  PortableServer::POA_var poa_;
  std::mutex mutex_;
  std::set<std::string> ids_;  // object ids, as bytes
  bool closed_ = false;
};

// The servant of one sensor; which one depends on its type.
using SensorServantMaker =
    PortableServer::ServantBase* (*)(std::shared_ptr<simulation::Agent> agent,
                                     model::SensorDescription description,
                                     std::shared_ptr<ServantGroup> group);

// Types with an interface of their own; a type that is not listed is served as a plain sba::Sensor.
class SensorServants {
 public:
  static void Register(const std::string& type, SensorServantMaker maker);
  static SensorServantMaker For(const std::string& type);
};

// A reference to new hardware for `agent`, one more object of the group.
sba::Hardware_ptr ActivateHardware(std::shared_ptr<simulation::Agent> agent,
                                   std::shared_ptr<ServantGroup> group);

}  // namespace gsv::services
