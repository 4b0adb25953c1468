// One connection that speaks the Foxglove protocol: a client of a hub.
#pragma once

#include <memory>
#include <string_view>

#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>

#include "gsv/gateway/server/connection.h"

namespace gsv::gateway {

using PlainStream = boost::beast::tcp_stream;
using TlsStream = boost::beast::ssl_stream<boost::beast::tcp_stream>;

// Accepts the upgrade that `request` asks for and joins the hub. Of PlainStream and TlsStream.
template <typename Stream>
std::weak_ptr<Connection> StartWebSocketSession(
    Stream stream, boost::beast::http::request<boost::beast::http::string_body> request,
    std::string_view subprotocol, std::shared_ptr<Hub> hub, std::shared_ptr<ServerContext> context,
    std::unique_ptr<ConnectionSlot> slot, Ticket ticket);

}  // namespace gsv::gateway
