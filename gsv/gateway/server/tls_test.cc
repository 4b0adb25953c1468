// Tests the server over TLS with OpenSSL's client side (in Boost.Beast), which trusts only the
// test's authority.
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>

#include "gsv/base/temporary_folder.h"
#include "gsv/gateway/testing/server_fixture.h"
#include "gsv/gateway/testing/web_client.h"
#include "gsv/tls/certificates.h"

namespace gsv::gateway {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;
using std::chrono::hours;

class TlsTest : public testing::ServerTest {
 protected:
  void SetUp() override {
    ASSERT_TRUE(tls::MakeAuthority(folder(), {}));
    ASSERT_TRUE(tls::MakeCertificate(folder(), {"server", {"127.0.0.1"}, {}}));
  }

  std::string folder() const { return folder_.path().string(); }
  TlsFiles Files(const std::string& name) const {
    return {folder() + "/" + name + ".pem", folder() + "/" + name + "-key.pem"};
  }
  void StartSecure() {
    ServerOptions options;
    options.tls = Files("server");
    Start(options);
  }
  base::Status StartWith(const TlsFiles& files) {
    ServerOptions options;
    options.tls = files;
    auto server = Server::Start(options, echo_);
    return server ? base::Status() : base::Fail(server.error());
  }

  struct Client {
    // If `authority` is empty, the system's authorities are trusted.
    Client(std::uint16_t port, const std::string& authority, const std::string& host) {
      if (!authority.empty()) context.load_verify_file(authority);
      stream.set_verify_mode(asio::ssl::verify_peer);
      stream.set_verify_callback(asio::ssl::host_name_verification(host));
      beast::get_lowest_layer(stream).connect({asio::ip::address_v4::loopback(), port});
    }

    asio::io_context io;
    asio::ssl::context context{asio::ssl::context::tls_client};
    beast::ssl_stream<beast::tcp_stream> stream{io, context};
  };

  // Returns the answer's status and body. Throws boost::system::system_error.
  std::pair<int, std::string> FetchSecurely(const std::string& more_headers = "", int version = 0,
                                            const std::string& body = "") const {
    Client client(port(), folder() + "/ca.pem", "127.0.0.1");
    if (version != 0) SSL_set_max_proto_version(client.stream.native_handle(), version);
    client.stream.handshake(asio::ssl::stream_base::client);
    asio::write(client.stream,
                asio::buffer(testing::RequestText(port(), body.empty() ? "GET" : "POST", "/hello",
                                                  more_headers + "Connection: close\r\n", body)));
    beast::flat_buffer buffer;
    http::response<http::string_body> response;
    http::read(client.stream, buffer, response);
    // The server must end the TLS stream with a close_notify alert. If an attacker truncates a
    // response, the alert is missing, and the client reads another error than eof.
    error_code error;
    char byte = 0;
    client.stream.read_some(asio::buffer(&byte, 1), error);
    EXPECT_EQ(error, asio::error::eof) << error.message();
    return {static_cast<int>(response.result_int()), response.body()};
  }

