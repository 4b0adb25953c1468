// Guesses the drive of a robot from its wheels, if the file describes no drive.
//
// Rule    Only wheels that FindWheels() returns and whose axle is across the model (along y) count.
//         - A fixed wheel has no swivel joint (a joint about the vertical). A wheel on a swivel
//           joint with limits is steered.
//         - A wheel on a swivel joint without limits is a caster if it is behind the joint or in
//           front of it, unless "steer" is in its name or in the name of one of its joints. If the wheel is under the joint, it is a caster if there are
//           fixed wheels, but no wheels that are steered by the other rules. Else it is steered.
//         - Fixed wheels that are clearly smaller than the largest, or in the middle between left
//           and right, are casters too, and so are wheels with "caster" in their names. Casters are
//           not driven.
//         - If <ros2_control> gives some wheels a command interface, only these are driven.
//         - If there are fixed wheels on the left and on the right, the drive is differential. If
//           there are more than two, this is skid steering. If there are four fixed wheels with
//           rollers at 45° and no steered wheels, the drive is mecanum. If all steered wheels are
//           in front of the fixed wheels, the drive is Ackermann. If some are not, it stays
//           differential, and the steered wheels keep pointing straight ahead.
//         - If there are only steered wheels, three or more, the base moves in all directions
//           (kVelocity).
// Measured  The radius is measured on the wheels, and the separation between the centres of the
//         left and right wheels. For Ackermann, the wheel base is the distance from the steered
//         joints to the rear axle, and the steering limit is the smallest limit of these joints.
//         For other drives, the wheel base is the distance between the front and rear wheels.
#pragma once

#include "gsv/model/model.h"

namespace gsv::model {

// Returns the guessed drive, with the origin kGuessed. Its kind is kNone if no rule above applies.
Drive GuessDrive(const Model& model);

// Measures separation, radius, wheel base and steering limit of a drive whose joints are set.
// Values that cannot be measured are unchanged.
void MeasureDrive(const Model& model, Drive& drive);

}  // namespace gsv::model
