// Plugins that GSV supports, or that it does not need.
#include "gsv/formats/support/element_tables.h"

namespace gsv::formats {

// clang-format off
const std::string_view kKnownPlugins = R"table(
+ diffdrive; a differential drive
+ skidsteerdrive; a differential drive
+ ackermannsteering; an Ackermann drive
+ ackermanndrive; an Ackermann drive
+ mecanumdrive; a mecanum drive
+ velocitycontrol; an omnidirectional base
+ planarmove; an omnidirectional base
+ synchrodrive; a synchro drive
+ trackedvehicle; a differential drive that holds the base
. trackcontroller; the drive of a tracked vehicle moves its base
+ jointpositioncontroller; the target and the gains of a joint
+ jointcontroller; the target and the gains of a joint
+ jointcontrolplugin; the targets and the gains of joints
- lookupwheelslip; the slip of a wheel does not depend on its place
+ wheelslip; the slip of wheels
- systems::buoyancyengine; nothing changes what a body displaces
+ systems::buoyancy; fluids that lift bodies
+ buoyancysystem; fluids that lift bodies
+ systems::windeffects; the wind
+ windeffectssystem; the wind
+ windplugin; the wind
+ systems::thermal; the temperature of a visual
. physicssystem; GSV moves the world itself
. systems::physics; GSV moves the world itself
. usercommands; the viewer and the services edit the world
. scenebroadcaster; the viewer shows the world
. sensorssystem; GSV samples every sensor
. systems::sensors; GSV samples every sensor
. cpulidar; GSV samples every sensor
. imusystem; GSV samples every sensor
. systems::imu; GSV samples every sensor
. contactsystem; GSV samples every sensor
. systems::contact; GSV samples every sensor
. touchplugin; GSV samples every sensor
. altimetersystem; GSV samples every sensor
. systems::altimeter; GSV samples every sensor
. magnetometersystem; GSV samples every sensor
. systems::magnetometer; GSV samples every sensor
. navsatsystem; GSV samples every sensor
. systems::navsat; GSV samples every sensor
. airpressuresystem; GSV samples every sensor
. forcetorquesystem; GSV samples every sensor
. systems::forcetorque; GSV samples every sensor
. logicalcamerasystem; GSV samples every sensor
. systems::logicalcamera; GSV samples every sensor
. thermalsensor; GSV samples every sensor
. jointstatepublisher; GSV publishes the state of every joint
. odometrypublisher; GSV publishes the odometry of every robot
. posepublisher; GSV publishes the pose of everything
. gazeborosraysensor; GSV publishes every sensor
. gazeboroslaser; GSV publishes every sensor
. gazeborosgpulaser; GSV publishes every sensor
. gazeborosblocklaser; GSV publishes every sensor
. gazeboroscamera; GSV publishes every sensor
. gazeborosdepthcamera; GSV publishes every sensor
. gazeborosmulticamera; GSV publishes every sensor
. gazeborosopenni; GSV publishes every sensor
. gazeborosimu; GSV publishes every sensor
. gazeborosgps; GSV publishes every sensor
. gazeborosbumper; GSV publishes every sensor
. gazeborosrange; GSV publishes every sensor
. gazeborosp3d; GSV publishes the pose of everything
. gazeborosjointstate; GSV publishes the state of every joint
. gazeborosinit; GSV answers ROS itself
. gazeborosfactory; GSV answers ROS itself
. gazeborosstate; GSV answers ROS itself
. gazeborosapi; GSV answers ROS itself
. rayplugin; GSV samples every sensor
. gpurayplugin; GSV samples every sensor
. cameraplugin; GSV samples every sensor
. contactplugin; GSV samples every sensor
. imusensorplugin; GSV samples every sensor
)table";
// clang-format on

}  // namespace gsv::formats
