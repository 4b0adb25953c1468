// For tests of the server: one that repeats what it is asked.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>

#include <gtest/gtest.h>

#include "gsv/gateway/server/server.h"

namespace gsv::gateway::testing {

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

}  // namespace gsv::gateway::testing
