// For tests: clients of a gateway. All calls block; failures throw.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "gsv/gateway/testing/recording_client.h"

namespace gsv::gateway::testing {

// A response that a test has received.
struct HttpReply {
  int status = 0;
  std::map<std::string, std::string> headers;  // names in lower case
  std::string body;
};

// A TCP connection for hand-written HTTP.
class HttpConnection {
 public:
  explicit HttpConnection(std::uint16_t port);
  ~HttpConnection();

  // Sends these bytes.
  void Send(const std::string& bytes);
  // Receives the next response; nullopt at the connection's end. `has_body`: false for a HEAD
  // request.
  std::optional<HttpReply> Receive(bool has_body = true);
  // Waits until data arrive or the connection ends. Returns whether it ended.
  bool IsClosed();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Returns the text of an HTTP request.
std::string RequestText(std::uint16_t port, const std::string& method, const std::string& target,
                        const std::string& more_headers = "", const std::string& body = "");
// Sends one request on a new connection.
HttpReply Fetch(std::uint16_t port, const std::string& method, const std::string& target,
                const std::string& more_headers = "", const std::string& body = "");

// A viewer: a WebSocket that speaks the Foxglove protocol.
class Viewer {
 public:
  // A message from the server.
  struct Frame {
    bool is_text = false;
    std::string bytes;

    nlohmann::json json() const { return nlohmann::json::parse(bytes); }
    ReceivedData data() const { return ParseData(bytes); }
  };

  // Throws std::runtime_error with the server's answer if the server refuses.
  explicit Viewer(std::uint16_t port, const std::string& target = "/ws",
                  const std::string& subprotocols = "foxglove.sdk.v1",
                  const std::string& origin = "");
  ~Viewer();

  const std::string& subprotocol() const;  // The subprotocol that the server chose.
  void SendText(const std::string& text);
  void SendBinary(const std::string& bytes);
  void SendRaw(const std::string& bytes);  // sends bytes without framing
  // Receives the next message; nullopt when the connection has ended.
  std::optional<Frame> Receive();
  // Receives the next text with that operation; skips other texts.
  nlohmann::json ReceiveText(const std::string& op);
  // Receives the next message of a subscription; keeps messages of other subscriptions for later.
  ReceivedData ReceiveData(foxglove::SubscriptionId subscription);
  // Receives the next binary message with that opcode; keeps data for later and skips other
  // messages.
  std::string ReceiveBytes(char opcode);
  // Waits for the advertisement of a service (/gsv/NAME) and calls it with a request in CDR.
  // Returns `success` and `message` of the response.
  std::pair<bool, std::string> CallService(const std::string& name,
                                           const std::string& request = "");
  // Makes a call that must be refused, and returns the sentence.
  std::string CallRefusedService(const std::string& name);
  // Waits for the advertisement of a topic, then subscribes.
  void Subscribe(foxglove::SubscriptionId id, const std::string& topic);

  // These functions return the close code and reason of the server.
  std::uint16_t close_code() const;
  std::string close_reason() const;
  // Closes the connection.
  void Close();

 private:
  // Stores data of other subscriptions for ReceiveData().
  void Keep(const Frame& frame);
  // Sends a service call.
  void SendCall(const std::string& name, const std::string& request);

  struct Impl;
  std::unique_ptr<Impl> impl_;
  std::map<std::string, foxglove::ChannelId> channels_;  // advertised channels, by topic
  std::map<std::string, std::uint32_t> services_;        // advertised services, by name
  // received data that wait for ReceiveData()
  std::map<foxglove::SubscriptionId, std::deque<ReceivedData>> kept_;
};

}  // namespace gsv::gateway::testing
