// Guesses the drive of a robot from its wheels, if the file describes no drive.
//
// Rule    wheels are those that FindWheels() returns with an axle across the model (along y).
//         - A wheel on a joint about the vertical is a caster if that joint has no limits, and if
//           the wheel is behind the joint or if there are fixed wheels. Otherwise it is steered.
//         - Wheels that are clearly smaller than the largest, wheels in the middle between left and
//           right, and wheels named caster are casters. Casters are not driven.
//         - If <ros2_control> gives some wheels a command interface, only these are driven.
//         - Left and right fixed wheels: a differential drive (of more than one axle: skid
//           steering; with rollers at 45°: mecanum). With steered wheels in front of all of them:
//           Ackermann steering. Other steered wheels keep straight.
//         - Only steered wheels, three or more: the base moves in all directions (kVelocity).
// Measured  the radius on the wheels, the separation between their middles, the wheel base between
//         steered joints and rear axle, the steering limit on the steered joints.
#pragma once

#include "gsv/model/model.h"

namespace gsv::model {

// Returns the guessed drive, with the origin kGuessed. Its kind is kNone if no rule above applies.
Drive GuessDrive(const Model& model);

// Measures separation, radius, wheel base and steering limit of a drive whose joints are set.
// Values that cannot be measured are unchanged.
void MeasureDrive(const Model& model, Drive& drive);

}  // namespace gsv::model
