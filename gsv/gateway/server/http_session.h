// Serves an HTTP connection until it ends or becomes a WebSocket.
#pragma once

#include <functional>
#include <memory>

#include <boost/asio/ip/tcp.hpp>

#include "gsv/gateway/server/connection.h"

namespace gsv::gateway {

// Serves `socket`, with TLS if the context has it. Calls `keep_track` with this session and with
// the WebSocket session that replaces it.
void StartHttpSession(boost::asio::ip::tcp::socket socket, std::shared_ptr<ServerContext> context,
                      std::unique_ptr<ConnectionSlot> slot,
                      std::function<void(std::weak_ptr<Connection>)> keep_track);

}  // namespace gsv::gateway
