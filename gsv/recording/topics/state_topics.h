// Records the topics of the simulation as a whole (docs/formats/messages.md). These are /clock,
// /tf, /diagnostics, /rosout, and in /gsv: poses, commands, actuators, contacts, radio, status,
// events, output, notes, expectations and state_hash. The first edit adds the topic /gsv/edits,
// even if this topic is not selected, because resimulation needs the edits.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/messages/rosgraph_msgs.h"
#include "gsv/presentation/run_messages.h"
#include "gsv/presentation/state_messages.h"
#include "gsv/recording/topics/instants.h"
#include "gsv/recording/topics/topic_writer.h"

namespace gsv::recording {

// Writes the topics about the simulation's state. Sensors have their own recorder.
class StateTopics {
 public:
  // `poses_rate` is in Hz of simulated time, > 0. `writer` must outlive this object.
  StateTopics(McapWriter& writer, double poses_rate, const Selection& selection);

  // Writes the messages that are due at the time of the snapshot.
  void Record(const std::shared_ptr<const world::Snapshot>& snapshot);
  // Writes the poses, transforms and clock of the snapshot, unless they are written. They need not
  // be due.
  void RecordNow(const world::Snapshot& snapshot);

  void RecordStatus(const simulation::SimulationStatus& status);
  // Writes the state of the scenario's expectations every second, and whenever a verdict changes,
  // with the time of that change.
  void RecordExpectations(base::SimTime time,
                          const std::vector<simulation::ExpectationState>& states);
  void RecordEvent(const simulation::Event& event);
  void RecordEdit(const simulation::Edit& edit);

 private:
  void WritePoses(const world::Snapshot& snapshot);
  void WriteHash(const world::Snapshot& snapshot);
  // Write the commands, actuator commands and contacts that are new in this snapshot.
  void WriteNewCommands(const world::Snapshot& snapshot);
  void WriteNewDeviceCommands(const world::Snapshot& snapshot);
  void WriteNewContacts(const world::Snapshot& snapshot);
  void WriteTransmissions(const world::Snapshot& snapshot);

  // The instants at which messages of slow topics are due.
  Instants poses_instants_;
  Instants hash_instants_;
  Instants diagnostics_instants_;
  Instants expectations_instants_;
  // Verdicts in the last written message.
  std::vector<simulation::ExpectationState::Verdict> verdicts_;
  std::optional<std::int64_t> poses_step_;          // number of the step of the last written poses
  std::shared_ptr<const world::Layout> layout_;     // layout of the last snapshot
  std::vector<presentation::PoseEntry> pose_list_;  // the entries of the written poses, for layout_
  messages::tf2_msgs::TFMessage
      transforms_message_;  // the last message on /tf; has the frames of the bodies in layout_
  std::map<std::string, world::DriveState> written_;  // last written command of each robot
  // The element of written_ for each body of layout_; null for bodies that are not robots.
  std::vector<world::DriveState*> written_of_;

  std::shared_ptr<const world::DeviceStates> devices_;  // device states in the last snapshot

  TopicWriter<messages::rosgraph_msgs::Clock> clock_;
  TopicWriter<messages::gsv_msgs::Poses> poses_;
  TopicWriter<messages::tf2_msgs::TFMessage> transforms_;
  TopicWriter<messages::gsv_msgs::Command> commands_;
  TopicWriter<messages::gsv_msgs::ActuatorCommand> actuators_;
  TopicWriter<messages::gsv_msgs::Contact> contacts_;
  TopicWriter<messages::gsv_msgs::Transmission> radio_;
  TopicWriter<messages::gsv_msgs::SimulationStatus> status_;
  TopicWriter<messages::diagnostic_msgs::DiagnosticArray> diagnostics_;
  TopicWriter<messages::gsv_msgs::LifecycleEvent> events_;
  TopicWriter<messages::rcl_interfaces::Log> log_;
  TopicWriter<messages::rcl_interfaces::Log> output_;
  TopicWriter<messages::gsv_msgs::LifecycleEvent> notes_;
  TopicWriter<messages::gsv_msgs::Expectations> expectations_;
  TopicWriter<messages::gsv_msgs::StateHash> hash_;
  std::optional<TopicWriter<messages::gsv_msgs::Edit>> edits_;
  McapWriter& writer_;
};

}  // namespace gsv::recording
