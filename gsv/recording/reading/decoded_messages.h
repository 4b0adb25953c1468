// Decodes the messages of a recording with the schemas in the recording.
#pragma once

#include <map>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "gsv/messages/definition.h"
#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/selection.h"

namespace gsv::recording {

// A message as JSON, with its topic and time.
struct DecodedMessage {
  std::string topic;
  std::string type;  // such as "sensor_msgs/msg/Range"
  base::SimTime time{};
  nlohmann::ordered_json content;  // the message's fields by name
};

// Makes the content of a message valid JSON. JSON has no infinite numbers, so they become the texts
// "Infinity" and "-Infinity", which JavaScript's Number() and Python's float() read. NaN is written
// as null.
nlohmann::ordered_json WithInfinitiesAsText(nlohmann::ordered_json content);

// Iterates over the selected messages of a recording, decoded.
class DecodedMessages {
 public:
  // Opens the selected messages, ordered by time. The reader must outlive this object. Fails if a
  // selected topic is not in the recording, or if its messages cannot be decoded.
  static base::Result<DecodedMessages> Open(const McapReader& reader, const Selection& selection);

  // Returns the next message, or nullopt at the end. For a message or chunk that cannot be read or
  // decoded, returns an error once; the next call continues after it.
  base::Result<std::optional<DecodedMessage>> Next();

 private:
  // A selected topic, with the parsed schema of its messages.
  struct Topic {
    std::string name, type;
    messages::Definition definition;
  };
  DecodedMessages(const McapReader& reader, const Selection& selection)
      : selection_(selection), cursor_(reader.Messages(selection.from)) {}

  Selection selection_;
  std::map<std::uint16_t, Topic> topics_;  // topics by channel
  MessageCursor cursor_;
};

// The first difference between two recordings: the earliest in time and, at that instant, the first
// topic by name.
struct Difference {
  base::SimTime time{};
  std::string topic;
  // Such as "pose.position.x"; empty if the message is missing in one of the recordings; "bytes" if
  // only bytes differ that are not decoded, such as those of an image.
  std::string field;
  // The values of the field as JSON. If only one recording has the message: "there" for this
  // recording, and "missing" for the other one.
  std::string in_first, in_second;
  // The content of the message in the first recording. If the message is missing there, its content
  // in the second recording.
  nlohmann::ordered_json message = {};
  // Returns a sentence for users.
  std::string Sentence() const;
};
// Returns an object with the keys time_s, topic, field, first and second.
nlohmann::ordered_json ToJson(const Difference& difference);

// Which recording may lack messages.
enum class Gaps {
  kNone,
  // The first recording may lack messages. A topic is compared at an instant only if both
  // recordings have the same number of its messages at that instant.
  kInFirst,
};

// Compares the reproducible messages (see content_hash.h) of the selected topics. Returns nullopt
// if there is no difference.
base::Result<std::optional<Difference>> FirstDifference(const McapReader& first,
                                                        const McapReader& second,
                                                        const std::vector<std::string>& topics = {},
                                                        Gaps gaps = Gaps::kNone);

// Returns a table of one topic (RFC 4180). It has a row per message and a column per number or
// text, such as "ranges.0", in the order of first appearance. Numbers that are not finite are
// written "inf", "-inf" and "nan".
base::Result<std::string> ToCsv(const McapReader& reader, const Selection& selection);

}  // namespace gsv::recording
