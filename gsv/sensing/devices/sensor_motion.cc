#include "gsv/sensing/devices/sensor_motion.h"

#include "gsv/sensing/devices/link_motion.h"

namespace gsv::sensing {

SensorMotion MotionOf(const Sampling& sampling, const model::SensorDescription& description) {
  LinkMotion motion = MotionOfLink(*sampling.snapshot(), sampling.body(), description.link);
  const geometry::Pose world_from_sensor = sampling.WorldFromSensor(description);
  motion.MoveTo(world_from_sensor.position);
  return {world_from_sensor, motion.velocity, motion.angular_velocity, motion.acceleration};
}

}  // namespace gsv::sensing
