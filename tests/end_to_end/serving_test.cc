// Tests a server from the view of an operator: limits, metrics, and the log. Uses the real program.
#include <map>
#include <optional>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "gsv/base/sanitizer.h"
#include "gsv/gateway/testing/web_client.h"
#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using gateway::testing::HttpReply;
using nlohmann::json;

// A server on a port that the system chose.
class Served {
 public:
  explicit Served(std::vector<std::string> options, const std::vector<std::string>& before = {}) {
    std::vector<std::string> arguments = before;
    for (const char* each : {"serve", "--port", "0"}) arguments.emplace_back(each);
    arguments.insert(arguments.end(), options.begin(), options.end());
    program_.emplace("gsv", arguments);
    const std::string line = program_->AwaitLine("viewer: ");
    port_ = static_cast<std::uint16_t>(std::stoi(line.substr(line.rfind(':') + 1)));
    (void)program_->AwaitLine("broker: ");
  }

  HttpReply Ask(const std::string& method, const std::string& path, const std::string& body = "",
                const std::string& header = "") const {
    return gateway::testing::Fetch(port_, method, path, header.empty() ? "" : header + "\r\n",
                                   body);
  }
  HttpReply Create(const std::string& robots) const {
    return Ask("POST", "/api/simulations", R"({"world": "office", "robots": [)" + robots + "]}");
  }
  double Metric(const std::string& name) const {
    const std::string text = Ask("GET", "/metrics").body;
    const std::size_t at = text.find("\n" + name + " ");
    EXPECT_NE(at, std::string::npos) << name << " in " << text;
    return at == std::string::npos ? -1 : std::stod(text.substr(at + name.size() + 2));
  }
  pid_t pid() { return program_->process().pid(); }
  // Ends the server and returns its log.
  std::string End() {
    program_->process().Signal(SIGTERM);
    return program_->AwaitEnd().err;
  }

 private:
  std::optional<Running> program_;
  std::uint16_t port_ = 0;
};

std::string PathOf(const std::string& name) { return "/api/simulations/" + name; }

TEST(Limits, LimitsOfSimulationsAndRobotsApplyAndCanBeSet) {
  const Served server({"--limit", "simulations=2", "--limit", "robots=1"});
  const std::string robot = R"({"name": "a", "model": "pebble", "x": 0, "y": 0})";
  const std::string other = R"({"name": "b", "model": "pebble", "x": 1, "y": 0})";
  EXPECT_EQ(server.Create("").status, 201);
  const HttpReply crowded = server.Create(robot + "," + other);
  EXPECT_GE(crowded.status, 400);
  EXPECT_NE(crowded.body.find("at most 1 robots"), std::string::npos) << crowded.body;
  const HttpReply second = server.Create(robot);
  ASSERT_EQ(second.status, 201) << second.body;
  const HttpReply third = server.Create("");
  EXPECT_GE(third.status, 400);
  EXPECT_NE(third.body.find("already runs 2 simulations"), std::string::npos) << third.body;
  // Refused requests must leave nothing behind.
  EXPECT_EQ(json::parse(server.Ask("GET", "/api/simulations").body).size(), 2u);
  const std::string name = json::parse(second.body)["name"];
  EXPECT_EQ(server.Ask("DELETE", PathOf(name)).status, 200);
  EXPECT_EQ(server.Create("").status, 201);
}

TEST(Limits, LimitsOfRequestsAndUploadsApplyAndCanBeSet) {
  const Served server({"--limit", "request_bytes=1000", "--limit", "upload_bytes=2000", "--limit",
                       "uploaded_bytes=3000"});
  EXPECT_EQ(server.Ask("POST", "/api/preview", std::string(1001, ' ')).status, 413);
  EXPECT_NE(server.Ask("POST", "/api/preview", std::string(1000, ' ')).status, 413);
  EXPECT_EQ(server.Ask("POST", "/api/uploads", "{}").status, 201);
  EXPECT_EQ(server.Ask("PUT", "/api/uploads/1/a", std::string(2001, 'a')).status, 413);
  EXPECT_EQ(server.Ask("PUT", "/api/uploads/1/a", std::string(2000, 'a')).status, 201);
  EXPECT_EQ(server.Ask("PUT", "/api/uploads/1/b", std::string(1001, 'b')).status, 503);
  EXPECT_EQ(server.Ask("PUT", "/api/uploads/1/b", std::string(1000, 'b')).status, 201);
}

