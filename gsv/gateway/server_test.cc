#include "gsv/gateway/server.h"

#include <condition_variable>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/gateway/testing/web_client.h"

namespace gsv::gateway {
namespace {

using testing::Fetch;
using testing::HttpConnection;
using testing::HttpReply;
using testing::RequestText;
using testing::Viewer;

// Repeats what it is asked; every WebSocket joins its one hub, which has the channel "/numbers".
class Echo final : public Handler {
 public:
  Echo() { channel_ = hub_->Advertise({{0, "/numbers", "json", "", "", ""}}).front(); }

  void Handle(Request request, Respond respond) override {
    Response response;
    response.content_type = "text/plain";
    response.body = SharedBytes(request.method + " " + request.raw_target + " " + request.body);
    respond(std::move(response));
  }

  base::Result<std::shared_ptr<Hub>> FindHub(const Target& target) override {
    if (!target.query.contains("none")) return hub_;
    return base::Fail(base::ErrorCode::kNotFound, "there is no hub");
  }

  Hub& hub() { return *hub_; }
  foxglove::ChannelId channel() const { return channel_; }

  // Waits until the hub is as asked; it tells of every change.
  template <typename Condition>
  void WaitUntil(Condition condition) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, condition);
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<Hub> hub_ =
      std::make_shared<Hub>(foxglove::ServerInfo{"echo", {}, {}, "1"}, [this] {
        const std::lock_guard lock(mutex_);
        changed_.notify_all();
      });
  foxglove::ChannelId channel_ = 0;
};

class ServerTest : public ::testing::Test {
 protected:
  void Start(ServerOptions options = {}) {
    auto server = Server::Start(options, echo_);
    ASSERT_TRUE(server) << server.error().Sentence();
    server_ = std::move(*server);
  }
  std::uint16_t port() const { return server_->port(); }

  Echo echo_;
  std::unique_ptr<Server> server_;
};

TEST_F(ServerTest, AnswersRequests) {
  Start();
  EXPECT_EQ(server_->url(), "http://127.0.0.1:" + std::to_string(port()) + "/");
  const HttpReply reply = Fetch(port(), "POST", "/a?b=c", "", "body");
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body, "POST /a?b=c body");
  EXPECT_EQ(reply.headers.at("content-type"), "text/plain");
  EXPECT_EQ(reply.headers.at("x-content-type-options"), "nosniff");
}

TEST_F(ServerTest, AHeadRequestGetsTheHeaderOfAGet) {
  Start();
  const HttpReply reply = Fetch(port(), "HEAD", "/abc");
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.headers.at("content-length"), std::to_string(std::string("GET /abc ").size()));
}

TEST_F(ServerTest, AConnectionServesManyRequests) {
  Start();
  HttpConnection connection(port());
  connection.Send(RequestText(port(), "GET", "/1") + RequestText(port(), "GET", "/2"));
  EXPECT_EQ(connection.Receive()->body, "GET /1 ");
  EXPECT_EQ(connection.Receive()->body, "GET /2 ");
  connection.Send(RequestText(port(), "GET", "/3", "Connection: close\r\n"));
  EXPECT_EQ(connection.Receive()->body, "GET /3 ");
  EXPECT_TRUE(connection.IsClosed());
}

TEST_F(ServerTest, RefusesStrangersByNameAndOrigin) {
  Start();
  EXPECT_EQ(Fetch(port(), "GET", "/", "Host: evil.example\r\n").status, 403);
  EXPECT_EQ(Fetch(port(), "GET", "/", "Origin: http://evil.example\r\n").status, 403);
  EXPECT_EQ(Fetch(port(), "GET", "/", "Origin: null\r\n").status, 403);
  const std::string own = "Origin: http://localhost:" + std::to_string(port()) + "\r\n";
  EXPECT_EQ(Fetch(port(), "GET", "/", own).status, 200);
  EXPECT_THROW(Viewer(port(), "/ws", "foxglove.sdk.v1", "http://evil.example"), std::runtime_error);
}

TEST_F(ServerTest, RefusesWhatIsNoRequest) {
  Start();
  for (const std::string& bytes :
       {std::string("\x16\x03\x01 hello\r\n\r\n"), std::string("GET\r\n\r\n"),
        std::string("GET / HTTP/1.1\r\nbad header\r\n\r\n"),
        std::string("POST / HTTP/1.1\r\nContent-Length: x\r\n\r\n"),
        RequestText(port(), "GET", "/%zz")}) {
    HttpConnection connection(port());
    connection.Send(bytes);
    const auto reply = connection.Receive();
    ASSERT_TRUE(reply) << bytes;
    EXPECT_EQ(reply->status, 400) << bytes;
    EXPECT_NE(reply->body.find("\"error\""), std::string::npos);
  }
}

