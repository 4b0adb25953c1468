#include "sdk/behaviour/actuators.h"

namespace gsv {

Lamp::Glow Lamp::Read() { return MeasureAs<Glow>(); }

Gripper::State Gripper::Read() { return MeasureAs<State>(); }

Speaker::Sound Speaker::Playing() { return MeasureAs<Sound>(); }

Microphone::Hearing Microphone::Listen() { return MeasureAs<Hearing>(); }

}  // namespace gsv