TEST(Limits, UnknownLimitsAreRejectedWithAListOfKnownLimits) {
  for (const char* limit : {"robots=0", "robots=many", "simulations=10001"}) {
    const Outcome refused = RunProgram("gsv", {"serve", "--limit", limit});
    EXPECT_EQ(refused.ending, "exit code 2") << limit;
    EXPECT_NE(refused.err.find("must be a whole number from 1 to"), std::string::npos)
        << refused.err;
  }
  const Outcome unknown = RunProgram("gsv", {"serve", "--limit", "viewers=3"});
  EXPECT_EQ(unknown.ending, "exit code 2");
  EXPECT_NE(unknown.err.find("mesh_bytes"), std::string::npos) << unknown.err;
  EXPECT_NE(unknown.err.find("sensors_of_a_robot"), std::string::npos) << unknown.err;
}

// Worlds that are not built in are first read in a separate process.
class UploadedWorld : public ::testing::Test {
 protected:
  static HttpReply Show(const Served& server, const std::string& world) {
    return server.Ask("POST", "/api/preview", json{{"world", world}}.dump());
  }
  std::string WithMesh(const std::string& mesh) const {
    return folder_.Write("world.sdf", R"(<?xml version="1.0"?>
<sdf version="1.7"><world name="w"><model name="m"><static>true</static><link name="l">
<visual name="v"><geometry><mesh><uri>)" + mesh +
                                          R"(</uri></mesh></geometry></visual>
</link></model></world></sdf>)");
  }

  const base::testing::TestFolder folder_{};
};

TEST_F(UploadedWorld, ValidWorldIsShown) {
  const Served server({});
  const HttpReply shown = Show(server, WithMesh("none.stl"));
  EXPECT_EQ(shown.status, 200) << shown.body;
  EXPECT_NE(shown.body.find("none.stl"), std::string::npos) << shown.body;
}

TEST_F(UploadedWorld, ExcessiveMemoryIsReportedAndTheServerContinues) {
  if (base::kReservesAddressSpace) GTEST_SKIP() << "this sanitizer leaves no bound on addresses";
  const Served server({"--limit", "reading_bytes=30000000"});
  const HttpReply refused = Show(server, WithMesh("none.stl"));
  EXPECT_GE(refused.status, 400) << refused.body;
  EXPECT_NE(refused.body.find("reading it takes more than 30000000 bytes"), std::string::npos)
      << refused.body;
  EXPECT_EQ(server.Create("").status, 201);  // built-in worlds need no separate process
}

TEST_F(UploadedWorld, EndlessReadingIsReportedAndTheServerContinues) {
  const Served server({"--limit", "reading_seconds=2"});
  // The file is a FIFO, so reading it waits for a writer.
  const std::string world = folder_.path() / "endless.sdf";
  ASSERT_EQ(mkfifo(world.c_str(), 0600), 0);
  const HttpReply refused = Show(server, world);
  EXPECT_GE(refused.status, 400) << refused.body;
  EXPECT_FALSE(json::parse(refused.body)["error"].get<std::string>().empty());
  EXPECT_EQ(server.Create("").status, 201);
}

TEST(Metrics, AreServedByARealServer) {
  const Served server({});
  EXPECT_EQ(server.Metric("gsv_steps_total"), 0);
  EXPECT_GT(server.Metric("gsv_broker_calls_total"), 0);
  EXPECT_EQ(server.Metric("gsv_broker_errors_total"), 0);
  ASSERT_EQ(server.Create("").status, 201);
  EXPECT_EQ(server.Metric("gsv_simulations{phase=\"created\"}"), 1);
  const std::string name = json::parse(server.Ask("GET", "/api/simulations").body)[0]["name"];
  ASSERT_EQ(server.Ask("POST", PathOf(name) + "/step", R"({"count": 25})").status, 200);
  const auto deadline = std::chrono::steady_clock::now() + kProgramTimeout;
  while (server.Metric("gsv_steps_total") < 25 && std::chrono::steady_clock::now() < deadline) {
  }
  // The steps of a simulation count even after its deletion.
  ASSERT_EQ(server.Ask("DELETE", PathOf(name)).status, 200);
  EXPECT_EQ(server.Metric("gsv_steps_total"), 25);
  EXPECT_GT(server.Metric("process_resident_memory_bytes"), 1e6);
  EXPECT_GT(server.Metric("process_threads"), 1);
}

