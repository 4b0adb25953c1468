// One connection that speaks the Foxglove protocol: a client of a hub.
#pragma once

#include <memory>
#include <string_view>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include "gsv/gateway/connection.h"

namespace gsv::gateway {

// Accepts the upgrade that `request` asks for and joins the hub.
std::weak_ptr<Connection> StartWebSocketSession(
    boost::asio::ip::tcp::socket socket,
    boost::beast::http::request<boost::beast::http::string_body> request,
    std::string_view subprotocol, std::shared_ptr<Hub> hub, std::shared_ptr<ServerContext> context,
    std::unique_ptr<ConnectionSlot> slot, Ticket ticket);

}  // namespace gsv::gateway
