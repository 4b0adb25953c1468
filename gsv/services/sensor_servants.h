// The CORBA servants of sensors. To give a sensor type its own IDL interface, derive a class from
// SensorServant and register it with one line. A plug-in can do this as well (docs/sensors.md).
//
// Threads  ORB threads; Register() before the first simulation.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "gsv/orb/errors.h"
#include "gsv/readings/catalogue.h"
#include "gsv/services/conversions.h"
#include "gsv/services/servant_group.h"
#include "gsv/simulation/agent.h"

namespace gsv::services {

// The base of all sensor servants. `Skeleton` is the generated class of the interface.
template <typename Skeleton>
class SensorServant : public Skeleton {
 public:
  SensorServant(std::shared_ptr<simulation::Agent> agent, model::SensorDescription description,
                std::shared_ptr<ServantGroup> group)
      : agent_(std::move(agent)), description_(std::move(description)), group_(std::move(group)) {}

  sba::SensorTraits* traits() override {
    return new sba::SensorTraits(ToIdl(description_, agent_->RobotFromLink(description_.link)));
  }
  sba::Measurement* measure() override {
    return new sba::Measurement(ToIdl(description_.name, Read()));
  }
  void close() override {
    (void)agent_->CloseSensor(description_.name);  // has no effect if the sensor is closed
    group_->Deactivate(this);
  }

 protected:
  // Reads the sensor. Throws the exceptions that the IDL declares for sensors.
  sensing::Reading Read() { return orb::ValueOrThrow(agent_->Read(description_.name), kReading); }
  // Reads the sensor as the struct of its type (gsv/readings/catalogue.h). The struct may contain
  // references into the reading, so keep the reading as long as the struct.
  template <typename Values>
  Values In(const sensing::Reading& reading) const {
    return orb::ValueOrThrow(sensing::ValuesOf<Values>(reading, description_.name), kReading);
  }
  const model::SensorDescription& description() const { return description_; }
  simulation::Agent& agent() { return *agent_; }

 private:
  // The exceptions that the IDL declares for readings.
  static constexpr unsigned kReading = orb::kNotRunning | orb::kEnded | orb::kFailed;

  const std::shared_ptr<simulation::Agent> agent_;
  const model::SensorDescription description_;
  const std::shared_ptr<ServantGroup> group_;  // the hardware objects of the robot
};

// Makes the servant of one sensor.
using SensorServantMaker =
    PortableServer::ServantBase* (*)(std::shared_ptr<simulation::Agent> agent,
                                     model::SensorDescription description,
                                     std::shared_ptr<ServantGroup> group);

template <typename Servant>
PortableServer::ServantBase* MakeSensorServant(std::shared_ptr<simulation::Agent> agent,
                                               model::SensorDescription description,
                                               std::shared_ptr<ServantGroup> group) {
  return new Servant(std::move(agent), std::move(description), std::move(group));
}

// The sensor types that have their own IDL interface. Sensors of other types are served as
// sba::Sensor, or as sba::Actuator if they accept commands.
class SensorServants {
 public:
  // Sets the maker for a sensor type.
  static void Register(const std::string& type, SensorServantMaker maker);
  // Returns the maker for a sensor type. For types without an own interface, `takes_commands`
  // selects between sba::Actuator and sba::Sensor.
  static SensorServantMaker For(const std::string& type, bool takes_commands);
};

}  // namespace gsv::services
