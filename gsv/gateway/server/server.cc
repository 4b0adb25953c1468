#include "gsv/gateway/server/server.h"

#include <algorithm>
#include <future>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/host_name.hpp>

#include "gsv/base/log.h"
#include "gsv/gateway/server/http_session.h"
#include "gsv/gateway/server/tls_context.h"
#include "gsv/gateway/transport/tcp.h"

namespace gsv::gateway {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
using transport::Completion;

// Time limit for clients to close their connections after Stop().
constexpr std::chrono::seconds kStopTimeout{1};
// Delay before the next attempt to accept if the system has no free descriptors.
constexpr std::chrono::milliseconds kAcceptRetryDelay{100};

base::Result<tcp::endpoint> EndpointOf(const ServerOptions& options) {
  error_code error;
  const std::string host = options.host == "localhost" ? "127.0.0.1" : options.host;
  const auto address = asio::ip::make_address(host, error);
  if (error) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "'" + options.host +
                          "' is not an address of this machine; use 127.0.0.1 for this machine "
                          "only, or one of its addresses");
  }
  return tcp::endpoint(address, options.port);
}

base::Error NeedsToken(const ServerOptions& options) {
  return {base::ErrorCode::kInvalidArgument,
          "other machines can reach this address, so a token is required: use --control-token or "
          "--watch-token, or listen on 127.0.0.1",
          "listening on " + options.host};
}

base::Error CannotListen(const ServerOptions& options, error_code error) {
  const std::string where = Authority(options.host, options.port);
  if (error == asio::error::address_in_use) {
    return {base::ErrorCode::kUnavailable,
            "another program uses the port; choose another port, or --port 0 for any free one",
            where};
  }
  return {base::ErrorCode::kUnavailable,
          "cannot listen here: " + error.message() + "; choose another address or port", where};
}

base::Status Listen(transport::Acceptor& acceptor, const tcp::endpoint& endpoint,
                    const ServerOptions& options) {
  error_code error;
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) return base::Fail(CannotListen(options, error));
  return {};
}

// Sends a refusal to a client above the limit, without waiting for the client.
void RefuseConnection(transport::Socket& socket) {
  static constexpr std::string_view kAnswer =
      "HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\nContent-Type: application/json\r\n"
      "\r\n"
      "{\"error\":\"too many connections; close some viewers and try again\"}";
  error_code error;
  socket.non_blocking(true, error);
  socket.write_some(asio::buffer(kAnswer.data(), kAnswer.size()), error);
}

class BeastServer final : public Server {
 public:
  BeastServer(const ServerOptions& options, Handler& handler) : acceptor_(io_), pause_(io_) {
    options_ = options;
    if (options_.traffic == nullptr) options_.traffic = std::make_shared<metrics::Traffic>();
    name_ = options.host;
    handler_ = &handler;
  }

  ~BeastServer() override { Stop(); }

  base::Status Open() {
    const base::Result<tcp::endpoint> endpoint = EndpointOf(options_);
    if (!endpoint) return base::Fail(endpoint.error());
    const asio::ip::address address = endpoint->address();
    const bool is_exposed = !address.is_loopback();
    if (options_.authenticator == nullptr) {
      if (is_exposed && options_.tokens.empty()) return base::Fail(NeedsToken(options_));
      options_.authenticator =
          std::make_shared<access::TokenAuthenticator>(options_.tokens, is_exposed);
    }
    if (!options_.tls.empty()) {
      auto tls = MakeTlsContext(options_.tls);
      if (!tls) return base::Fail(tls.error());
      tls_ = *std::move(tls);
    }
    if (address.is_unspecified()) name_ = asio::ip::host_name();
    if (base::Status listening = Listen(acceptor_, *endpoint, options_); !listening) {
      return listening;
    }
    port_ = acceptor_.local_endpoint().port();
    context_ = std::shared_ptr<ServerContext>(
        new ServerContext{options_,
                          AccessRule(name_, port_, options_.allowed_hosts, options_.allowed_origins,
                                     address.is_unspecified(), tls_ != nullptr),
                          options_.authenticator, *handler_, options_.traffic, tls_});
    Accept();
    thread_ = std::thread([this] {
      io_.run();
      finished_.set_value();
    });
    return {};
  }

  std::uint16_t port() const override { return port_; }
  std::string url() const override {
    return (tls_ ? "https://" : "http://") + Authority(name_, port_) + "/";
  }

  void Stop() override {
    if (!thread_.joinable()) return;
    transport::Post(io_.get_executor(), Completion([this] { SayGoodbye(); }));
    // The thread ends by itself when the last connection has ended. If that takes longer than
    // kStopTimeout, the thread is stopped.
    finished_.get_future().wait_for(kStopTimeout);
    io_.stop();
    thread_.join();
    for (const std::weak_ptr<Connection>& weak : connections_) {
      if (const auto connection = weak.lock()) connection->Cut();
    }
  }

 private:
  void Accept() {
    acceptor_.async_accept([this](error_code error, transport::Socket socket) {
      if (!acceptor_.is_open()) return;
      if (error) return AcceptLater();
      Serve(std::move(socket));
      Accept();
    });
  }

  void AcceptLater() {
    pause_.expires_after(kAcceptRetryDelay);
    Wait(pause_, Completion([this](error_code error) {
           if (!error && acceptor_.is_open()) Accept();
         }));
  }

  void Serve(transport::Socket socket) {
    if (options_.traffic->connections >= options_.limits.connections) {
      ++options_.traffic->turned_away;
      return RefuseConnection(socket);
    }
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    std::erase_if(connections_, [](const auto& connection) { return connection.expired(); });
    StartHttpSession(std::move(socket), context_, std::make_unique<ConnectionSlot>(context_),
                     [this](std::weak_ptr<Connection> connection) {
                       connections_.push_back(std::move(connection));
                     });
  }

  void SayGoodbye() {
    context_->stopping = true;
    error_code ignored;
    acceptor_.close(ignored);
    pause_.cancel();
    for (const std::weak_ptr<Connection>& weak : connections_) {
      if (const auto connection = weak.lock()) connection->Shutdown();
    }
  }

  ServerOptions options_;
  std::shared_ptr<asio::ssl::context> tls_;
  std::string name_;  // the address that clients use
  Handler* handler_ = nullptr;
  std::shared_ptr<ServerContext> context_;
  std::uint16_t port_ = 0;
  asio::io_context io_{1};
  transport::Acceptor acceptor_;
  transport::Timer pause_;
  std::vector<std::weak_ptr<Connection>> connections_;  // may include ended connections
  std::promise<void> finished_;
  std::thread thread_;
};

}  // namespace

base::Result<std::unique_ptr<Server>> Server::Start(const ServerOptions& options,
                                                    Handler& handler) {
  auto server = std::make_unique<BeastServer>(options, handler);
  if (base::Status opened = server->Open(); !opened) return base::Fail(opened.error());
  return server;
}

}  // namespace gsv::gateway
