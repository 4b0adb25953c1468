// Serves an HTTP connection until it ends or becomes a WebSocket.
#pragma once

#include <functional>
#include <memory>

#include "gsv/gateway/server/connection.h"
#include "gsv/gateway/transport/tcp.h"

namespace gsv::gateway {

// Serves `socket`, with TLS if `context->tls` is set. Calls `keep_track` with this session. If a
// WebSocket session replaces this session, also calls `keep_track` with the WebSocket session.
void StartHttpSession(transport::Socket socket, std::shared_ptr<ServerContext> context,
                      std::unique_ptr<ConnectionSlot> slot,
                      std::function<void(std::weak_ptr<Connection>)> keep_track);

}  // namespace gsv::gateway
