#include "gsv/sensing/devices/built_in.h"

#include "gsv/base/check.h"
#include "gsv/sensing/devices/altimeter.h"
#include "gsv/sensing/devices/battery.h"
#include "gsv/sensing/devices/bumper.h"
#include "gsv/sensing/devices/force_torque.h"
#include "gsv/sensing/devices/gripper.h"
#include "gsv/sensing/devices/imu.h"
#include "gsv/sensing/devices/joint_encoders.h"
#include "gsv/sensing/devices/lamp.h"
#include "gsv/sensing/devices/lidar.h"
#include "gsv/sensing/devices/logical_camera.h"
#include "gsv/sensing/devices/magnetometer.h"
#include "gsv/sensing/devices/microphone.h"
#include "gsv/sensing/devices/navsat.h"
#include "gsv/sensing/devices/odometer.h"
#include "gsv/sensing/devices/positioning.h"
#include "gsv/sensing/devices/radio.h"
#include "gsv/sensing/devices/ranging.h"
#include "gsv/sensing/devices/sonar.h"
#include "gsv/sensing/devices/speaker.h"

namespace gsv::sensing {

void AddBuiltInSensors(SensorRegistry& registry) {
  for (SensorType (*make)() :
       {SonarType, LidarType, PositioningType, ImuType, OdometerType, NavsatType, MagnetometerType,
        AltimeterType, BumperType, JointEncodersType, BatteryType, LogicalCameraType, RadioType,
        ForceTorqueType, GripperType, LampType, SpeakerType, MicrophoneType, RangingType}) {
    GSV_CHECK(registry.Add(make()));
  }
}

}  // namespace gsv::sensing
