#include "gsv/gateway/upstream/transport.h"

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ssl/error.hpp>
#include <boost/asio/ssl/host_name_verification.hpp>

namespace gsv::gateway::upstream {
namespace {

namespace ssl = boost::asio::ssl;

// For instances without TLS, which show nothing.
ssl::context& NoContext() {
  static ssl::context context(ssl::context::tls_client);
  return context;
}

bool IsName(const std::string& host) {
  boost::system::error_code error;
  boost::asio::ip::make_address(host, error);
  return static_cast<bool>(error);
}

}  // namespace

Transport::Transport(boost::asio::io_context& io, const Address& address)
    : is_secure_(address.tls != nullptr), stream_(io, is_secure_ ? *address.tls : NoContext()) {
  if (!is_secure_) return;
  stream_.set_verify_mode(ssl::verify_peer);
  stream_.set_verify_callback(ssl::host_name_verification(address.host));
  // Servers of several names choose their certificate by it; addresses have no place there.
  if (IsName(address.host)) {
    SSL_set_tlsext_host_name(stream_.native_handle(), address.host.c_str());
  }
}

std::string WhyNotConnected(const boost::system::error_code& error) {
  if (error.category() != boost::asio::error::get_ssl_category()) {
    return error.message() + "; " + kIsItThere;
  }
  if (ERR_GET_REASON(static_cast<unsigned long>(error.value())) ==
      SSL_R_CERTIFICATE_VERIFY_FAILED) {
    return "its certificate is of nobody who is trusted here, or for another name; name the "
           "authority's by --authority (`gsv certificates make` calls it ca.pem)";
  }
  return "it does not speak TLS as it should: " + error.message();
}

}  // namespace gsv::gateway::upstream
