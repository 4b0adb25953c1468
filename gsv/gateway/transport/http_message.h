// Reads and writes HTTP messages. They replace the functions of Boost.Beast with these names, which
// are compiled once for each type of body and handler.
//
// Threads  the thread of the stream's executor.
#pragma once

#include <string>

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/basic_parser.hpp>
#include <boost/beast/http/fields.hpp>
#include <boost/beast/http/message.hpp>

#include "gsv/gateway/transport/byte_stream.h"

namespace gsv::gateway::transport {

// These functions read the header of a message, or the rest of a message, then call `then`, never
// before they return. The limits of the parser apply. `buffer` has bytes that were read from the
// stream before, and keeps those that follow the message. The arguments must exist until `then` is
// called.
template <bool is_request>
void ReadHeader(ByteStream& stream, boost::beast::flat_buffer& buffer,
                boost::beast::http::basic_parser<is_request>& parser, Completion then);
template <bool is_request>
void ReadMessage(ByteStream& stream, boost::beast::flat_buffer& buffer,
                 boost::beast::http::basic_parser<is_request>& parser, Completion then);

// Returns the first line and the fields, as they are sent before the body.
std::string HeaderText(const boost::beast::http::request_header<>& header);
std::string HeaderText(const boost::beast::http::response_header<>& header);

}  // namespace gsv::gateway::transport
