// The connection policy of the broker's ORB. It keeps harmful messages away from omniORB, and
// prevents clients from delaying other clients:
//
// - A message has at most 64 KiB, and must arrive within 3 s.
// - At most `connections` connections of clients stay open. A further connection closes the
//   connection that has been idle longest.
// - A client that sends slowly occupies no thread that other clients share: the thread that accepts
//   connections collects the parts of its messages.
// - About as many requests are processed at a time as there are processors.
// - Arguments of requests, and replies of services and other traders, are checked
//   (message_check.h).
#pragma once

#include <cstddef>

#include "gsv/orb/transport/connection_policy.h"

namespace gsv::broker {

// For orb::SetConnectionPolicy().
orb::ConnectionPolicy BrokerConnectionPolicy(std::size_t connections);

}  // namespace gsv::broker
