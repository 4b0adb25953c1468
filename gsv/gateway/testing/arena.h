// For tests: the models of ScriptedSimulation's world, made of boxes and cylinders.
#pragma once

#include <memory>

#include "gsv/model/world_description.h"
#include "gsv/sensing/registry.h"

namespace gsv::gateway::testing {

model::Model FloorModel();
model::Model CrateModel();  // a cube of 1 m on the ground
// A robot with two driven wheels (continuous joints), sonars ahead and left, lidar, camera.
model::Model RobotModel();
model::WorldDescription ArenaDescription();

// A sensor of the type "camera" whose image is a gradient, encoded as JPEG.
sensing::SensorType GradientCameraType();

}  // namespace gsv::gateway::testing
