// For tests: makes small recordings in memory.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/messages/rosgraph_msgs.h"
#include "gsv/messages/std_msgs.h"
#include "gsv/messages/time.h"
#include "gsv/recording/mcap/mcap_file_writer.h"
#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::recording {

using std::chrono_literals::operator""ms;

inline SchemaRecord SchemaOfClock() {
  const messages::Schema& schema = messages::SchemaOf<messages::rosgraph_msgs::Clock>();
  return {1, std::string(schema.name), std::string(schema.encoding), std::string(schema.text)};
}

inline ChannelRecord ChannelOf(std::uint16_t id, const std::string& topic) {
  return {id, 1, topic, "cdr", {}};
}

inline Bytes ClockMessage(base::SimTime time) {
  Bytes bytes;
  messages::Encode(messages::rosgraph_msgs::Clock{messages::ToMessage(time)}, bytes);
  return bytes;
}

inline std::span<const std::byte> AsBytes(std::string_view text) {
  return std::as_bytes(std::span(text));
}

// A recording of one metadata record, one attachment and three chunks of ten messages: at 0, 10,
// 20, … 290 ms, alternately on the topics /even and /odd.
inline Bytes ThreeChunks() {
  Bytes bytes;
  MemorySink sink(bytes);
  McapFileWriter writer(sink, {});
  (void)writer.AddSchema(SchemaOfClock());
  (void)writer.AddChannel(ChannelOf(0, "/even"));
  (void)writer.AddChannel(ChannelOf(1, "/odd"));
  (void)writer.AddMetadata({"gsv", {{"seed", "7"}}});
  (void)writer.Attach({0ms, 0ms, "world.sdf", "application/xml", AsBytes("<sdf/>")});
  for (std::uint16_t i = 0; i < 30; ++i) {
    const base::SimTime time = i * 10ms;
    const Bytes data = ClockMessage(time);
    (void)writer.Write(
        {static_cast<std::uint16_t>(i % 2), static_cast<std::uint32_t>(i / 2), time, time, data});
    if (i % 10 == 9) (void)writer.Flush();
  }
  (void)writer.Close();
  return bytes;
}

inline base::Result<std::unique_ptr<McapReader>> Open(std::span<const std::byte> bytes,
                                                      const Limits& limits = {}) {
  return McapReader::Open(std::make_unique<MemorySource>(bytes), limits);
}

// The times of all messages from `from` on, in the order in which they were read. Errors are
// counted and skipped.
struct Times {
  std::vector<base::SimTime> times;
  int errors = 0;
};
inline Times TimesIn(const McapReader& reader, base::SimTime from = {}) {
  Times result;
  MessageCursor cursor = reader.Messages(from);
  for (;;) {
    const auto message = cursor.Next();
    if (!message) {
      ++result.errors;
      continue;
    }
    if (!*message) return result;
    result.times.push_back((*message)->log_time);
  }
}

// The offset and the kind of a record in a recording.
struct FoundRecord {
  Opcode opcode{};
  std::size_t begin = 0;
  std::size_t end = 0;
};
inline std::vector<FoundRecord> FindRecords(std::span<const std::byte> recording) {
  std::vector<FoundRecord> places;
  std::span<const std::byte> rest = recording.subspan(kMagic.size());
  while (rest.size() > kMagic.size()) {
    const std::size_t begin = recording.size() - rest.size();
    const auto record = TakeRecord(rest);
    if (!record) break;
    places.push_back({record->opcode, begin, recording.size() - rest.size()});
  }
  return places;
}

}  // namespace gsv::recording
