// Fuzz test: passes each line of the input to the hub of a simulation as a viewer's message. In a
// line, \\ and \n are escapes. A line that begins with a tab is a binary message. The whole input
// is also parsed as one message of another instance, as a relay does.
#include <atomic>
#include <cstdint>
#include <set>

#include "gsv/base/check.h"
#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/live/live_operations.h"
#include "gsv/gateway/testing/scripted_simulation.h"
#include "gsv/gateway/upstream/protocol.h"

using namespace gsv;
using namespace gsv::gateway;

namespace {

// A client that counts the bytes of the messages to it, and checks the size of their headers.
class CountingClient final : public Client {
 public:
  void SendText(SharedBytes text) override { bytes += text.size(); }
  void SendBytes(SharedBytes message) override { bytes += message.size(); }
  void SendData(const foxglove::BinaryHeader& header, SharedBytes payload, Delivery) override {
    GSV_CHECK(header.size == 13);
    bytes += payload.size();
  }
  void Close(CloseCode, std::string) override {}

  std::atomic<std::size_t> bytes = 0;  // atomic, because services answer from another thread
};

std::string Unescaped(std::string_view line) {
  std::string bytes;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_escape = line[i] == '\\' && i + 1 < line.size();
    if (is_escape) ++i;
    bytes += is_escape && line[i] == 'n' ? '\n' : line[i];
  }
  return bytes;
}

void SendToHub(std::string_view lines) {
  static const auto simulation = std::make_shared<gateway::testing::ScriptedSimulation>("arena", 1);
  static WorkerPool workers(1, 1);
  static const auto operations = std::make_shared<LiveOperations>(simulation, workers, nullptr);
  Hub hub(
      {"fuzz", {}, {}, "1"}, [] {}, operations);
  const auto client = std::make_shared<CountingClient>();
  hub.Add(client);
  const auto channels = hub.Advertise({{0, "/a", "cdr", "p/msg/N", "ros2msg", "int32 x"}});
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const std::string message = Unescaped(lines.substr(0, end));
    const base::Status taken = message.starts_with('\t')
                                   ? hub.ReceiveBytes(client.get(), message.substr(1))
                                   : hub.Receive(client.get(), message);
    GSV_CHECK(taken.has_value() || !taken.error().message.empty());
    lines.remove_prefix(std::min(end + 1, lines.size()));
    hub.Publish(channels.front(), {1, SharedBytes(std::string("x"))});
    hub.PublishChanges();
  }
  hub.Remove(client.get());
  GSV_CHECK(!hub.has_clients() && hub.SubscribedChannels().empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  SendToHub(text);
  (void)upstream::ParseServerText(text);
  (void)upstream::ParseServerData(text);
  return 0;
}
