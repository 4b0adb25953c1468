// One connection that speaks HTTP, one request after the other, until it ends or becomes a
// WebSocket.
#pragma once

#include <functional>
#include <memory>

#include <boost/asio/ip/tcp.hpp>

#include "gsv/gateway/server/connection.h"

namespace gsv::gateway {

// Starts to serve `socket`, by TLS where the context says so. `keep_track` is told of this session
// and of the one that replaces it.
void StartHttpSession(boost::asio::ip::tcp::socket socket, std::shared_ptr<ServerContext> context,
                      std::unique_ptr<ConnectionSlot> slot,
                      std::function<void(std::weak_ptr<Connection>)> keep_track);

}  // namespace gsv::gateway