TEST(Log, WritesOneJsonObjectPerLineWithoutTokens) {
  const std::string control = "control-secret-0123456789", watch = "watching-secret-0123456789";
  Served server({"--control-token", control, "--watch-token", watch},
                {"--log-level", "trace", "--log-format", "json"});
  // These are all places in which a token, or a part of one, may be.
  const std::string bearer = "Authorization: Bearer ";
  EXPECT_EQ(server.Ask("GET", "/api/simulations").status, 401);
  EXPECT_EQ(server.Ask("GET", "/api/simulations", "", bearer + watch).status, 200);
  EXPECT_EQ(server.Ask("POST", "/api/simulations", "{}", bearer + watch).status, 403);
  EXPECT_EQ(server.Ask("GET", "/api/x?token=" + control).status, 401);
  EXPECT_EQ(server.Ask("GET", "/ws?token=" + watch).status, 426);
  EXPECT_EQ(server.Ask("GET", "/ws?token=" + control + "x").status, 403);
  EXPECT_EQ(server.Ask("POST", "/api/" + control, "{}").status, 401);
  EXPECT_EQ(server.Ask("GET", "/", "", "Origin: http://" + control).status, 403);
  const std::string log = server.End();
  EXPECT_EQ(log.find(control), std::string::npos) << log;
  EXPECT_EQ(log.find(watch), std::string::npos) << log;
  std::istringstream lines(log);
  int refusals = 0;
  for (std::string line; std::getline(lines, line);) {
    const json event = json::parse(line);  // throws for anything that is not JSON
    EXPECT_TRUE(std::regex_match(event.at("time").get<std::string>(),
                                 std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z)")));
    EXPECT_TRUE(event.at("level").is_string());
    EXPECT_TRUE(event.at("pid").is_number_unsigned());
    const std::string message = event.at("message");
    if (message.starts_with("refused ")) ++refusals;
  }
  EXPECT_GE(refusals, 5) << log;
}

// Returns the sockets of a process, as `gsv doctor --security` reports them, by their protocols.
std::map<std::string, std::vector<json>> ExposureOf(pid_t pid) {
  std::map<std::string, std::vector<json>> sockets;
  std::istringstream lines(RunProgram("gsv", {"doctor", "--security", "--json"}).out);
  for (std::string line; std::getline(lines, line);) {
    const json process = json::parse(line);
    if (process["pid"] != pid) continue;
    for (const json& socket : process["sockets"]) sockets[socket["speaks"]].push_back(socket);
  }
  return sockets;
}

TEST(Exposure, DefaultsAllowNoAccessFromOtherMachines) {
  Served server({});
  const auto sockets = ExposureOf(server.pid());
  ASSERT_EQ(sockets.at("viewer, HTTP").size(), 1u);
  ASSERT_GE(sockets.at("CORBA").size(), 1u);
  EXPECT_FALSE(sockets.contains("does not respond"));
  for (const auto& [speaks, all] : sockets) {
    for (const json& socket : all) {
      EXPECT_TRUE(socket["local"]) << socket;
      EXPECT_EQ(socket["complaint"], "") << socket;
    }
  }
  EXPECT_FALSE(sockets.at("viewer, HTTP")[0]["watching_takes_token"]);
}

TEST(Exposure, RemoteAccessWarnsAboutMissingTokensAndTls) {
  Served server({"--listen", "0.0.0.0", "--control-token", "control-secret-0123456789"});
  const json socket = ExposureOf(server.pid()).at("viewer, HTTP").at(0);
  EXPECT_FALSE(socket["local"]) << socket;
  EXPECT_TRUE(socket["watching_takes_token"]);
  EXPECT_TRUE(socket["acting_takes_token"]);
  EXPECT_NE(socket["complaint"].get<std::string>().find("--tls-certificate"), std::string::npos);
}

TEST(Exposure, CertificateAndTokenGiveNoWarning) {
  const base::testing::TestFolder folder;
  const std::string place = folder.path() / "certificates";
  const Outcome made = RunProgram("gsv", {"certificates", "make", place});
  ASSERT_EQ(made.ending, "exit code 0") << made.err;
  Served server({"--listen", "0.0.0.0", "--control-token", "control-secret-0123456789",
                 "--tls-certificate", place + "/server.pem", "--tls-key",
                 place + "/server-key.pem"});
  const json socket = ExposureOf(server.pid()).at("viewer, HTTPS").at(0);
  EXPECT_FALSE(socket["local"]) << socket;
  EXPECT_TRUE(socket["watching_takes_token"]);
  EXPECT_TRUE(socket["acting_takes_token"]);
  EXPECT_EQ(socket["complaint"], "");
  // A client without TLS gets only an error, which names https://.
  const HttpReply plain = server.Ask("GET", "/api/server");
  EXPECT_EQ(plain.status, 400);
  EXPECT_NE(plain.body.find("https://"), std::string::npos);
}

TEST(Certificates, InvalidCertificatesPreventTheStart) {
  const base::testing::TestFolder folder;
  const std::string rubbish = folder.Write("rubbish.pem", "rubbish");
  const Outcome refused = RunProgram(
      "gsv", {"serve", "--port", "0", "--tls-certificate", rubbish, "--tls-key", rubbish});
  EXPECT_NE(refused.ending, "exit code 0");
  EXPECT_NE(refused.err.find("cannot read a certificate"), std::string::npos) << refused.err;
  EXPECT_EQ(RunProgram("gsv", {"serve", "--tls-certificate", rubbish}).ending, "exit code 2");
  const std::string place = folder.path() / "certificates";
  EXPECT_EQ(RunProgram("gsv", {"certificates", "make", place}).ending, "exit code 0");
  const Outcome again = RunProgram("gsv", {"certificates", "make", place});
  EXPECT_NE(again.err.find("already exists"), std::string::npos) << again.err;
  const Outcome two =
      RunProgram("gsv", {"certificates", "make", place, "--name", "lab", "--name", "arm"});
  EXPECT_EQ(two.ending, "exit code 0") << two.err;
  EXPECT_NE(two.out.find("arm-key.pem"), std::string::npos) << two.out;
}

TEST(Doctor, ReportsTheMachineAndTheBroker) {
  const std::string gone = BrokerProcess().reference();
  const Outcome unreachable = RunProgram("gsv", {"doctor", "--broker", gone});
  EXPECT_NE(unreachable.out.find("broker: does not respond"), std::string::npos) << unreachable.out;
  EXPECT_EQ(unreachable.ending, "exit code 5");
  const BrokerProcess broker;
  const Outcome found = RunProgram("gsv", {"doctor", "--broker", broker.reference()});
  EXPECT_NE(found.out.find("broker: ok, responds at " + broker.reference()), std::string::npos)
      << found.out;
  for (const char* line : {"cameras: ", "viewer: ", "descriptors: ", "port 8080 ", "EGL: "}) {
    EXPECT_NE(found.out.find(line), std::string::npos) << line;
  }
}

TEST(Cookies, AreNeverSet) {
  const std::string control = "control-secret-0123456789";
  const Served server({"--control-token", control});
  for (const char* path : {"/", "/healthz", "/metrics", "/api/server", "/api/viewers", "/none"}) {
    const HttpReply reply = server.Ask("GET", path, "", "Authorization: Bearer " + control);
    EXPECT_FALSE(reply.headers.contains("set-cookie")) << path;
  }
}

TEST(Log, UnknownOptionsAreRejected) {
  const Outcome level = RunProgram("gsv", {"--log-level", "loud", "doctor"});
  EXPECT_EQ(level.ending, "exit code 2");
  EXPECT_NE(level.err.find("trace, debug, info"), std::string::npos) << level.err;
  EXPECT_EQ(RunProgram("gsv", {"--log-format", "xml", "doctor"}).ending, "exit code 2");
}

}  // namespace
}  // namespace gsv::testing