TEST_F(ServerTest, LimitsHeadersAndBodies) {
  Start();
  EXPECT_EQ(Fetch(port(), "GET", "/", "X: " + std::string(20'000, 'x') + "\r\n").status, 431);
  HttpConnection connection(port());
  connection.Send("POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 99999999999\r\n\r\n");
  EXPECT_EQ(connection.Receive()->status, 413);
  EXPECT_TRUE(connection.IsClosed());
}

TEST_F(ServerTest, HangsUpOnWhoeverDoesNotFinishARequest) {
  ServerOptions options;
  options.limits.request_time = std::chrono::milliseconds(50);
  Start(options);
  HttpConnection connection(port());
  connection.Send("GET / HTTP/1.1\r\nHos");
  EXPECT_TRUE(connection.IsClosed());
}

TEST_F(ServerTest, TurnsAwayOneConnectionTooMany) {
  ServerOptions options;
  options.limits.connections = 2;
  Start(options);
  Viewer first(port()), second(port());
  first.ReceiveText("serverInfo");
  second.ReceiveText("serverInfo");
  HttpConnection third(port());
  EXPECT_EQ(third.Receive()->status, 503);
  first.Close();
  echo_.WaitUntil([&] { return true; });
  EXPECT_TRUE(second.Receive());
}

TEST_F(ServerTest, APortThatIsTakenIsNamed) {
  Start();
  ServerOptions options;
  options.port = port();
  const auto other = Server::Start(options, echo_);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, base::ErrorCode::kUnavailable);
  EXPECT_EQ(other.error().Sentence(),
            "127.0.0.1:" + std::to_string(port()) +
                ": the port is used by another program; give another one, or --port 0 to let the "
                "system choose");
}

TEST_F(ServerTest, AnAddressThatIsNoneIsNamed) {
  ServerOptions options;
  options.host = "nowhere.example";
  EXPECT_EQ(Server::Start(options, echo_).error().code, base::ErrorCode::kInvalidArgument);
  options.host = "203.0.113.7";  // documentation's own: no machine has it
  EXPECT_EQ(Server::Start(options, echo_).error().code, base::ErrorCode::kUnavailable);
}

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

TEST_F(ServerTest, ClosesWithASentenceOnNonsense) {
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

TEST_F(ServerTest, PublishingIsRefusedAndTheConnectionGoesOn) {
  Start();
  Viewer publisher(port());
  publisher.SendBinary("\x01xxxx");
  EXPECT_EQ(publisher.ReceiveText("status")["message"],
            "this server does not offer the operation 'message data'");
  publisher.SendText(R"({"op":"getParameters","parameterNames":[]})");
  EXPECT_EQ(publisher.ReceiveText("status")["message"],
            "this server offers neither services nor parameters");
}

TEST_F(ServerTest, ClosesWithASentenceOnMessagesThatAreTooLong) {
  ServerOptions options;
  options.limits.message_bytes = 1000;
  Start(options);
  Viewer viewer(port());
  viewer.SendText(std::string(50'000, ' '));
  EXPECT_EQ(viewer.ReceiveText("status")["message"], "a message is longer than 1000 bytes");
  EXPECT_FALSE(viewer.Receive());
  EXPECT_EQ(viewer.close_code(), 1009);
}

TEST_F(ServerTest, AFrameThatLiesAboutItsLengthEndsItsOwnConnectionOnly) {
  ServerOptions options;
  options.limits.message_bytes = 1000;
  Start(options);
  Viewer liar(port()), other(port());
  // A masked text frame of 2^40 bytes.
  liar.SendRaw(std::string("\x81\xff\x00\x00\x01\x00\x00\x00\x00\x00mask", 14));
  liar.SendRaw(std::string(50'000, 'x'));
  while (liar.Receive()) {
  }
  EXPECT_EQ(liar.close_code(), 1009);
  // An unmasked frame, which only servers may send; a reserved opcode; a reserved bit.
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

TEST_F(ServerTest, AReaderThatStallsLosesTheOldestAndCostsNobodyElse) {
  ServerOptions options;
  options.limits.send.data_messages = 4;
  Start(options);
  Viewer stalled(port()), healthy(port());
  stalled.Subscribe(1, "/numbers");
  healthy.Subscribe(1, "/numbers");
  // More than the system's socket buffers hold.
  constexpr std::uint64_t kMessages = 400;
  const std::string ballast(64 << 10, 'x');
  for (std::uint64_t i = 0; i < kMessages; ++i) {
    // Before the first message both must be subscribed.
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

TEST_F(ServerTest, AStalledReaderAmongFiftyTakesNothingFromTheOthers) {
  ServerOptions options;
  options.limits.send.data_messages = 4;
  Start(options);
  // It subscribes, and reads no more.
  Viewer stalled(port());
  stalled.Subscribe(1, "/numbers");
  std::vector<std::unique_ptr<Viewer>> others;
  for (int i = 0; i < 50; ++i) {
    others.push_back(std::make_unique<Viewer>(port()));
    others.back()->Subscribe(1, "/numbers");
    others.back()->SendText(R"({"op":"unsubscribe","subscriptionIds":[77]})");
    others.back()->ReceiveText("status");  // what was sent before has been taken, too
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

TEST_F(ServerTest, AReaderThatTakesNoControlTextsIsCutOff) {
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

TEST_F(ServerTest, AViewerThatAnswersNoPingIsGone) {
  ServerOptions options;
  options.limits.idle_time = std::chrono::milliseconds(100);
  Start(options);
  Viewer silent(port());  // reads nothing, so it answers no ping
  echo_.WaitUntil([&] { return echo_.hub().has_clients(); });
  echo_.WaitUntil([&] { return !echo_.hub().has_clients(); });
}

TEST_F(ServerTest, StopSaysGoodbye) {
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
