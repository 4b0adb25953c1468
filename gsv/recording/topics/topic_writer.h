// Writes messages of one type on one topic of a recording.
#pragma once

#include <optional>

#include "gsv/base/check.h"
#include "gsv/messages/cdr.h"
#include "gsv/presentation/topics.h"
#include "gsv/recording/mcap/mcap_writer.h"
#include "gsv/recording/reading/selection.h"

namespace gsv::recording {

template <typename Message>
class TopicWriter {
 public:
  // `writer` must outlive this object. If the recording already has the topic, the message types
  // must be equal. A topic that is not selected is not recorded.
  TopicWriter(McapWriter& writer, const Selection& selection,
              const presentation::TopicOf<Message>& topic)
      : writer_(writer) {
    if (!selection.Has(topic.name)) return;
    const presentation::Topic* const row = presentation::FindTopic(topic.name);
    GSV_CHECK(row != nullptr && row->is_recorded);
    const auto channel = writer.AddChannel(topic.name, messages::SchemaOf<Message>(),
                                           {.reproducible = row->is_reproducible});
    GSV_CHECK(channel.has_value());
    channel_ = *channel;
  }

  // Whether the topic is recorded. If not, the caller need not make messages.
  bool is_wanted() const { return channel_.has_value(); }

  // Writes a message, if the topic is recorded.
  void Write(base::SimTime time, const Message& message) {
    if (!channel_) return;
    bytes_.clear();
    messages::Encode(message, bytes_);
    writer_.Write(*channel_, time, bytes_);
  }

 private:
  McapWriter& writer_;
  std::optional<ChannelId> channel_;  // nullopt if the topic is not recorded
  Bytes bytes_;                       // the encoded message; its memory is reused
};

}  // namespace gsv::recording
