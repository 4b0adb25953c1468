#include "gsv/simulation/robots/mounted_sensor.h"

#include <gtest/gtest.h>

#include "gsv/sensing/devices/built_in.h"

namespace gsv::simulation {
namespace {

TEST(SensorDesign, HasTheParametersOfItsPreset) {
  sensing::SensorRegistry types;
  sensing::AddBuiltInSensors(types);
  model::SensorDescription sonar;
  sonar.name = sonar.type = "sonar";
  sonar.parameters = {{"preset", std::string("hc_sr04")}, {"min", 0.1}};
  const auto design = MakeSensorDesign(sonar, types, "robot/sonar");
  ASSERT_TRUE(design) << design.error().Sentence();
  const model::Parameters& parameters = (*design)->description.parameters;
  EXPECT_EQ(model::NumberOr(parameters, "max", 0), 4);
  EXPECT_EQ(model::NumberOr(parameters, "min", 0), 0.1);
}

}  // namespace
}  // namespace gsv::simulation
