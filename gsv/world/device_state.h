// The state of a robot's device between steps, such as the messages of a radio, the command of a
// lamp or the attached body of a gripper. Each type derives a class from DeviceState. All other
// code, such as the step loop, the recorder and the renderer, uses only this interface.
//
// Sharing      states are immutable. Snapshots share the state of a device that does not change. A
//              world without devices has no device states.
// Determinism  BeforeStep(), AfterMove() and CarryOver() are functions of their arguments alone.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/hash.h"
#include "gsv/base/sim_time.h"
#include "gsv/geometry/pose.h"
#include "gsv/model/material.h"

namespace gsv::world {

struct DeviceStep;
struct Layout;
struct State;

// A command to a device. The type defines the shape of `values` and the meaning of `word` and
// `content`.
struct DeviceCommand {
  std::vector<double> values;
  std::string word;       // such as the name of a sound or of a receiver; may be empty
  std::string content{};  // bytes
  friend bool operator==(const DeviceCommand&, const DeviceCommand&) = default;
};

// The current command of a device.
struct FollowedCommand {
  DeviceCommand command;
  base::SimTime since{0};  // the instant from which it is applied
  friend bool operator==(const FollowedCommand&, const FollowedCommand&) = default;
};

// The light of a lamp while it is on. The axis of its cone is the x axis of the device. At
// intensity 1, a white surface that faces the lamp at a distance of 1 m is fully lit. The light
// decreases with the square of the distance and ends at `range`.
struct Glow {
  double brightness = 0;  // in (0, 1]
  model::Colour colour{};
  double radius = 0.02;   // radius of the glowing sphere, m
  double range = 0;       // range in m; if 0, the lamp is visible, but lights no objects
  double angle = 6.2832;  // angle of the whole cone, rad; 2 pi means all directions
  double intensity = 1;   // intensity at full brightness
};

// The sound of a device at one instant.
struct Sound {
  std::string name;
  double frequency = 0;          // Hz
  double volume = 0;             // in (0, 1]
  double elapsed = 0, left = 0;  // s
  double loudness = 0;           // sound level in dB (re 20 µPa) 1 m away at full volume
};

// A grasped body. It moves with the device's link.
struct Grasp {
  std::string held;  // name of the body
  geometry::Pose link_from_held;
  friend bool operator==(const Grasp&, const Grasp&) = default;
};

// The robot and the name of a device, and where it is mounted.
struct DeviceMount {
  std::string robot, device;  // names of the robot and of the device
  int link = 0;               // link of the robot's model on which the device is mounted
  geometry::Pose link_from_device;
};

class DeviceState;
using DeviceStatePtr = std::shared_ptr<const DeviceState>;
using DeviceStates = std::vector<DeviceStatePtr>;  // Ordered by robot, then by device.

// The base class for the states of devices, such as radios and actuators.
class DeviceState {
 public:
  explicit DeviceState(DeviceMount mount) : mount_(std::move(mount)) {}
  virtual ~DeviceState() = default;

  const DeviceMount& mount() const { return mount_; }
  const std::string& robot() const { return mount_.robot; }
  const std::string& device() const { return mount_.device; }

  virtual void AddToHash(base::Hash& hash) const = 0;
  // Returns the current command, or null for a device without commands, such as a radio.
  virtual const FollowedCommand* followed() const { return nullptr; }

  // The device's light for cameras, its sound for microphones, and its grasped body (default:
  // none).
  virtual std::optional<Glow> glow() const { return std::nullopt; }
  virtual std::optional<Sound> SoundAt(base::SimTime) const { return std::nullopt; }
  virtual const Grasp* grasp() const { return nullptr; }

  // The following functions return the device's next state, or null if it does not change.
  //
  // Called before the bodies move, after the commands of this step were applied.
  virtual DeviceStatePtr BeforeStep(DeviceStep&) const { return nullptr; }
  // Called after an edit of the bodies. `placed` has the names of bodies that were moved. The
  // device's robot still exists.
  virtual DeviceStatePtr CarryOver(const Layout&, const std::vector<std::string>& /*placed*/,
                                   base::SimTime /*now*/) const {
    return nullptr;
  }
  // Called after the bodies have moved to their poses at `time`. Moves the body that the device has
  // grasped.
  virtual void AfterMove(const Layout&, base::SimTime /*time*/, State&) const {}

 private:
  const DeviceMount mount_;
};

// Returns the state of a device; null if the device has none. `devices` may be null.
const DeviceState* FindDevice(const DeviceStates* devices, std::string_view robot,
                              std::string_view device);
// Returns the index of the device. If it has no state, returns the index at which its state would
// be inserted.
std::size_t PlaceOf(const DeviceStates& devices, std::string_view robot, std::string_view device);

// Adds the states of all devices to the hash: first devices without commands, then devices with
// commands.
void AddToHash(const DeviceStates& devices, base::Hash& hash);

}  // namespace gsv::world
