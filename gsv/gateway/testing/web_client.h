// For tests: the other end of a gateway's sockets. Everything blocks; a failure throws.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "gsv/gateway/testing/recording_client.h"

namespace gsv::gateway::testing {

struct HttpReply {
  int status = 0;
  std::map<std::string, std::string> headers;  // names in lower case
  std::string body;
};

// One TCP connection on which HTTP is written by hand.
class HttpConnection {
 public:
  explicit HttpConnection(std::uint16_t port);
  ~HttpConnection();

  void Send(const std::string& bytes);
  // The next answer; `has_body` false: to a HEAD request. Empty when the server has hung up.
  std::optional<HttpReply> Receive(bool has_body = true);
  bool IsClosed();  // waits until the server has said something or hung up

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

std::string RequestText(std::uint16_t port, const std::string& method, const std::string& target,
                        const std::string& more_headers = "", const std::string& body = "");
// One request on a connection of its own.
HttpReply Fetch(std::uint16_t port, const std::string& method, const std::string& target,
                const std::string& more_headers = "", const std::string& body = "");

// A viewer: a WebSocket that speaks the Foxglove protocol.
class Viewer {
 public:
  struct Frame {
    bool is_text = false;
    std::string bytes;

    nlohmann::json json() const { return nlohmann::json::parse(bytes); }
    ReceivedData data() const { return ParseData(bytes); }
  };

  // Throws std::runtime_error with the server's answer when it refuses.
  explicit Viewer(std::uint16_t port, const std::string& target = "/ws",
                  const std::string& subprotocols = "foxglove.sdk.v1",
                  const std::string& origin = "");
  ~Viewer();

  const std::string& subprotocol() const;  // that the server chose
  void SendText(const std::string& text);
  void SendBinary(const std::string& bytes);
  void SendRaw(const std::string& bytes);  // past the protocol
  // The next message; empty when the connection has ended.
  std::optional<Frame> Receive();
  // The next text of that operation; other texts are passed over.
  nlohmann::json ReceiveText(const std::string& op);
  // The next message of a subscription; those of others are kept until they are asked for.
  ReceivedData ReceiveData(foxglove::SubscriptionId subscription);
  // The next binary message of that opcode; data are kept until they are asked for, others passed
  // over.
  std::string ReceiveBytes(char opcode);
  // Calls a service (/gsv/NAME), whose advertisement is waited for, with a request in CDR; gives
  // the response's `success` and `message`.
  std::pair<bool, std::string> CallService(const std::string& name,
                                           const std::string& request = "");
  // The same where the call itself is refused; gives the sentence.
  std::string CallRefusedService(const std::string& name);
  // Waits for the advertisement of a topic, then subscribes.
  void Subscribe(foxglove::SubscriptionId id, const std::string& topic);

  // After the end: what the server said.
  std::uint16_t close_code() const;
  std::string close_reason() const;
  void Close();

 private:
  void Keep(const Frame& frame);
  void SendCall(const std::string& name, const std::string& request);

  struct Impl;
  std::unique_ptr<Impl> impl_;
  std::map<std::string, foxglove::ChannelId> channels_;
  std::map<std::string, std::uint32_t> services_;
  std::map<foxglove::SubscriptionId, std::deque<ReceivedData>> kept_;
};

}  // namespace gsv::gateway::testing
