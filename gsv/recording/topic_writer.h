// One message type on one topic of a recording.
#pragma once

#include "gsv/base/check.h"
#include "gsv/messages/cdr.h"
#include "gsv/recording/mcap_writer.h"

namespace gsv::recording {

template <typename Message>
class TopicWriter {
 public:
  // `writer` must outlive this; no other type may be on the topic.
  TopicWriter(McapWriter& writer, const std::string& topic, const ChannelOptions& options = {})
      : writer_(writer) {
    const auto channel = writer.AddChannel(topic, messages::SchemaOf<Message>(), options);
    GSV_CHECK(channel.has_value());
    channel_ = *channel;
  }

  void Write(base::SimTime time, const Message& message) {
    bytes_.clear();
    messages::Encode(message, bytes_);
    writer_.Write(channel_, time, bytes_);
  }

 private:
  McapWriter& writer_;
  ChannelId channel_ = 0;
  Bytes bytes_;
};

}  // namespace gsv::recording
