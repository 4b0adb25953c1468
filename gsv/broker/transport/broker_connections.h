// What the broker has its ORB's connections do, so that omniORB gets no message that harms it and
// no client keeps others waiting:
//
// - messages are at most 64 KiB long and 3 s under way;
// - `connections` of clients stay open at most; then the one that has been silent longest is
// closed;
// - a client that sends slowly occupies no thread: the thread that accepts gathers its messages;
// - about as many requests are worked on at once as there are processors;
// - arguments of requests, and what services and other traders reply, are checked
// (message_check.h).
#pragma once

#include <cstddef>

#include "gsv/orb/transport/connection_policy.h"

namespace gsv::broker {

// For orb::SetConnectionPolicy().
orb::ConnectionPolicy BrokerConnectionPolicy(std::size_t connections);

}  // namespace gsv::broker
