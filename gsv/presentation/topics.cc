#include "gsv/presentation/topics.h"

#include <algorithm>
#include <array>

namespace gsv::presentation {
namespace {

constexpr std::size_t kPastEvents = 100;

template <typename Message>
Topic Row(const TopicOf<Message>& topic, Topic row = {}) {
  row.name = topic.name;
  row.schema = &messages::SchemaOf<Message>();
  return row;
}

}  // namespace

std::span<const Topic> Topics() {
  static const std::array table{
      Row(topics::kClock, {.replay = Replay::kByClock}),
      Row(topics::kPoses),
      Row(topics::kPackedPoses, {.is_recorded = false}),
      Row(topics::kTransforms),
      Row(topics::kSensorTransforms),
      Row(topics::kBeams),
      Row(topics::kStatus, {.replay = Replay::kByClock, .is_reproducible = false}),
      Row(topics::kDiagnostics, {.is_reproducible = false}),
      Row(topics::kEvents, {.replay = Replay::kEach, .history = kPastEvents, .is_state = false}),
      Row(topics::kLog, {.replay = Replay::kEach, .history = kPastEvents, .is_state = false}),
      Row(topics::kOutput, {.replay = Replay::kEach,
                            .is_reproducible = false,
                            .history = kPastEvents,
                            .is_state = false}),
      Row(topics::kNotes, {.replay = Replay::kEach,
                           .is_reproducible = false,
                           .history = kPastEvents,
                           .is_state = false}),
      Row(topics::kHealth, {.is_reproducible = false}),
      Row(topics::kExpectations, {.is_reproducible = false}),
      Row(topics::kCommands, {.is_state = false}),
      Row(topics::kActuators, {.is_live = false}),
      Row(topics::kContacts, {.replay = Replay::kEach, .is_state = false}),
      Row(topics::kCurrentContacts, {.is_recorded = false}),
      Row(topics::kRadio, {.replay = Replay::kEach, .is_state = false}),
      Row(topics::kStateHash, {.is_live = false}),
      Row(topics::kEdits, {.is_live = false}),
      Row(topics::kStepCosts, {.is_recorded = false}),
      Row(topics::kViewers, {.is_recorded = false}),
  };
  return table;
}

const Topic* FindTopic(std::string_view name) {
  const auto table = Topics();
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const Topic& topic) { return topic.name == name; });
  return found == table.end() ? nullptr : &*found;
}

}  // namespace gsv::presentation
