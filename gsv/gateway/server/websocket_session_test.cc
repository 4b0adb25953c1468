#include "gsv/gateway/server/websocket_session.h"

#include <thread>

#include <gtest/gtest.h>

#include "gsv/gateway/server/send_window.h"
#include "gsv/gateway/testing/server_fixture.h"
#include "gsv/gateway/testing/web_client.h"

namespace gsv::gateway {
namespace {

using testing::Fetch;
using testing::HttpConnection;
using testing::ServerTest;
using testing::Viewer;

TEST_F(ServerTest, SpeaksBothSubprotocolsAndNoOther) {
  Start();
  EXPECT_EQ(Viewer(port(), "/ws", "foxglove.websocket.v1").subprotocol(), "foxglove.websocket.v1");
  EXPECT_EQ(Viewer(port(), "/ws", "foxglove.sdk.v1").subprotocol(), "foxglove.sdk.v1");
  EXPECT_EQ(Viewer(port(), "/ws", "foxglove.websocket.v1, foxglove.sdk.v1").subprotocol(),
            "foxglove.sdk.v1");
  EXPECT_THROW(Viewer(port(), "/ws", "chat"), std::runtime_error);
  EXPECT_THROW(Viewer(port(), "/ws", ""), std::runtime_error);
  EXPECT_THROW(Viewer(port(), "/elsewhere"), std::runtime_error);
  EXPECT_THROW(Viewer(port(), "/ws?none"), std::runtime_error);
}

TEST_F(ServerTest, DataReachesASubscriber) {
  Start();
  Viewer viewer(port());
  viewer.Subscribe(3, "/numbers");
  echo_.WaitUntil([&] { return echo_.hub().IsSubscribed(echo_.channel()); });
  echo_.hub().Publish(echo_.channel(), {42, SharedBytes(std::string("seven"))});
  const testing::ReceivedData data = viewer.ReceiveData(3);
  EXPECT_EQ(data.time_ns, 42u);
  EXPECT_EQ(data.payload, "seven");
}

TEST_F(ServerTest, ClosesTheConnectionWithTheReasonOnInvalidMessages) {
  Start();
  Viewer talker(port());
  talker.SendText("hello");
  EXPECT_NE(talker.ReceiveText("status")["message"].get<std::string>().find("JSON object"),
            std::string::npos);
  EXPECT_FALSE(talker.Receive());
  EXPECT_EQ(talker.close_code(), 1008);
  EXPECT_NE(talker.close_reason().find("JSON object"), std::string::npos);

  Viewer binary(port());
  binary.SendBinary("\x09xxxx");
  while (binary.Receive()) {
  }
  EXPECT_EQ(binary.close_code(), 1008);
}

TEST_F(ServerTest, PublishingIsRefusedAndTheConnectionStays) {
  Start();
  Viewer publisher(port());
  publisher.SendBinary("\x01xxxx");
  EXPECT_EQ(publisher.ReceiveText("status")["message"],
            "this server does not offer the operation 'message data'");
  publisher.SendText(R"({"op":"getParameters","parameterNames":[]})");
  EXPECT_EQ(publisher.ReceiveText("status")["message"],
            "this server offers neither services nor parameters");
}

TEST_F(ServerTest, ClosesTheConnectionWithTheReasonOnMessagesThatAreTooLong) {
  ServerOptions options;
  options.limits.message_bytes = 1000;
  Start(options);
  Viewer viewer(port());
  viewer.SendText(std::string(50'000, ' '));
  EXPECT_EQ(viewer.ReceiveText("status")["message"], "a message is longer than 1000 bytes");
  EXPECT_FALSE(viewer.Receive());
  EXPECT_EQ(viewer.close_code(), 1009);
}

TEST_F(ServerTest, FrameWithAWrongLengthEndsOnlyItsConnection) {
  ServerOptions options;
  options.limits.message_bytes = 1000;
  Start(options);
  Viewer liar(port()), other(port());
  // A masked text frame that declares 2^40 bytes.
  liar.SendRaw(std::string("\x81\xff\x00\x00\x01\x00\x00\x00\x00\x00mask", 14));
  liar.SendRaw(std::string(50'000, 'x'));
  while (liar.Receive()) {
  }
  EXPECT_EQ(liar.close_code(), 1009);
  // Each frame is invalid: it has a reserved opcode or a reserved bit, or it is not masked. (Only a
  // server may send frames that are not masked.)
  for (const std::string& bytes :
       {std::string("\x81\x01x"), std::string("\x83\x80mask"), std::string("\xf1\x80mask")}) {
    Viewer breaker(port());
    breaker.SendRaw(bytes);
    while (breaker.Receive()) {
    }
    EXPECT_EQ(breaker.close_code(), 1002);
  }
  EXPECT_EQ(other.ReceiveText("serverInfo")["name"], "echo");
}

TEST_F(ServerTest, AStalledClientLosesOldDataAndDoesNotDelayOthers) {
  ServerOptions options;
  options.limits.send.data_messages = 4;
  // The stalled client reads no pings, so a shorter limit would disconnect it.
  options.limits.idle_time = std::chrono::minutes(10);
  Start(options);
  Viewer stalled(port()), healthy(port());
  stalled.Subscribe(1, "/numbers");
  healthy.Subscribe(1, "/numbers");
  // The messages are more than the system's socket buffers can hold.
  constexpr std::uint64_t kMessages = 400;
  const std::string ballast(64 << 10, 'x');
  for (std::uint64_t i = 0; i < kMessages; ++i) {
    // Both clients must be subscribed before the first message is sent. The request with an unknown
    // ID is answered with a warning, after the server has processed the earlier Subscribe().
    if (i == 0) {
      healthy.SendText(R"({"op":"unsubscribe","subscriptionIds":[77]})");
      stalled.SendText(R"({"op":"unsubscribe","subscriptionIds":[77]})");
      healthy.ReceiveText("status");
      stalled.ReceiveText("status");
    }
    echo_.hub().Publish(echo_.channel(), {i, SharedBytes(ballast)});
    ASSERT_EQ(healthy.ReceiveData(1).time_ns, i);
  }
  std::vector<std::uint64_t> seen;
  while (seen.empty() || seen.back() != kMessages - 1) {
    seen.push_back(stalled.ReceiveData(1).time_ns);
    ASSERT_TRUE(seen.size() < 2 || seen.back() > seen[seen.size() - 2]);
  }
  EXPECT_EQ(seen.front(), 0u);
  EXPECT_LT(seen.size(), kMessages);
}

TEST_F(ServerTest, AClientThatAnswersNoPingsGetsOneWindowUntilItReadsAgain) {
  ServerOptions options;
  options.traffic = std::make_shared<metrics::Traffic>();
  Start(options);
  Viewer stalled(port()), healthy(port());
  for (Viewer* const viewer : {&stalled, &healthy}) {
    viewer->Subscribe(1, "/numbers");
    viewer->SendText(R"({"op":"unsubscribe","subscriptionIds":[77]})");
    viewer->ReceiveText("status");
  }
  constexpr std::uint64_t kMessages = 200, kSize = 1 << 10, kHeader = 13;
  const SharedBytes ballast(std::string(kSize, 'x'));
  const std::uint64_t earlier = options.traffic->sent_bytes;
  for (std::uint64_t i = 0; i < kMessages; ++i) {
    echo_.hub().Publish(echo_.channel(), {i, ballast});
    ASSERT_EQ(healthy.ReceiveData(1).time_ns, i);
  }
  const std::uint64_t healthy_bytes = kMessages * (kSize + kHeader);
  const std::uint64_t sent = options.traffic->sent_bytes - earlier;
  EXPECT_LE(sent, healthy_bytes + SendWindow::kFirstBytes + kSize + kHeader);
  std::uint64_t last = stalled.ReceiveData(1).time_ns;
  EXPECT_EQ(last, 0u);
  while (last != kMessages - 1) {
    const std::uint64_t next = stalled.ReceiveData(1).time_ns;
    ASSERT_GT(next, last);
    last = next;
  }
}

TEST_F(ServerTest, AStalledReaderAmongFiftyDoesNotDelayTheOthers) {
  ServerOptions options;
  options.limits.send.data_messages = 4;
  // The stalled client reads no pings, so a shorter limit would disconnect it.
  options.limits.idle_time = std::chrono::minutes(10);
  Start(options);
  // The client subscribes, and then does not read any more.
  Viewer stalled(port());
  stalled.Subscribe(1, "/numbers");
  std::vector<std::unique_ptr<Viewer>> others;
  for (int i = 0; i < 50; ++i) {
    others.push_back(std::make_unique<Viewer>(port()));
    others.back()->Subscribe(1, "/numbers");
    others.back()->SendText(R"({"op":"unsubscribe","subscriptionIds":[77]})");
    // The answer to this request, a warning, comes after the subscription. So the client gets all
    // messages from now on.
    others.back()->ReceiveText("status");
  }
  constexpr std::uint64_t kMessages = 60;
  const SharedBytes ballast(std::string(256 << 10, 'x'));
  for (std::uint64_t i = 0; i < kMessages; ++i) {
    echo_.hub().Publish(echo_.channel(), {i, ballast});
    for (const auto& viewer : others) ASSERT_EQ(viewer->ReceiveData(1).time_ns, i);
  }
  others.clear();
  std::vector<std::uint64_t> seen;
  while (seen.empty() || seen.back() != kMessages - 1) {
    seen.push_back(stalled.ReceiveData(1).time_ns);
  }
  EXPECT_LT(seen.size(), kMessages);
}

TEST_F(ServerTest, AClientThatReadsNoControlMessagesIsDisconnected) {
  ServerOptions options;
  options.limits.send.control_bytes = 1 << 20;
  Start(options);
  Viewer stalled(port());
  stalled.ReceiveText("advertise");
  const std::string ballast(64 << 10, 'x');
  for (int i = 0; i < 400; ++i) echo_.hub().SendStatus(foxglove::StatusLevel::kInfo, ballast);
  echo_.WaitUntil([&] { return !echo_.hub().has_clients(); });
  EXPECT_EQ(Fetch(port(), "GET", "/still").body, "GET /still ");
}

TEST_F(ServerTest, AViewerThatAnswersNoPingIsDisconnected) {
  ServerOptions options;
  options.limits.idle_time = std::chrono::milliseconds(100);
  Start(options);
  Viewer silent(port());  // this client reads nothing, so it does not answer pings
  echo_.WaitUntil([&] { return echo_.hub().has_clients(); });
  echo_.WaitUntil([&] { return !echo_.hub().has_clients(); });
}

TEST_F(ServerTest, StopClosesConnectionsInOrder) {
  Start();
  Viewer viewer(port());
  HttpConnection idle(port());
  viewer.ReceiveText("advertise");
  std::thread stopper([&] { server_->Stop(); });
  while (viewer.Receive()) {
  }
  EXPECT_EQ(viewer.close_code(), 1001);
  EXPECT_EQ(viewer.close_reason(), "the server is shutting down");
  EXPECT_TRUE(idle.IsClosed());
  stopper.join();
  EXPECT_THROW(HttpConnection{port()}, std::exception);
}

}  // namespace
}  // namespace gsv::gateway
