#include "sdk/behaviour/actuators.h"

namespace gsv {

Lamp::Glow Lamp::Look() {
  const std::vector<double>& v = Measure().values;
  return v.size() == 4 ? Glow{v[0], {v[1], v[2], v[3]}} : Glow{};
}

Gripper::Jaws Gripper::Feel() {
  const Reading& reading = Measure();
  if (reading.values.size() != 2 || reading.labels.empty()) return {};
  return {reading.values[0], reading.values[1] != 0, reading.labels.front()};
}

Speaker::Sound Speaker::Playing() {
  const Reading& reading = Measure();
  const std::vector<double>& v = reading.values;
  if (v.size() != 4 || reading.labels.empty()) return {};
  return {reading.labels.front(), v[0], v[1], v[2], v[3]};
}

Microphone::Hearing Microphone::Listen() {
  const Reading& reading = Measure();
  if (reading.values.size() != 2 || reading.labels.empty()) return {};
  return {reading.values[0], reading.values[1], reading.labels.front()};
}

}  // namespace gsv
