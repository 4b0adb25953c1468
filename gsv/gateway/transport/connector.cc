#include "gsv/gateway/transport/connector.h"

#include <utility>

namespace gsv::gateway::transport {

using boost::asio::ip::tcp;
using boost::system::error_code;

void Connector::Connect(ByteStream& stream, const std::string& host, const std::string& port,
                        std::chrono::milliseconds limit, Completion then) {
  resolver_.async_resolve(
      host, port,
      [this, &stream, limit, then = std::move(then)](
          error_code error, const tcp::resolver::results_type& found) mutable {
        if (is_cancelled_) error = boost::asio::error::operation_aborted;
        if (error) return then(error);
        stream.tcp().expires_after(limit);
        stream.tcp().async_connect(
            found, [then = std::move(then)](error_code failed, const tcp::endpoint&) mutable {
              then(failed);
            });
      });
}

void Connector::Cancel() {
  is_cancelled_ = true;
  resolver_.cancel();
}

}  // namespace gsv::gateway::transport
