// Guesses the drive of a robot from its wheels, if the file describes no drive.
//
// Rule    Only wheels that FindWheels() returns and whose axle is across the model (along y) count.
//         - A wheel on a joint about the vertical is a caster if that joint has no limits, and if
//           the wheel is behind the joint or if there are fixed wheels. Otherwise it is steered.
//         - Wheels that are clearly smaller than the largest, wheels in the middle between left and
//           right, and wheels named caster are casters. Casters are not driven.
//         - If <ros2_control> gives some wheels a command interface, only these are driven.
//         - If there are fixed wheels on the left and on the right, the drive is differential. If
//           there are more than two, this is skid steering. If there are four fixed wheels with
//           rollers at 45° and no steered wheels, the drive is mecanum. If all steered wheels are
//           in front of the fixed wheels, the drive is Ackermann. Other steered wheels stay
//           straight.
//         - If there are only steered wheels, three or more, the base moves in all directions
//           (kVelocity).
// Measured  The radius is measured on the wheels, and the separation between the centres of the
//         left and right wheels. The wheel base is the distance from the steered joints to the rear
//         axle. The steering limit is the smallest limit of the steered joints.
#pragma once

#include "gsv/model/model.h"

namespace gsv::model {

// Returns the guessed drive, with the origin kGuessed. Its kind is kNone if no rule above applies.
Drive GuessDrive(const Model& model);

// Measures separation, radius, wheel base and steering limit of a drive whose joints are set.
// Values that cannot be measured are unchanged.
void MeasureDrive(const Model& model, Drive& drive);

}  // namespace gsv::model
