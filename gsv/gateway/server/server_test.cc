#include "gsv/gateway/server/server.h"

#include <chrono>

#include <gtest/gtest.h>

#include "gsv/gateway/testing/server_fixture.h"
#include "gsv/gateway/testing/web_client.h"

namespace gsv::gateway {
namespace {

using testing::Fetch;
using testing::HttpConnection;
using testing::HttpReply;
using testing::RequestText;
using testing::ServerTest;
using testing::Viewer;

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

TEST_F(ServerTest, ARequestMayArriveInPieces) {
  Start();
  HttpConnection connection(port());
  const std::string body(50'000, 'x');
  const std::string text = RequestText(port(), "POST", "/1", "", body);
  std::size_t start = 0;
  for (const std::size_t end : {1, 3, 20, 21, 300, 20'000, 49'000}) {
    connection.Send(text.substr(start, end - start));
    start = end;
  }
  connection.Send(text.substr(start) + RequestText(port(), "GET", "/2"));
  EXPECT_EQ(connection.Receive()->body, "POST /1 " + body);
  EXPECT_EQ(connection.Receive()->body, "GET /2 ");
}

TEST_F(ServerTest, RefusesOtherNamesAndOrigins) {
  Start();
  EXPECT_EQ(Fetch(port(), "GET", "/", "Host: evil.example\r\n").status, 403);
  EXPECT_EQ(Fetch(port(), "GET", "/", "Origin: http://evil.example\r\n").status, 403);
  EXPECT_EQ(Fetch(port(), "GET", "/", "Origin: null\r\n").status, 403);
  const std::string own = "Origin: http://localhost:" + std::to_string(port()) + "\r\n";
  EXPECT_EQ(Fetch(port(), "GET", "/", own).status, 200);
  EXPECT_THROW(Viewer(port(), "/ws", "foxglove.sdk.v1", "http://evil.example"), std::runtime_error);
}

TEST_F(ServerTest, RefusesInvalidRequests) {
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

TEST_F(ServerTest, DisconnectsAClientThatDoesNotFinishARequest) {
  ServerOptions options;
  options.limits.request_time = std::chrono::milliseconds(50);
  Start(options);
  HttpConnection connection(port());
  connection.Send("GET / HTTP/1.1\r\nHos");
  EXPECT_TRUE(connection.IsClosed());
}

TEST_F(ServerTest, RefusesConnectionsBeyondTheLimit) {
  ServerOptions options;
  options.limits.connections = 2;
  Start(options);
  Viewer first(port()), second(port());
  first.ReceiveText("serverInfo");
  second.ReceiveText("serverInfo");
  HttpConnection third(port());
  EXPECT_EQ(third.Receive()->status, 503);
  // The second client stays, and the first one leaves.
  second.Subscribe(1, "/numbers");
  echo_.WaitUntil([&] { return echo_.hub().IsSubscribed(echo_.channel()); });
  first.Close();
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  int status = 503;
  while (status == 503 && std::chrono::steady_clock::now() < give_up)
    status = Fetch(port(), "GET", "/").status;
  EXPECT_EQ(status, 200);
}

TEST_F(ServerTest, ReportsAPortInUse) {
  Start();
  ServerOptions options;
  options.port = port();
  const auto other = Server::Start(options, echo_);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, base::ErrorCode::kUnavailable);
  EXPECT_EQ(
      other.error().Sentence(),
      "127.0.0.1:" + std::to_string(port()) +
          ": another program uses the port; choose another port, or --port 0 for any free one");
}

TEST_F(ServerTest, ReportsAnInvalidAddress) {
  ServerOptions options;
  options.host = "nowhere.example";
  EXPECT_EQ(Server::Start(options, echo_).error().code, base::ErrorCode::kInvalidArgument);
  options.host = "203.0.113.7";  // this address is reserved for documentation, so no machine has it
  options.tokens.watch = "a-token-that-nobody-guesses";
  EXPECT_EQ(Server::Start(options, echo_).error().code, base::ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace gsv::gateway
