// The drive of a body that moves by forces, within a step: what its base is to do, substep by
// substep.
#pragma once

#include <vector>

#include "gsv/dynamics/motion/drive_kinematics.h"

namespace gsv::dynamics {

class DriveServo {
 public:
  // Starts at the state's time.
  DriveServo(const DriveKinematics& kinematics, const world::BodyState& body, base::SimTime now)
      : kinematics_(kinematics), drive_(body.drive), now_(now) {}

  // Goes on by a substep: what the base is to do at its end, within the drive's limits.
  const world::DriveCommand& Advance(double seconds) {
    drive_.actual = kinematics_.Next(drive_, now_, seconds);
    now_ += base::FromSeconds(seconds);
    return drive_.actual;
  }
  const world::DriveCommand& motion() const { return drive_.actual; }
  const DriveKinematics& kinematics() const { return kinematics_; }

 private:
  const DriveKinematics& kinematics_;
  world::DriveState drive_;
  base::SimTime now_;
};

// Drives without wheels that Bullet could roll (synchro, mecanum, velocity) take hold of the base
// itself: its velocity over the ground, in whatever direction, and its turn about the vertical
// change towards those wanted, by no more than `grip` (m/s², rad/s²) allows in so many seconds.
// What carries such a base must not rub on it.
void HoldBase(const DriveServo& servo, const geometry::Pose& world_from_model,
              const geometry::Vector3& point, double grip, double seconds,
              geometry::Vector3& velocity_of_point, geometry::Vector3& angular_velocity);

// Whether the drive's wheels are joints that push the base along.
bool RollsOnWheels(const model::Model& model);

}  // namespace gsv::dynamics
