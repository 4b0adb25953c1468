// The types of Boost.Asio and Boost.Beast for TCP, with the executor of an io_context. The default
// executor of these types is polymorphic, so that each operation takes longer to compile.
#pragma once

#include <chrono>

#include <boost/asio/basic_waitable_timer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/rate_policy.hpp>

#include "gsv/gateway/transport/completion.h"

namespace gsv::gateway::transport {

using Executor = boost::asio::io_context::executor_type;
using Acceptor = boost::asio::basic_socket_acceptor<boost::asio::ip::tcp, Executor>;
using Resolver = boost::asio::ip::basic_resolver<boost::asio::ip::tcp, Executor>;
using Socket = boost::asio::basic_stream_socket<boost::asio::ip::tcp, Executor>;
using TcpStream = boost::beast::basic_stream<boost::asio::ip::tcp, Executor>;
using Clock = std::chrono::steady_clock;
using Timer = boost::asio::basic_waitable_timer<Clock, boost::asio::wait_traits<Clock>, Executor>;

// Calls `then` later, on a thread that runs `executor`. Any thread may call it.
void Post(const Executor& executor, Completion then);
// Calls `then` when `timer` expires, or with an error if it is cancelled.
void Wait(Timer& timer, Completion then);

}  // namespace gsv::gateway::transport
