// What robots' actuators beside the base and the joints were told: lamps, speakers, grippers. It is
// part of the state: it shows, it is heard, and a behaviour can read it.
//
// Sharing  setups and what an actuator was told are immutable; a state that nobody changes is
//          copied as one pointer.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gsv/base/hash.h"
#include "gsv/base/sim_time.h"
#include "gsv/geometry/pose.h"
#include "gsv/model/material.h"

namespace gsv::world {

// A lamp shines along its x axis. A light of intensity 1 lights a white surface that faces it 1 m
// away to full white, and falls off with the square of the distance until it ends at `range`.
struct LampSetup {
  double radius = 0.02;    // m, of the ball that glows
  double range = 0;        // m; 0: it is seen, and lights nothing
  double angle = 6.2832;   // rad, of the whole cone; of a full turn: all around
  double intensity = 1;    // at full brightness
  model::Colour colour{};  // where it is told none
};

struct SpeakerSetup {
  double loudness = 85;  // dB (re 20 µPa) 1 m away at full volume
};

// A gripper's jaws lie along its x axis and close along y.
struct GripperSetup {
  double opening = 0.1;                // m, between the open jaws
  double reach = 0.08, height = 0.03;  // m, of the jaws
  double closing_time = 0.5;           // s
  std::string left_jaw, right_jaw;     // joints that show them; empty: none
};

// What an actuator is able to; docs/actuators.md names the parameters.
struct ActuatorSetup {
  int link = 0;  // of its robot's model
  geometry::Pose link_from_actuator;
  std::variant<std::monostate, LampSetup, SpeakerSetup, GripperSetup> kind;
};
using ActuatorSetupPtr = std::shared_ptr<const ActuatorSetup>;

// The shape of `values`, and what `word` says, are the type's.
struct ActuatorOrder {
  std::vector<double> values;
  std::string word;
  friend bool operator==(const ActuatorOrder&, const ActuatorOrder&) = default;
};

// What a gripper holds.
struct Grip {
  std::string held;  // a body; empty: nothing
  geometry::Pose link_from_held;
  double width = 0;  // m, of what is held
};

// An actuator that was told something.
struct ActuatorState {
  std::string robot, actuator;
  ActuatorSetupPtr setup;
  ActuatorOrder order;
  base::SimTime since{0};     // the instant from which the order acts
  double opening_before = 0;  // of a gripper, m: at that instant
  Grip grip;
};
using ActuatorStatePtr = std::shared_ptr<const ActuatorState>;

using Actuators = std::vector<ActuatorStatePtr>;  // by robot, then actuator

// Null if that actuator was told nothing. `actuators` may be null.
const ActuatorState* FindActuator(const Actuators* actuators, std::string_view robot,
                                  std::string_view actuator);

void AddToHash(const Actuators& actuators, base::Hash& hash);

// A lamp's order: brightness in [0, 1], then red, green, blue of its colour.
struct Glow {
  double brightness = 0;
  model::Colour colour;
};
Glow GlowOf(const ActuatorOrder& order, const LampSetup& lamp);

// A speaker's order: frequency (Hz), duration (s), volume in [0, 1]; the word names the sound.
struct Sound {
  std::string name;
  double frequency = 0, volume = 0;
  double elapsed = 0, left = 0;  // s
};
// What a speaker plays at `now`; nothing once the sound is over.
std::optional<Sound> SoundOf(const ActuatorState& speaker, base::SimTime now);

// A gripper's order: 1 to open, 0 to close.
bool IsToldToOpen(const ActuatorState& gripper);
// m, between its jaws.
double OpeningOf(const ActuatorState& gripper, base::SimTime now);

// What becomes of an actuator that is in a state `before` (null: it was told nothing) when it is
// told `next`: jaws go on from where they are, and what is held stays so until they are to open.
ActuatorState After(const ActuatorState* before, ActuatorState next);

}  // namespace gsv::world