  const base::TemporaryFolder folder_ = *base::TemporaryFolder::Make("gsv-tls");
};

TEST_F(TlsTest, DisconnectsAClientThatDoesNotBegin) {
  ServerOptions options;
  options.tls = Files("server");
  options.limits.request_time = std::chrono::milliseconds(50);
  Start(options);
  testing::HttpConnection silent(port()), halting(port());
  halting.Send("\x16\x03\x01");  // the first bytes of a handshake
  EXPECT_TRUE(silent.IsClosed());
  EXPECT_TRUE(halting.IsClosed());
}

TEST_F(TlsTest, AnswersClientsThatTrustItsAuthority) {
  StartSecure();
  EXPECT_EQ(server_->url(), "https://127.0.0.1:" + std::to_string(port()) + "/");
  const auto [status, body] = FetchSecurely();
  EXPECT_EQ(status, 200);
  EXPECT_EQ(body, "GET /hello ");
}

TEST_F(TlsTest, ClientsWithoutItsAuthorityDoNotTrustIt) {
  StartSecure();
  ASSERT_TRUE(tls::MakeAuthority(folder_.path() / "other", {}));
  const auto greet = [&](const std::string& authority, const std::string& host) {
    Client client(port(), authority, host);
    client.stream.handshake(asio::ssl::stream_base::client);
  };
  EXPECT_NO_THROW(greet(folder() + "/ca.pem", "127.0.0.1"));
  EXPECT_THROW(greet("", "127.0.0.1"), boost::system::system_error);
  EXPECT_THROW(greet(folder() + "/other/ca.pem", "127.0.0.1"), boost::system::system_error);
  EXPECT_THROW(greet(folder() + "/ca.pem", "10.0.0.1"), boost::system::system_error);
}

TEST_F(TlsTest, AcceptsRequestsFromItsOwnSecurePagesOnly) {
  StartSecure();
  const std::string own = "127.0.0.1:" + std::to_string(port()) + "\r\n";
  EXPECT_EQ(FetchSecurely("Origin: https://" + own).first, 200);
  EXPECT_EQ(FetchSecurely("Origin: http://" + own).first, 403);
  EXPECT_EQ(FetchSecurely("Origin: https://evil.example\r\n").first, 403);
}

TEST_F(TlsTest, OldVersionsAreRefused) {
  StartSecure();
  EXPECT_EQ(FetchSecurely("", TLS1_2_VERSION).first, 200);
  EXPECT_THROW(FetchSecurely("", TLS1_1_VERSION), boost::system::system_error);
}

TEST_F(TlsTest, APlainHttpClientIsReferredToHttps) {
  StartSecure();
  const testing::HttpReply reply = testing::Fetch(port(), "GET", "/hello");
  EXPECT_EQ(reply.status, 400);
  EXPECT_NE(reply.body.find("https://"), std::string::npos);
  EXPECT_EQ(reply.body.find("hello"), std::string::npos);
  EXPECT_THROW(testing::Viewer(port(), "/ws"), std::exception);
  EXPECT_EQ(FetchSecurely().first, 200);
}

TEST_F(TlsTest, SurvivesInvalidData) {
  StartSecure();
  for (const char* bytes : {"\x16\x03\x01", "\x16\x03\x01\xff\xff\x01\x00\xff\xff", "\x80"}) {
    testing::HttpConnection connection(port());
    connection.Send(bytes);
  }
  EXPECT_EQ(FetchSecurely().first, 200);
}

TEST_F(TlsTest, AnswersOfManyRecordsAreComplete) {
  StartSecure();
  std::string body(60'000, ' ');
  for (std::size_t i = 0; i < body.size(); ++i) body[i] = static_cast<char>('a' + i % 23);
  EXPECT_EQ(FetchSecurely("", 0, body).second, "POST /hello " + body);
}

TEST_F(TlsTest, ViewerCanConnectOverTls) {
  StartSecure();
  Client client(port(), folder() + "/ca.pem", "127.0.0.1");
  client.stream.handshake(asio::ssl::stream_base::client);
  beast::websocket::stream<beast::ssl_stream<beast::tcp_stream>&> socket(client.stream);
  socket.set_option(beast::websocket::stream_base::decorator(
      [](auto& request) { request.set(http::field::sec_websocket_protocol, "foxglove.sdk.v1"); }));
  socket.handshake("127.0.0.1:" + std::to_string(port()), "/ws");
  beast::flat_buffer buffer;
  socket.read(buffer);
  const std::string first = beast::buffers_to_string(buffer.data());
  EXPECT_EQ(nlohmann::json::parse(first)["op"], "serverInfo");
  error_code error;
  socket.close(beast::websocket::close_code::normal, error);
  EXPECT_FALSE(error) << error.message();
}

TEST_F(TlsTest, InvalidCertificatePreventsTheStart) {
  ASSERT_TRUE(tls::MakeCertificate(folder(), {"old", {}, {-hours(48), -hours(24)}}));
  ASSERT_TRUE(tls::MakeCertificate(folder(), {"other", {}, {}}));
  const auto refusal = [&](const TlsFiles& files) {
    const base::Status status = StartWith(files);
    return status ? std::string() : status.error().Sentence();
  };
  EXPECT_NE(refusal(Files("old")).find("has expired"), std::string::npos);
  EXPECT_NE(refusal({Files("other").certificate, Files("server").key})
                .find("does not belong to the certificate"),
            std::string::npos);
  EXPECT_NE(refusal({Files("server").certificate, ""}).find("needs a certificate and its key"),
            std::string::npos);
  EXPECT_NE(refusal(Files("none")).find("No such file"), std::string::npos);
  EXPECT_TRUE(StartWith(Files("server")));
}

}  // namespace
}  // namespace gsv::gateway
