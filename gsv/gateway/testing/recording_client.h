// For tests: a client that keeps all messages.
#pragma once

#include <cstring>
#include <mutex>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/messages/cdr.h"

namespace gsv::gateway::testing {

// A binary message that a client has received, parsed.
struct ReceivedData {
  int opcode = 0;                             // 1: message of a subscription; 2: time
  foxglove::SubscriptionId subscription = 0;  // opcode 1
  std::uint64_t time_ns = 0;
  std::string payload;
};

// Parses a binary message, implemented independently from the specification.
inline ReceivedData ParseData(const std::string& bytes) {
  ReceivedData data;
  data.opcode = bytes.at(0);
  const std::size_t time_at = data.opcode == 1 ? 5 : 1;
  if (data.opcode == 1) std::memcpy(&data.subscription, bytes.substr(1, 4).data(), 4);
  std::memcpy(&data.time_ns, bytes.substr(time_at, 8).data(), 8);
  data.payload = bytes.substr(time_at + 8);
  return data;
}

template <typename Message>
Message Decoded(const ReceivedData& data) {
  const auto bytes = std::as_bytes(std::span(data.payload));
  return messages::Decode<Message>(bytes).value();
}

// A client that keeps all messages.
class RecordingClient final : public Client {
 public:
  void SendText(SharedBytes text) override {
    const std::lock_guard lock(mutex_);
    texts_.push_back(nlohmann::json::parse(text.view()));
  }

  void SendBytes(SharedBytes bytes) override {
    const std::lock_guard lock(mutex_);
    answers_.emplace_back(bytes.view());
  }

  void SendData(const foxglove::BinaryHeader& header, SharedBytes payload, Delivery) override {
    const std::lock_guard lock(mutex_);
    std::string bytes(reinterpret_cast<const char*>(header.bytes.data()), header.size);
    bytes += payload.view();
    data_.push_back(ParseData(bytes));
  }

  std::uint64_t dropped_updates() const override { return 7; }

  void Close(CloseCode code, std::string reason) override {
    const std::lock_guard lock(mutex_);
    close_code_ = code;
    close_reason_ = std::move(reason);
  }

  // Returns the text messages.
  std::vector<nlohmann::json> texts() const {
    const std::lock_guard lock(mutex_);
    return texts_;
  }

  // Returns the binary control messages.
  std::vector<std::string> answers() const {
    const std::lock_guard lock(mutex_);
    return answers_;
  }

  // Returns the messages of one subscription.
  std::vector<ReceivedData> data(foxglove::SubscriptionId subscription) const {
    const std::lock_guard lock(mutex_);
    std::vector<ReceivedData> found;
    for (const ReceivedData& data : data_) {
      if (data.opcode == 1 && data.subscription == subscription) found.push_back(data);
    }
    return found;
  }

  // Returns the times that the server sent, in nanoseconds.
  std::vector<std::uint64_t> times() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::uint64_t> times;
    for (const ReceivedData& data : data_) {
      if (data.opcode == 2) times.push_back(data.time_ns);
    }
    return times;
  }

  // Returns the channel of a topic according to the latest advertisement; 0 if there is none.
  foxglove::ChannelId ChannelOf(const std::string& topic) const {
    foxglove::ChannelId id = 0;
    for (const nlohmann::json& text : texts()) {
      if (text["op"] == "advertise") {
        for (const auto& channel : text["channels"]) {
          if (channel["topic"] == topic) id = channel["id"];
        }
      } else if (text["op"] == "unadvertise") {
        for (const auto& gone : text["channelIds"]) {
          if (gone == id) id = 0;
        }
      }
    }
    return id;
  }

  std::string close_reason() const {
    const std::lock_guard lock(mutex_);
    return close_reason_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<nlohmann::json> texts_;
  std::vector<std::string> answers_;
  std::vector<ReceivedData> data_;
  CloseCode close_code_{};
  std::string close_reason_;
};

inline std::string SubscribeText(foxglove::SubscriptionId id, foxglove::ChannelId channel) {
  return nlohmann::json{{"op", "subscribe"},
                        {"subscriptions", {{{"id", id}, {"channelId", channel}}}}}
      .dump();
}

inline std::string UnsubscribeText(foxglove::SubscriptionId id) {
  return nlohmann::json{{"op", "unsubscribe"}, {"subscriptionIds", {id}}}.dump();
}

}  // namespace gsv::gateway::testing
