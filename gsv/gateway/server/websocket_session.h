// Serves a WebSocket connection with the Foxglove protocol, which is a client of a hub.
//
// A slow client gets fewer data messages, and no outdated messages (SendQueue, SendWindow). A
// status message reports this to the client, and is removed when its connection is fast again.
#pragma once

#include <memory>
#include <string_view>

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include "gsv/gateway/server/connection.h"
#include "gsv/gateway/transport/byte_stream.h"

namespace gsv::gateway {

// Accepts the upgrade of `request` and joins the hub.
std::weak_ptr<Connection> StartWebSocketSession(
    transport::ByteStream stream,
    boost::beast::http::request<boost::beast::http::string_body> request,
    std::string_view subprotocol, std::shared_ptr<Hub> hub, std::shared_ptr<ServerContext> context,
    std::unique_ptr<ConnectionSlot> slot, SocketOwner owner);

}  // namespace gsv::gateway
