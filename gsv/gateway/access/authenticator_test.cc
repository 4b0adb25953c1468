// Tests authenticators that answer later, and permissions that expire.
#include "gsv/gateway/access/authenticator.h"

#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/gateway/testing/server_fixture.h"
#include "gsv/gateway/testing/web_client.h"

namespace gsv::gateway::access {
namespace {

using std::chrono::steady_clock;
using testing::HttpConnection;
using testing::HttpReply;
using testing::Viewer;

// Stores requests for authentication until the test answers them.
class PendingAuthenticator final : public Authenticator {
 public:
  void Authenticate(const Credentials& credentials, Answer answer) override {
    const std::lock_guard lock(mutex_);
    questions_.emplace_back(credentials.token, std::move(answer));
    changed_.notify_all();
  }
  std::string Refusal(const Principal&, Permission) const override { return "not for you"; }

  // Waits for a request, answers it, and returns the token that it contains.
  std::string AnswerNext(const Principal& principal) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !questions_.empty(); });
    const auto [token, answer] = std::move(questions_.front());
    questions_.erase(questions_.begin());
    lock.unlock();
    answer(principal);
    return token;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::pair<std::string, Answer>> questions_;
};

// Grants every permission at once, for a limited time.
class ExpiringAuthenticator final : public Authenticator {
 public:
  void Authenticate(const Credentials&, Answer answer) override {
    answer({Permission::kControl, true, steady_clock::now() + std::chrono::milliseconds(50)});
  }
  std::string Refusal(const Principal&, Permission) const override { return "not for you"; }
};

class AuthenticatorTest : public testing::ServerTest {
 protected:
  void StartWith(std::shared_ptr<Authenticator> authenticator) {
    ServerOptions options;
    options.authenticator = std::move(authenticator);
    Start(options);
  }
  void Put(HttpConnection& connection, const std::string& body) const {
    connection.Send(testing::RequestText(port(), "PUT", "/api/simulations",
                                         "Authorization: Bearer who\r\n", body));
  }
};

TEST_F(AuthenticatorTest, RequestsThatNeedNoPermissionDoNotWaitForTheAuthenticator) {
  const auto registry = std::make_shared<PendingAuthenticator>();
  StartWith(registry);
  HttpConnection waiting(port());
  Put(waiting, "abc");
  EXPECT_EQ(testing::Fetch(port(), "GET", "/free").status, 200);
  EXPECT_EQ(registry->AnswerNext({Permission::kControl, true}), "who");
  const auto reply = waiting.Receive();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, 200);
  EXPECT_EQ(reply->body, "PUT /api/simulations abc");
}

TEST_F(AuthenticatorTest, ARefusedRequestGetsTheReason) {
  const auto registry = std::make_shared<PendingAuthenticator>();
  StartWith(registry);
  for (const bool showed_credentials : {true, false}) {
    HttpConnection refused(port());
    Put(refused, "");
    registry->AnswerNext({Permission::kWatch, showed_credentials});
    const auto reply = refused.Receive();
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->status, showed_credentials ? 403 : 401);
    EXPECT_EQ(reply->body, R"({"error":"not for you"})");
  }
}

TEST_F(AuthenticatorTest, AnUploadIsReadAfterTheAuthenticatorHasAnswered) {
  const auto registry = std::make_shared<PendingAuthenticator>();
  StartWith(registry);
  HttpConnection connection(port());
  connection.Send("PUT /api/uploads/1/a HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port()) +
                  "\r\nContent-Length: 3\r\n\r\n");
  registry->AnswerNext({Permission::kControl, true});
  connection.Send("abc");
  EXPECT_EQ(connection.Receive()->body, "PUT /api/uploads/1/a abc");
}

TEST_F(AuthenticatorTest, AWebSocketIsClosedWhenThePermissionExpires) {
  StartWith(std::make_shared<ExpiringAuthenticator>());
  Viewer viewer(port());
  while (viewer.Receive()) {
  }
  EXPECT_EQ(viewer.close_code(), 1008);
  EXPECT_EQ(viewer.close_reason(), "your permission has expired; connect again");
}

}  // namespace
}  // namespace gsv::gateway::access
