#include "gsv/gateway/transport/tcp.h"

#include <utility>

#include <boost/asio/post.hpp>

namespace gsv::gateway::transport {

void Post(const Executor& executor, Completion then) {
  boost::asio::post(executor, std::move(then));
}

void Wait(Timer& timer, Completion then) { timer.async_wait(std::move(then)); }

}  // namespace gsv::gateway::transport
