// A recording's messages for people: decoded by the schemas that the recording itself holds.
#pragma once

#include <map>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "gsv/messages/definition.h"
#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/selection.h"

namespace gsv::recording {

struct DecodedMessage {
  std::string topic;
  std::string type;  // "sensor_msgs/msg/Range"
  base::SimTime time{};
  nlohmann::ordered_json content;
};

// A message's content as JSON can write it: JSON has no infinite numbers, so they become the texts
// "Infinity" and "-Infinity", which JavaScript's Number() and Python's float() read. NaN is written
// as null.
nlohmann::ordered_json WithInfinitiesAsText(nlohmann::ordered_json content);

class DecodedMessages {
 public:
  // In the order of times. The reader must outlive this. Fails when a topic of the selection is not
  // in the recording, or no messages can be decoded.
  static base::Result<DecodedMessages> Open(const McapReader& reader, const Selection& selection);

  // Nothing at the end. What cannot be read or decoded gives an error once; the next call goes on.
  base::Result<std::optional<DecodedMessage>> Next();

 private:
  struct Topic {
    std::string name, type;
    messages::Definition definition;
  };
  DecodedMessages(const McapReader& reader, const Selection& selection)
      : selection_(selection), cursor_(reader.Messages(selection.from)) {}

  Selection selection_;
  std::map<std::uint16_t, Topic> topics_;  // by channel
  MessageCursor cursor_;
};

// Where two recordings first differ: the earliest instant, there the first topic by name.
struct Difference {
  base::SimTime time{};
  std::string topic;
  std::string field;  // "pose.position.x"; empty: the message is missing in one of them
  std::string in_first, in_second;  // the values as JSON; "missing"
  std::string Sentence() const;
};
// time_s, topic, field, first, second.
nlohmann::ordered_json ToJson(const Difference& difference);

// Whether a recording lacks some of what there was to record.
enum class Gaps {
  kNone,
  kInFirst,  // compared is what both have: of a topic, instants with equally many messages in both
};

// Compares what counts for the content hash (see content_hash.h), of the selected topics. Empty:
// they tell the same.
base::Result<std::optional<Difference>> FirstDifference(const McapReader& first,
                                                        const McapReader& second,
                                                        const std::vector<std::string>& topics = {},
                                                        Gaps gaps = Gaps::kNone);

// A table of one topic: a row a message, a column a number or text of it ("ranges.0"), the columns
// in the order in which they first appear; RFC 4180. Numbers that are not finite are written "inf",
// "-inf" and "nan".
base::Result<std::string> ToCsv(const McapReader& reader, const Selection& selection);

}  // namespace gsv::recording
