#include "gsv/recording/topics/state_topics.h"

#include <algorithm>
#include <utility>

#include "gsv/base/hash.h"
#include "gsv/messages/time.h"
#include "gsv/presentation/edit_message.h"
#include "gsv/presentation/health_messages.h"
#include "gsv/presentation/notes.h"

namespace gsv::recording {

namespace topics = presentation::topics;

namespace {

constexpr base::SimTime kHashPeriod = std::chrono::seconds(1);
constexpr base::SimTime kDiagnosticsPeriod = std::chrono::seconds(1);
constexpr base::SimTime kExpectationsPeriod = std::chrono::seconds(1);

bool IsSameOrder(const world::DriveState& a, const world::DriveState& b) {
  return a.command == b.command && a.command_time == b.command_time;
}

}  // namespace

StateTopics::StateTopics(McapWriter& writer, double poses_rate, const Selection& selection)
    : poses_instants_(base::FromSeconds(1 / poses_rate)),
      hash_instants_(kHashPeriod),
      diagnostics_instants_(kDiagnosticsPeriod),
      expectations_instants_(kExpectationsPeriod),
      clock_(writer, selection, topics::kClock),
      poses_(writer, selection, topics::kPoses),
      transforms_(writer, selection, topics::kTransforms),
      commands_(writer, selection, topics::kCommands),
      actuators_(writer, selection, topics::kActuators),
      contacts_(writer, selection, topics::kContacts),
      radio_(writer, selection, topics::kRadio),
      status_(writer, selection, topics::kStatus),
      diagnostics_(writer, selection, topics::kDiagnostics),
      events_(writer, selection, topics::kEvents),
      log_(writer, selection, topics::kLog),
      output_(writer, selection, topics::kOutput),
      notes_(writer, selection, topics::kNotes),
      expectations_(writer, selection, topics::kExpectations),
      hash_(writer, selection, topics::kStateHash),
      writer_(writer) {}

void StateTopics::Record(const std::shared_ptr<const world::Snapshot>& snapshot) {
  const base::SimTime time = snapshot->state.time;
  const bool is_new = snapshot->layout != layout_;
  if (is_new) {
    layout_ = snapshot->layout;
    pose_list_ = presentation::PoseListOf(*layout_);
    if (transforms_.is_wanted()) {
      transforms_message_ = presentation::TransformsMessage(*snapshot, pose_list_);
    }
    written_of_.clear();
    for (const world::Body& body : layout_->bodies) {
      written_of_.push_back(body.is_robot() ? &written_[body.name] : nullptr);
    }
  }
  if (commands_.is_wanted()) WriteNewCommands(*snapshot);
  if (actuators_.is_wanted()) WriteNewDeviceCommands(*snapshot);
  if (contacts_.is_wanted()) WriteNewContacts(*snapshot);
  if (radio_.is_wanted()) WriteTransmissions(*snapshot);
  if (poses_instants_.AdvanceTo(time) || is_new) WritePoses(*snapshot);
  if (hash_instants_.AdvanceTo(time) && hash_.is_wanted()) WriteHash(*snapshot);
}

void StateTopics::RecordNow(const world::Snapshot& snapshot) {
  if (poses_step_ != snapshot.state.step) WritePoses(snapshot);
}

void StateTopics::WritePoses(const world::Snapshot& snapshot) {
  const base::SimTime time = snapshot.state.time;
  clock_.Write(time, {messages::ToMessage(time)});
  if (poses_.is_wanted() || transforms_.is_wanted()) {
    const std::vector<geometry::Pose> poses = presentation::PosesOf(snapshot, pose_list_);
    if (poses_.is_wanted()) poses_.Write(time, presentation::PosesMessage(snapshot, poses));
    if (transforms_.is_wanted()) {
      presentation::UpdateTransforms(snapshot, pose_list_, poses, transforms_message_);
      transforms_.Write(time, transforms_message_);
    }
  }
  poses_step_ = snapshot.state.step;
}

void StateTopics::WriteHash(const world::Snapshot& snapshot) {
  base::Hash hash;
  world::AddToHash(*snapshot.layout, snapshot.state, hash);
  messages::gsv_msgs::StateHash message;
  message.stamp = messages::ToMessage(snapshot.state.time);
  message.step = static_cast<std::uint64_t>(snapshot.state.step);
  message.hash = hash.Hex();
  hash_.Write(snapshot.state.time, message);
}

// Writes the new commands to robots' drives. A command appears in the snapshot one step after it
// was sent.
void StateTopics::WriteNewCommands(const world::Snapshot& snapshot) {
  const world::State& state = snapshot.state;
  for (std::size_t i = 0; i < layout_->bodies.size(); ++i) {
    if (written_of_[i] == nullptr) continue;
    const world::DriveState& drive = state.bodies[i].drive;
    if (IsSameOrder(drive, std::exchange(*written_of_[i], drive))) continue;
    if (IsSameOrder(drive, {}))
      continue;  // the robot was removed and added again, and has no command yet
    commands_.Write(state.time,
                    presentation::CommandMessage(layout_->bodies[i].name, drive, state));
  }
}

// Writes the new commands to robots' other devices.
void StateTopics::WriteNewDeviceCommands(const world::Snapshot& snapshot) {
  const world::State& state = snapshot.state;
  const auto before = std::exchange(devices_, state.devices);
  if (state.devices == nullptr || state.devices == before) return;
  for (const world::DeviceStatePtr& now : *state.devices) {
    if (now->followed() == nullptr) continue;
    const auto* last = world::FindDevice(before.get(), now->robot(), now->device());
    const bool is_known = last != nullptr && last->followed() != nullptr;
    if (is_known && *last->followed() == *now->followed()) continue;
    actuators_.Write(state.time, presentation::ActuatorMessage(*now, state));
  }
}

void StateTopics::WriteNewContacts(const world::Snapshot& snapshot) {
  for (const world::Contact& contact : snapshot.contacts) {
    if (contact.began && !contact.supports) {
      contacts_.Write(snapshot.state.time, presentation::ContactMessage(snapshot, contact));
    }
  }
}

void StateTopics::WriteTransmissions(const world::Snapshot& snapshot) {
  for (const world::Transmission& transmission : snapshot.transmissions) {
    radio_.Write(snapshot.state.time, presentation::TransmissionMessage(snapshot, transmission));
  }
}

void StateTopics::RecordStatus(const simulation::SimulationStatus& status) {
  if (status_.is_wanted()) status_.Write(status.time, presentation::StatusMessage(status));
  if (diagnostics_instants_.AdvanceTo(status.time) && diagnostics_.is_wanted()) {
    diagnostics_.Write(status.time, presentation::DiagnosticsMessage(status));
  }
}

void StateTopics::RecordExpectations(base::SimTime time,
                                     const std::vector<simulation::ExpectationState>& states) {
  std::vector<simulation::ExpectationState::Verdict> verdicts;
  verdicts.reserve(states.size());
  for (const auto& state : states) verdicts.push_back(state.verdict);
  const bool is_due = expectations_instants_.AdvanceTo(time);
  if (!expectations_.is_wanted() || states.empty() || (!is_due && verdicts == verdicts_)) return;
  // The message has the time of the verdict, so that a replay at that time shows the verdict.
  base::SimTime instant = time;
  for (std::size_t i = 0; i < states.size(); ++i) {
    using Verdict = simulation::ExpectationState::Verdict;
    const Verdict before = i < verdicts_.size() ? verdicts_[i] : Verdict::kPending;
    if (verdicts[i] != before) instant = std::min(instant, states[i].time);
  }
  verdicts_ = std::move(verdicts);
  expectations_.Write(instant, presentation::ExpectationsMessage(instant, states));
}

void StateTopics::RecordEvent(const simulation::Event& event) {
  if (simulation::IsOutput(event)) {
    output_.Write(event.time, presentation::LogMessage(event));
    return;
  }
  if (presentation::IsNote(event)) {
    notes_.Write(presentation::TimeOfNote(event), presentation::NoteMessage(event));
    return;
  }
  events_.Write(event.time, presentation::EventMessage(event));
  log_.Write(event.time, presentation::LogMessage(event));
  if (event.edit != nullptr) RecordEdit(*event.edit);
}

void StateTopics::RecordEdit(const simulation::Edit& edit) {
  if (!edits_) edits_.emplace(writer_, Selection{}, topics::kEdits);
  edits_->Write(edit.time, presentation::EditMessage(edit));
}

}  // namespace gsv::recording
