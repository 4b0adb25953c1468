// The topics of a simulation, in one table for live streams, recordings, replays and relays. A
// constant such as topics::kPoses has the name and the message type of a topic. The table has the
// other properties of the topic. The topics of sensors are named after robots and sensors, see
// sensor_messages.h.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "gsv/messages/cdr.h"
#include "gsv/messages/diagnostic_msgs.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/rcl_interfaces.h"
#include "gsv/messages/rosgraph_msgs.h"
#include "gsv/messages/std_msgs.h"
#include "gsv/messages/tf2_msgs.h"
#include "gsv/messages/visualization_msgs.h"

namespace gsv::presentation {

// The name of a topic, and the type of its messages.
template <typename Message>
struct TopicOf {
  const char* name;
};

// How a replay sends the recorded messages of a topic.
enum class Replay {
  kNewest,   // at each instant, the newest message
  kEach,     // each message during playback; none during a seek
  kByClock,  // no recorded message; the player sends the time and the status of the replay instead
};

// The properties of one topic in the table.
struct Topic {
  std::string_view name{};
  const messages::Schema* schema = nullptr;  // schema of the topic's messages
  bool is_live = true;      // whether viewers of a running simulation get the topic
  bool is_recorded = true;  // whether recordings contain the topic
  Replay replay = Replay::kNewest;
  // Whether the messages are equal in every run, and are therefore hashed.
  bool is_reproducible = true;
  std::size_t history = 1;  // number of earlier messages that a new live subscriber gets
  bool is_state = true;     // whether a message replaces the earlier ones of the topic
};

std::span<const Topic> Topics();
// Returns the topic with that name, or null if the table does not contain it.
const Topic* FindTopic(std::string_view name);

namespace topics {

inline constexpr TopicOf<messages::rosgraph_msgs::Clock> kClock{"/clock"};
inline constexpr TopicOf<messages::gsv_msgs::Poses> kPoses{"/gsv/poses"};
// Rounded poses for viewers.
inline constexpr TopicOf<messages::gsv_msgs::PackedPoses> kPackedPoses{"/gsv/packed_poses"};
// Transforms of bodies and of their moving links.
inline constexpr TopicOf<messages::tf2_msgs::TFMessage> kTransforms{"/tf"};
// Transforms of sensors relative to their robots or moving links. They do not change.
inline constexpr TopicOf<messages::tf2_msgs::TFMessage> kSensorTransforms{"/tf_static"};
// Lines that viewers draw for the readings of sensors.
inline constexpr TopicOf<messages::visualization_msgs::MarkerArray> kBeams{"/gsv/beams"};
// Phase, time and robots of the simulation, for viewers.
inline constexpr TopicOf<messages::gsv_msgs::SimulationStatus> kStatus{"/gsv/status"};
// The status again, for ROS tools.
inline constexpr TopicOf<messages::diagnostic_msgs::DiagnosticArray> kDiagnostics{"/diagnostics"};
// Events of the run, except notes and lines of output.
inline constexpr TopicOf<messages::gsv_msgs::LifecycleEvent> kEvents{"/gsv/events"};
// The events again, for ROS tools.
inline constexpr TopicOf<messages::rcl_interfaces::Log> kLog{"/rosout"};
// Lines that behaviour programs print.
inline constexpr TopicOf<messages::rcl_interfaces::Log> kOutput{"/gsv/output"};
// Notes of viewers.
inline constexpr TopicOf<messages::gsv_msgs::LifecycleEvent> kNotes{"/gsv/notes"};
// The number of robots in each health::State, and all robots that are not kMoving, with the reason.
inline constexpr TopicOf<messages::gsv_msgs::Health> kHealth{"/gsv/health"};
// The verdicts on the scenario's expectations.
inline constexpr TopicOf<messages::gsv_msgs::Expectations> kExpectations{"/gsv/expectations"};
// New commands to the drives of robots.
inline constexpr TopicOf<messages::gsv_msgs::Command> kCommands{"/gsv/commands"};
// New commands to actuators, such as lamps and grippers.
inline constexpr TopicOf<messages::gsv_msgs::ActuatorCommand> kActuators{"/gsv/actuators"};
// Contacts that have begun, each once.
inline constexpr TopicOf<messages::gsv_msgs::Contact> kContacts{"/gsv/contacts"};
// All contacts of the last step, for viewers.
inline constexpr TopicOf<messages::gsv_msgs::Contacts> kCurrentContacts{"/gsv/current_contacts"};
// Radio messages that robots have sent.
inline constexpr TopicOf<messages::gsv_msgs::Transmission> kRadio{"/gsv/radio"};
// The hash of the simulation's state, to compare runs.
inline constexpr TopicOf<messages::gsv_msgs::StateHash> kStateHash{"/gsv/state_hash"};
// Changes of the world or its bodies by users, see gsv_msgs/Edit. This topic is in every recording
// of an edited simulation, even if it is not selected.
inline constexpr TopicOf<messages::gsv_msgs::Edit> kEdits{"/gsv/edits"};
// The wall-clock time that each part of a step takes.
inline constexpr TopicOf<messages::gsv_msgs::StepCosts> kStepCosts{"/gsv/step_costs"};
// The connected viewers, as JSON (gsv/gateway/access/viewers_api.h).
inline constexpr TopicOf<messages::std_msgs::String> kViewers{"/gsv/viewers"};

}  // namespace topics
}  // namespace gsv::presentation
