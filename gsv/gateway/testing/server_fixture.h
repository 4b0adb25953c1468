// For tests of the server: an echo server.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/gateway/server/server.h"

namespace gsv::gateway::testing {

// Echoes requests. Every WebSocket joins its hub, which has the channel "/numbers".
class Echo final : public Handler {
 public:
  Echo() { channel_ = hub_->Advertise({{0, "/numbers", "json", "", "", ""}}).front(); }

  const Router& router() const override { return router_; }

  void Handle(const Route& route, Request request, Respond respond) override {
    respond(route.handler(request));
  }

  Hub& hub() { return *hub_; }
  foxglove::ChannelId channel() const { return channel_; }

  // Waits until a condition of the hub holds.
  template <typename Condition>
  void WaitUntil(Condition condition) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, condition);
  }

 private:
  // Responds with the method, the target and the body of the request.
  static Response Repeat(const Request& request) {
    Response response;
    response.content_type = "text/plain";
    response.body = SharedBytes(request.method + " " + request.raw_target + " " + request.body);
    return response;
  }

  // Returns the hub, or an error if the query contains "none".
  base::Result<std::shared_ptr<Hub>> FindHub(const Target& target) const {
    if (!target.query.contains("none")) return hub_;
    return base::Fail(base::ErrorCode::kNotFound, "there is no hub");
  }

  std::vector<Route> Routes() const {
    std::vector<Route> routes;
    for (const char* method : {"GET", "POST", "PUT"}) {
      for (const char* pattern : {"/", "/{path...}"}) {
        routes.push_back({method, pattern, Permission::kNone, false, Pool::kReaders, &Repeat});
      }
    }
    routes.push_back({"PUT", "/api/uploads/{upload}/{path...}", Permission::kControl, false,
                      Pool::kCommanders, &Repeat, "", true});
    routes.push_back(
        {"PUT", "/api/simulations", Permission::kControl, false, Pool::kCommanders, &Repeat});
    routes.push_back(SocketRoute(
        "/ws", true, [this](const Request& request) { return FindHub(request.target); }, ""));
    return routes;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<Hub> hub_ =
      std::make_shared<Hub>(foxglove::ServerInfo{"echo", {}, {}, "1"}, [this] {
        const std::lock_guard lock(mutex_);
        changed_.notify_all();
      });
  foxglove::ChannelId channel_ = 0;  // the channel "/numbers"
  const Router router_{Routes()};
};

class ServerTest : public ::testing::Test {
 protected:
  // Starts the server.
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
