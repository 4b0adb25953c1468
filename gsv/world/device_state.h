// What a device of a robot keeps from one step to the next: a radio the messages that it has heard,
// a lamp its command, a gripper what it holds. Each type derives a class from DeviceState. The step
// loop, the hash, the recorder, the renderer and the microphones use this interface and know no
// type.
//
// Sharing      states are immutable. A device that does not change is copied as one pointer, and a
//              world without devices has none.
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

// What a behaviour commands a device to do. The type defines the shape of `values`, and what `word`
// and `content` mean.
struct DeviceCommand {
  std::vector<double> values;
  std::string word;
  std::string content{};  // bytes
  friend bool operator==(const DeviceCommand&, const DeviceCommand&) = default;
};

// The command that a device follows.
struct FollowedCommand {
  DeviceCommand command;
  base::SimTime since{0};  // the instant from which it acts
  friend bool operator==(const FollowedCommand&, const FollowedCommand&) = default;
};

// A lamp that is on. It shines along the device's x axis. A light of intensity 1 lights a white
// surface that faces it 1 m away to full white, and falls off with the square of the distance until
// it ends at `range`.
struct Glow {
  double brightness = 0;  // in (0, 1]
  model::Colour colour{};
  double radius = 0.02;   // m, of the sphere that glows
  double range = 0;       // m; 0: it is visible, and lights nothing
  double angle = 6.2832;  // rad, of the whole cone; of a full turn: all around
  double intensity = 1;   // at full brightness
};

// What a device plays at one instant.
struct Sound {
  std::string name;
  double frequency = 0;          // Hz
  double volume = 0;             // in (0, 1]
  double elapsed = 0, left = 0;  // s
  double loudness = 0;           // dB (re 20 µPa) 1 m away at full volume
};

// A body that moves with the device's link.
struct Grasp {
  std::string held;  // a body
  geometry::Pose link_from_held;
  friend bool operator==(const Grasp&, const Grasp&) = default;
};

// Which device of which robot, and where it is mounted.
struct DeviceMount {
  std::string robot, device;
  int link = 0;  // of the robot's model
  geometry::Pose link_from_device;
};

class DeviceState;
using DeviceStatePtr = std::shared_ptr<const DeviceState>;
using DeviceStates = std::vector<DeviceStatePtr>;  // by robot, then device

class DeviceState {
 public:
  explicit DeviceState(DeviceMount mount) : mount_(std::move(mount)) {}
  virtual ~DeviceState() = default;

  const DeviceMount& mount() const { return mount_; }
  const std::string& robot() const { return mount_.robot; }
  const std::string& device() const { return mount_.device; }

  virtual void AddToHash(base::Hash& hash) const = 0;
  // Null for a device that follows no command, such as a radio.
  virtual const FollowedCommand* followed() const { return nullptr; }

  // What cameras see of it, what microphones hear of it, and what it holds: nothing by default.
  virtual std::optional<Glow> glow() const { return std::nullopt; }
  virtual std::optional<Sound> SoundAt(base::SimTime) const { return std::nullopt; }
  virtual const Grasp* grasp() const { return nullptr; }

  // The following give the device's next state, or null if it does not change.
  //
  // Before the bodies move, after the commands of this step.
  virtual DeviceStatePtr BeforeStep(DeviceStep&) const { return nullptr; }
  // After bodies were added, removed or placed elsewhere (`placed`). The device's robot is there.
  virtual DeviceStatePtr CarryOver(const Layout&, const std::vector<std::string>& /*placed*/,
                                   base::SimTime /*now*/) const {
    return nullptr;
  }
  // After the bodies have moved, to where they are at `time`: moves what the device itself moves.
  virtual void AfterMove(const Layout&, base::SimTime /*time*/, State&) const {}

 private:
  const DeviceMount mount_;
};

// Null if that device has no state. `devices` may be null.
const DeviceState* FindDevice(const DeviceStates* devices, std::string_view robot,
                              std::string_view device);
// Where it is, or where it would have to be inserted.
std::size_t PlaceOf(const DeviceStates& devices, std::string_view robot, std::string_view device);

// First those that follow no command, then those that do.
void AddToHash(const DeviceStates& devices, base::Hash& hash);

}  // namespace gsv::world
