// Tests how clients get images of a simulation over HTTP: directly, through a relay (another
// instance of gsv), and with a token.
#include "gsv/gateway/drawing/view_routes.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>

#include <gtest/gtest.h>

#include "gsv/gateway/gateway.h"
#include "gsv/gateway/testing/scripted_simulation.h"
#include "gsv/gateway/testing/simulation_list.h"
#include "gsv/gateway/testing/web_client.h"

namespace gsv::gateway {
namespace {

using testing::Fetch;
using testing::HttpReply;
using testing::ScriptedSimulation;

// A TCP connection whose bytes are read as they arrive.
class RawClient {
 public:
  explicit RawClient(std::uint16_t port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval limit{60, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    EXPECT_EQ(connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  ~RawClient() { close(socket_); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  void Send(const std::string& bytes) {
    EXPECT_EQ(write(socket_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  // Returns an empty text at the end of the stream.
  std::string ReceiveSome() {
    std::string bytes(4096, '\0');
    const ssize_t size = read(socket_, bytes.data(), bytes.size());
    bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return bytes;
  }

 private:
  const int socket_;
};

class ViewRoutesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_->Add(simulation_);
    Start({});
    if (const auto renderer = rendering::Renderer::Start(); !renderer) {
      GTEST_SKIP() << renderer.error().Sentence();
    }
  }

  void Start(const GatewayOptions& options) {
    auto gateway = Gateway::Start(options, directory_);
    ASSERT_TRUE(gateway) << gateway.error().Sentence();
    gateway_ = std::move(*gateway);
  }

  HttpReply Get(const std::string& target) const { return Fetch(gateway_->port(), "GET", target); }

  // Returns the width and height in a JPEG's frame header (ITU-T T.81, B.2.2).
  static std::pair<int, int> SizeOf(const std::string& jpeg) {
    const std::size_t frame = jpeg.find("\xff\xc0");
    if (frame == std::string::npos) return {};
    const auto number = [&](std::size_t at) {
      return static_cast<unsigned char>(jpeg.at(at)) << 8 |
             static_cast<unsigned char>(jpeg.at(at + 1));
    };
    return {number(frame + 7), number(frame + 5)};
  }

  std::shared_ptr<ScriptedSimulation> simulation_ =
      std::make_shared<ScriptedSimulation>("arena", 1);
  std::shared_ptr<testing::SimulationList> directory_ = std::make_shared<testing::SimulationList>();
  std::unique_ptr<Gateway> gateway_;
};

TEST_F(ViewRoutesTest, DrawsTheSimulation) {
  const HttpReply image = Get("/view.jpg?size=64x48&pixel_ratio=2");
  ASSERT_EQ(image.status, 200) << image.body;
  EXPECT_EQ(image.headers.at("content-type"), "image/jpeg");
  EXPECT_EQ(image.headers.at("cross-origin-resource-policy"), "cross-origin");
  EXPECT_EQ(image.headers.at("gsv-time"), "0.000000");
  EXPECT_EQ(SizeOf(image.body), std::pair(128, 96));
  EXPECT_EQ(Get("/view.png?size=64x48&simulation=arena").body.substr(1, 3), "PNG");
  EXPECT_NE(Get("/view.jpg?size=64x48&depth=8").body.find("GSV-depth"), std::string::npos);
  EXPECT_EQ(Get("/view.png?size=64x48&depth=8").status, 400);
  // The simulation is paused, so a request for a newer image gets status 204, without an image.
  const std::string number =
      image.headers.at("etag").substr(1, image.headers.at("etag").size() - 2);
  const HttpReply same = Get("/view.jpg?size=64x48&after=" + number);
  EXPECT_EQ(same.status, 204);
  EXPECT_EQ(same.body, "");
}

TEST_F(ViewRoutesTest, InvalidRequestsGetAnErrorStatusAndTheReason) {
  const auto check = [this](const std::string& query, int status, const std::string& sentence) {
    for (const char* path : {"/view.jpg?", "/view.mjpeg?"}) {
      const HttpReply reply = Get(path + query);
      EXPECT_EQ(reply.status, status) << path << query;
      EXPECT_NE(reply.body.find(sentence), std::string::npos) << reply.body;
    }
  };
  check("size=0x0", 400, "16 to 4096 pixels");
  check("size=100000x100000", 400, "16 to 4096 pixels");
  check("size=4096x4096", 400, "the limit is 8294400 pixels");
  check("simulation=nobody", 404, "there is no simulation 'nobody'");
  check("size=64x48&follow=nobody", 404, "there is no robot 'nobody'");
  check("size=64x48&camera=nobody/eye", 404, "there is no camera 'nobody/eye'");
  check("elevation=91", 400, "the parameter elevation must be -90 to 90");
  check("azimuth=x", 400, "the parameter azimuth");
  check("zoom=2&eye=1,1,1&target=0,0,0", 400,
        "cannot be combined with eye, target, follow or camera");
  check("colour=red", 400, "there is no parameter 'colour'");
}

TEST_F(ViewRoutesTest, StreamsImagesUntilTheClientLeaves) {
  RawClient connection(gateway_->port());
  connection.Send("GET /view.mjpeg?size=64x48&fps=60 HTTP/1.1\r\nHost: localhost:" +
                  std::to_string(gateway_->port()) + "\r\n\r\n");
  std::string received;
  while (received.find("--gsv-image\r\nContent-Type: image/jpeg") == std::string::npos ||
         received.find("\xff\xd9\r\n--gsv-image") == std::string::npos) {
    const std::string more = connection.ReceiveSome();
    ASSERT_FALSE(more.empty()) << received;
    received += more;
  }
  EXPECT_EQ(received.substr(0, 15), "HTTP/1.1 200 OK");
  EXPECT_NE(received.find("multipart/x-mixed-replace; boundary=gsv-image"), std::string::npos);
  EXPECT_NE(received.find("Gsv-Time: 0.000000"), std::string::npos);
  gateway_->Stop();  // this ends the stream
  while (!connection.ReceiveSome().empty()) {
  }
}

TEST_F(ViewRoutesTest, PushesImagesOverTheWebSocket) {
  testing::Viewer viewer(gateway_->port());
  const nlohmann::json capabilities = viewer.ReceiveText("serverInfo")["capabilities"];
  EXPECT_NE(std::find(capabilities.begin(), capabilities.end(), "gsvViews"), capabilities.end());
  viewer.SendText(R"({"op":"gsvSubscribeView","id":9,"camera":"size=64x48","sequence":2})");
  const testing::ReceivedData image = viewer.ReceiveData(9);
  EXPECT_EQ(image.time_ns, 0u);
  EXPECT_EQ(image.payload.substr(0, 4), std::string("\2\0\0\0", 4));
  EXPECT_EQ(SizeOf(image.payload.substr(20)), std::pair(64, 48));
  viewer.SendText(R"({"op":"gsvSubscribeView","id":9,"camera":"follow=nobody","sequence":3})");
  EXPECT_NE(
      viewer.ReceiveText("gsvViewFailure")["message"].dump().find("there is no robot 'nobody'"),
      std::string::npos);
}

TEST_F(ViewRoutesTest, AcceptsTheTokenInTheQuery) {
  GatewayOptions options;
  options.tokens.watch = "a-token-of-sixteen-letters";
  Start(options);
  EXPECT_EQ(Get("/view.jpg?size=64x48").status, 401);
  EXPECT_EQ(Get("/view.mjpeg?size=64x48").status, 401);
  EXPECT_EQ(Get("/view.jpg?size=64x48&token=another-token-of-letters").status, 403);
  EXPECT_EQ(Get("/view.jpg?size=64x48&token=a-token-of-sixteen-letters").status, 200);
  // Addresses without images do not accept the token in the query.
  EXPECT_EQ(Get("/api/simulations?token=a-token-of-sixteen-letters").status, 401);
}

TEST_F(ViewRoutesTest, ARelayForwardsImages) {
  auto relay = Gateway::StartRelay({}, {gateway_->url(), "", ""});
  ASSERT_TRUE(relay) << relay.error().Sentence();
  const HttpReply image = Fetch((*relay)->port(), "GET", "/view.jpg?size=64x48&token=x");
  ASSERT_EQ(image.status, 200) << image.body;
  EXPECT_EQ(SizeOf(image.body), std::pair(64, 48));
  EXPECT_TRUE(image.headers.contains("etag"));
}

TEST_F(ViewRoutesTest, ARelayForwardsAStreamOfImages) {
  auto relay = Gateway::StartRelay({}, {gateway_->url(), "", ""});
  ASSERT_TRUE(relay) << relay.error().Sentence();
  RawClient connection((*relay)->port());
  connection.Send("GET /view.mjpeg?size=64x48&fps=60 HTTP/1.1\r\nHost: localhost:" +
                  std::to_string((*relay)->port()) + "\r\n\r\n");
  std::string received;
  while (received.find("\xff\xd9\r\n--gsv-image") == std::string::npos) {
    const std::string more = connection.ReceiveSome();
    ASSERT_FALSE(more.empty()) << received;
    received += more;
  }
  EXPECT_EQ(received.substr(0, 15), "HTTP/1.1 200 OK");
  EXPECT_NE(received.find("multipart/x-mixed-replace; boundary=gsv-image"), std::string::npos);
  EXPECT_NE(received.find("Gsv-Time: 0.000000"), std::string::npos);
  const HttpReply refused = Fetch((*relay)->port(), "GET", "/view.mjpeg?size=64x48&follow=nobody");
  EXPECT_EQ(refused.status, 404);
  EXPECT_NE(refused.body.find("there is no robot 'nobody'"), std::string::npos);
  EXPECT_EQ(Fetch((*relay)->port(), "GET", "/view.mjpeg?fps=1000").status, 400);
  (*relay)->Stop();  // this ends the stream
  while (!connection.ReceiveSome().empty()) {
  }
}

}  // namespace
}  // namespace gsv::gateway
