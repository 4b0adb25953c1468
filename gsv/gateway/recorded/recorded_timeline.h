// A RecordedTimeline provides the data for a recording's timeline: the times of poses, the events
// and the log.
//
// Input    untrusted: unreadable messages are left out.
// Threads  const members may run concurrently.
#pragma once

#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "gsv/base/sim_time.h"
#include "gsv/gateway/recorded/recorded_scene.h"
#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::gateway {

// A message of /gsv/events, a message of /gsv/notes, or a collision of a robot. `event` is "note"
// for a note and "collision" for a collision.
struct RecordedEvent {
  base::SimTime time{};
  std::string event, robot, detail;  // kind of the event, the robot (may be empty), and a text
};

// A message of /rosout.
struct RecordedLine {
  base::SimTime time{};
  int level = 20;          // as in rcl_interfaces/msg/Log: 10 debug to 50 fatal
  std::string name, text;  // name of the source, and the message
};

// Returns a collision as an event. Live timelines use the same form.
RecordedEvent CollisionEvent(base::SimTime time, const std::string& first,
                             const std::string& second);

// The data for a recording's timeline: times of poses, events and the log.
class RecordedTimeline {
 public:
  // `reader` and `scene` must outlive this.
  RecordedTimeline(const recording::McapReader& reader, const RecordedScene& scene);

  // Returns the time of the `count`th recorded pose after `time`, or before it if `count` is
  // negative. If there are fewer poses, returns the start or end of the recording. Reads the blocks
  // around `time`.
  base::SimTime TimeOfPoseFrom(base::SimTime time, std::int64_t count) const;

  // Returns the first thousand events, the first thousand notes and the first 500 collisions,
  // ordered by time. The messages of each of these kinds have about 1 MiB at most. The first
  // call reads them from the recording.
  const std::vector<RecordedEvent>& Events() const;

  // Returns the first five thousand lines of the log, ordered by time, from about 1 MiB of messages
  // at most. The first call reads them from the recording.
  const std::vector<RecordedLine>& Log() const;

 private:
  using ChannelIds = std::set<std::uint16_t>;

  // Returns the ids of the channels of a topic.
  ChannelIds ChannelsOf(const std::string& topic) const;
  // Reads the events, notes and collisions.
  std::vector<RecordedEvent> ReadEvents() const;
  // Reads the lines of the log.
  std::vector<RecordedLine> ReadLog() const;
  // Reads the messages of these channels, and calls `use` for each message. `use` returns the
  // message's entry in the timeline, or nullopt if the message has none. Stops at `max_entries`
  // entries. Returns the entries ordered by time.
  template <typename Message, typename Entry, typename Use>
  std::vector<Entry> ReadAll(const ChannelIds& channels, std::size_t max_entries, Use use) const;

  const recording::McapReader& reader_;
  const RecordedScene& scene_;
  const ChannelIds pose_channels_, event_channels_, note_channels_, contact_channels_,
      log_channels_;
  mutable std::once_flag events_once_, log_once_;
  mutable std::vector<RecordedEvent> events_;
  mutable std::vector<RecordedLine> log_;
};

}  // namespace gsv::gateway
