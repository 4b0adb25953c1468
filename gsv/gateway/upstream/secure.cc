#include "gsv/gateway/upstream/secure.h"

#include <utility>

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ssl/error.hpp>
#include <boost/asio/ssl/host_name_verification.hpp>

namespace gsv::gateway::upstream {
namespace {

namespace ssl = boost::asio::ssl;

bool IsName(const std::string& host) {
  boost::system::error_code error;
  boost::asio::ip::make_address(host, error);
  return static_cast<bool>(error);
}

}  // namespace

void StartTls(transport::ByteStream& stream, const Address& address, transport::Completion then) {
  if (!address.tls) {
    return Post(stream.get_executor(), std::move(then));
  }
  transport::ByteStream::Tls& tls = stream.StartTls(*address.tls);
  tls.set_verify_mode(ssl::verify_peer);
  tls.set_verify_callback(ssl::host_name_verification(address.host));
  // Server name indication (RFC 6066): a server with several names selects its certificate by this
  // name. An IP address is not allowed as a name.
  if (IsName(address.host)) SSL_set_tlsext_host_name(tls.native_handle(), address.host.c_str());
  stream.Handshake(ssl::stream_base::client, {}, std::move(then));
}

std::string WhyNotConnected(const boost::system::error_code& error) {
  if (error.category() != boost::asio::error::get_ssl_category()) {
    return error.message() + "; " + kConnectionHint;
  }
  if (ERR_GET_REASON(static_cast<unsigned long>(error.value())) ==
      SSL_R_CERTIFICATE_VERIFY_FAILED) {
    return "its certificate is not trusted, or is for another name; set the authority's "
           "certificate with --authority (ca.pem of `gsv certificates make`)";
  }
  return "the TLS connection failed: " + error.message();
}

}  // namespace gsv::gateway::upstream
