// The drive of a rigid body within a step: computes the target velocity of the base for each
// substep.
#pragma once

#include <vector>

#include "gsv/dynamics/motion/drive_kinematics.h"

namespace gsv::dynamics {

// Computes the target velocity of a driven rigid body for each substep of one step.
class DriveServo {
 public:
  // `now` is the time at the start of the step.
  DriveServo(const DriveKinematics& kinematics, const world::BodyState& body, base::SimTime now)
      : kinematics_(kinematics), drive_(body.drive), now_(now) {}

  // Advances by a substep. Returns the target velocity of the base at the end of the substep,
  // within the limits.
  const world::DriveCommand& Advance(double seconds) {
    drive_.actual = kinematics_.Next(drive_, now_, seconds);
    now_ += base::FromSeconds(seconds);
    return drive_.actual;
  }
  // The motion at the end of the last substep.
  const world::DriveCommand& motion() const { return drive_.actual; }
  const DriveKinematics& kinematics() const { return kinematics_; }

 private:
  const DriveKinematics& kinematics_;
  world::DriveState drive_;  // the drive's state at now_
  base::SimTime now_;        // the time at the end of the last substep
};

// Some drives have no wheels that could roll (synchro, mecanum, velocity). Such a drive controls
// the base directly: its horizontal velocity and its turn rate about the vertical approach the
// target. They change by at most `grip` (m/s², rad/s²) times `seconds`. There must be no friction
// between such a base and the bodies that carry it.
void HoldBase(const DriveServo& servo, const geometry::Pose& world_from_model,
              const geometry::Vector3& point, double grip, double seconds,
              geometry::Vector3& velocity_of_point, geometry::Vector3& angular_velocity);

// Whether the drive's wheels are joints that propel the base.
bool RollsOnWheels(const model::Model& model);

}  // namespace gsv::dynamics
