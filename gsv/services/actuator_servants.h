// The CORBA servants of actuators: sensor servants that also accept commands.
//
// Threads  ORB threads.
#pragma once

#include "gsv/services/sensor_servants.h"
#include "idl/actuators.hh"

namespace gsv::services {

// The base of all actuator servants. `Skeleton` is the generated class of the interface.
template <typename Skeleton>
class ActuatorServant : public SensorServant<Skeleton> {
 public:
  using SensorServant<Skeleton>::SensorServant;

  void act(const sba::Doubles& values, const char* word) override {
    const double* const begin = values.get_buffer();
    CommandDevice({std::vector<double>(begin, begin + values.length()), word});
  }

 protected:
  // Commands the actuator. If this fails, throws an exception of `raises` (bits of orb::Raises: the
  // exceptions that the IDL operation declares).
  void CommandDevice(world::DeviceCommand command, unsigned raises = orb::kAll) {
    orb::ValueOrThrow(this->agent().CommandDevice(this->description().name, std::move(command)),
                      raises);
  }
};

// Functions that make the servants. SensorServants registers them.
PortableServer::ServantBase* MakeLampServant(std::shared_ptr<simulation::Agent> agent,
                                             model::SensorDescription description,
                                             std::shared_ptr<ServantGroup> group);
PortableServer::ServantBase* MakeGripperServant(std::shared_ptr<simulation::Agent> agent,
                                                model::SensorDescription description,
                                                std::shared_ptr<ServantGroup> group);
PortableServer::ServantBase* MakeSpeakerServant(std::shared_ptr<simulation::Agent> agent,
                                                model::SensorDescription description,
                                                std::shared_ptr<ServantGroup> group);

}  // namespace gsv::services
