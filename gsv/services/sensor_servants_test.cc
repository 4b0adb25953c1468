#include "gsv/services/sensor_servants.h"

#include <gtest/gtest.h>

#include "idl/actuators.hh"

namespace gsv::services {
namespace {

template <typename Skeleton>
bool ServesAs(const std::string& type, bool takes_commands) {
  const SensorServantMaker make = SensorServants::For(type, takes_commands);
  const PortableServer::ServantBase_var servant(make(nullptr, model::SensorDescription(), nullptr));
  return dynamic_cast<Skeleton*>(servant.in()) != nullptr;
}

TEST(SensorServants, ServesATypeWithoutAnInterfaceAsASensorOrAnActuator) {
  EXPECT_TRUE(ServesAs<POA_sba::Sensor>("thermometer", false));
  EXPECT_FALSE(ServesAs<POA_sba::Actuator>("thermometer", false));
  EXPECT_TRUE(ServesAs<POA_sba::Actuator>("horn", true));
}

TEST(SensorServants, ServesATypeWithAnInterfaceThroughThatInterface) {
  EXPECT_TRUE(ServesAs<POA_sba::Lamp>("lamp", true));
}

}  // namespace
}  // namespace gsv::services
