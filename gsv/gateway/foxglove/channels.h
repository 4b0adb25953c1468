// Makes Foxglove channels and messages for topics.
#pragma once

#include <string>

#include "gsv/gateway/foxglove/foxglove.h"
#include "gsv/gateway/foxglove/shared_bytes.h"
#include "gsv/messages/cdr.h"
#include "gsv/presentation/topics.h"

namespace gsv::gateway {

inline foxglove::Channel ChannelFor(std::string topic, const messages::Schema& schema) {
  return {0,
          std::move(topic),
          "cdr",
          std::string(schema.name),
          std::string(schema.encoding),
          std::string(schema.text)};
}

template <typename Message>
foxglove::Channel ChannelFor(const presentation::TopicOf<Message>& topic) {
  return ChannelFor(topic.name, messages::SchemaOf<Message>());
}

template <typename Message>
SharedBytes Encoded(const Message& message) {
  messages::Bytes bytes;
  messages::Encode(message, bytes);
  return SharedBytes(std::move(bytes));
}

}  // namespace gsv::gateway
