// What a recording's timeline shows beside its span: the instants of its poses, and what happened.
//
// Input    hostile: what cannot be read is left out.
// Threads  const members may run concurrently.
#pragma once

#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "gsv/base/sim_time.h"
#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::gateway {

// A message of /gsv/events.
struct RecordedEvent {
  base::SimTime time{};
  std::string event, robot, detail;
};

// A message of /rosout.
struct RecordedLine {
  base::SimTime time{};
  int level = 20;          // as rcl_interfaces/msg/Log has them: 10 debug to 50 fatal
  std::string name, text;  // who said it, and what
};

class RecordedTimeline {
 public:
  // `reader` must outlive this.
  explicit RecordedTimeline(const recording::McapReader& reader);

  // The instant of the `count`-th recorded pose after `time`, or before it if `count` is negative;
  // the recording's end, or start, where there are not so many. Reads the blocks around `time`.
  base::SimTime PoseBeside(base::SimTime time, std::int64_t count) const;

  // By time; the first thousand. The first call reads the blocks that hold them.
  const std::vector<RecordedEvent>& Events() const;

  // By time; the first five thousand. Likewise.
  const std::vector<RecordedLine>& Log() const;

 private:
  using ChannelIds = std::set<std::uint16_t>;

  ChannelIds ChannelsOf(const std::string& topic) const;
  std::vector<RecordedEvent> ReadEvents() const;
  std::vector<RecordedLine> ReadLog() const;
  // Of each message of these channels, as far as the limits allow, what `use` makes of it.
  template <typename Message, typename Entry, typename Use>
  std::vector<Entry> ReadAll(const ChannelIds& channels, std::size_t most, Use use) const;

  const recording::McapReader& reader_;
  const ChannelIds pose_channels_, event_channels_, log_channels_;
  mutable std::once_flag events_once_, log_once_;
  mutable std::vector<RecordedEvent> events_;
  mutable std::vector<RecordedLine> log_;
};

}  // namespace gsv::gateway
