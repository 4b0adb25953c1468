// Tests CORBA over TLS with the real programs. Only programs with a certificate of the group's
// authority may call others and be called, from anywhere.
#include <fstream>
#include <optional>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "gsv/broker/testing/raw_connection.h"
#include "gsv/tls/certificates.h"
#include "tests/end_to_end/fleet.h"
#include "tests/support/group.h"
#include "tests/support/other_host.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using Strings = std::vector<std::string>;
namespace fs = std::filesystem;

int PortOf(const std::string& reference) {
  return std::stoi(reference.substr(reference.rfind(':') + 1));
}

// Reads until the peer closes the connection. recv() times out after the time limit of a test.
std::string ReadToTheEnd(int socket) {
  std::string all;
  char bytes[512];
  for (ssize_t count; (count = recv(socket, bytes, sizeof bytes, 0)) > 0;) {
    all.append(bytes, static_cast<std::size_t>(count));
  }
  return all;
}

class Peer {
 public:
  explicit Peer(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const sockaddr_in address = broker::Loopback(port);
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~Peer() { close(socket_); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  void Send(const std::string& bytes) const {
    send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  std::string AwaitEnd() const { return ReadToTheEnd(socket_); }

 private:
  int socket_;
};

// Waits until the error output of the program contains `text`. Returns the error output.
std::string AwaitErrors(const Running& program, const std::string& text) {
  const auto deadline = std::chrono::steady_clock::now() + kProgramTimeout;
  while (program.errors().find(text) == std::string::npos &&
         std::chrono::steady_clock::now() < deadline) {
  }
  return program.errors();
}

// The programs would prefer Unix domain sockets to TLS. Here the path of their folder is too long
// for a socket.
class CorbaTls : public ::testing::Test {
 protected:
  CorbaTls() : runtime_("XDG_RUNTIME_DIR", Runtime()) {}

  const Group group_;

 private:
  std::string Runtime() const {
    const fs::path folder = folder_.path() / std::string(100, 'x');
    fs::create_directory(folder);
    fs::permissions(folder, fs::perms::owner_all);
    return folder;
  }

  const base::testing::TestFolder folder_{};
  const Variable runtime_;
};

class BrokerByTls {
 public:
  explicit BrokerByTls(const std::string& address = "127.0.0.1")
      : program_("gsv", {"broker", "--listen", address, "--port", "0", "--memory"}),
        reference_(program_.AwaitLine("corbaloc")) {}
  const std::string& reference() const { return reference_; }
  int port() const { return PortOf(reference_); }
  Running& program() { return program_; }
  pid_t pid() { return program_.process().pid(); }
  Outcome Offers() const { return RunProgram("gsv", {"offers", "--broker", reference_}); }

 private:
  Running program_;
  const std::string reference_;
};

TEST_F(CorbaTls, HashEqualsThatOfPlainTcp) {
  const auto hash_of = [](const std::string& broker) {
    const Outcome run = RunProgram("gsv", FleetRun(broker));
    EXPECT_EQ(run.ending, "exit code 0") << run.err;
    return run.LastLine().value("state_hash", "none");
  };
  const auto hash = [&] {
    const BrokerProcess broker;
    const Fleet fleet(broker.reference());
    return hash_of(broker.reference());
  };
  const std::string by_tls = hash();
  const Variable without("GSV_CORBA_CERTIFICATE", "");
  EXPECT_EQ(by_tls.size(), 16u);
  EXPECT_EQ(by_tls, hash());
}

TEST_F(CorbaTls, EveryProgramSupportsTls) {
  BrokerByTls broker;
  EXPECT_THAT(broker.reference(), StartsWith("corbaloc:ssliop:1.2@127.0.0.1:"));
  Running behaviour("gsv-wander", {"--broker", broker.reference()});
  behaviour.AwaitLine("offered at");
  Running server("gsv", {"serve", "--headless", "--broker", broker.reference(), "--name", "s"});
  server.AwaitLine("broker: ");
  const Outcome offers = broker.Offers();
  EXPECT_THAT(offers.out, HasSubstr("AgentBehaviourFactory"));
  EXPECT_THAT(offers.out, HasSubstr("SimulationService"));
  EXPECT_THAT(offers.err, IsEmpty());
  Running run("gsv", {"run", "playground", "--headless", "--name", "r", "--robot", "pebble",
                      "--behaviour", "wander", "--broker", broker.reference()});
  run.AwaitLine("broker: ");
  const Outcome ps = RunProgram("gsv", {"ps", "--broker", broker.reference()});
  EXPECT_EQ(ps.ending, "exit code 0") << ps.err;
  EXPECT_THAT(ps.out, HasSubstr("r"));
  EXPECT_EQ(RunProgram("gsv", {"stop", "r", "--broker", broker.reference()}).ending, "exit code 0");
  // A program that starts its own broker also supports TLS.
  EXPECT_EQ(RunProgram("gsv", {"run", "playground", "--headless", "--lockstep", "--duration", "1",
                               "--robot", "pebble", "--behaviour", "wander"})
                .ending,
            "exit code 0");
}

TEST_F(CorbaTls, RemoteAccessNeedsACertificate) {
  const BrokerByTls everywhere("0.0.0.0");
  EXPECT_THAT(everywhere.reference(), StartsWith("corbaloc:ssliop:"));
  const Variable without("GSV_CORBA_CERTIFICATE", "");
  const Outcome refused = RunProgram("gsv", {"broker", "--listen", "0.0.0.0", "--memory"});
  EXPECT_EQ(refused.ending, "exit code 2");
  EXPECT_THAT(refused.err, HasSubstr("0.0.0.0: other machines can reach this address"));
  EXPECT_THAT(refused.err, HasSubstr("--insecure-corba"));
  // A behaviour that its broker would call from another machine is refused as well.
  const std::string& there = everywhere.reference();
  const std::string elsewhere = "corbaloc::1.2@" + there.substr(there.find('@') + 1);
  if (elsewhere.find("@127.") == std::string::npos) {
    const Outcome behaviour = RunProgram("gsv-wander", {"--broker", elsewhere});
    EXPECT_EQ(behaviour.ending, "exit code 2");
    EXPECT_THAT(behaviour.err, HasSubstr("other machines can reach this address"));
  }
}

TEST_F(CorbaTls, ClientWithoutACertificateIsRejected) {
  BrokerByTls broker;
  const Variable without("GSV_CORBA_CERTIFICATE", "");
  const Outcome told = broker.Offers();
  EXPECT_EQ(told.ending, "exit code 5");
  EXPECT_THAT(told.err, HasSubstr("the server requires TLS and a certificate"));
  // A client that uses plain TCP although the server requires TLS gets no answer.
  const std::string plain = "corbaloc::1.2@127.0.0.1:" + std::to_string(broker.port());
  const Outcome cut = RunProgram("gsv", {"offers", "--broker", plain + "/TradingService"});
  EXPECT_EQ(cut.ending, "exit code 5");
  EXPECT_THAT(cut.err, HasSubstr("If the broker requires TLS"));
  EXPECT_THAT(AwaitErrors(broker.program(), "refused"), HasSubstr("it violates the TLS protocol"));
}

TEST_F(CorbaTls, PlainClientOfATlsServiceGetsAnExplanation) {
  std::optional<Variable> without(std::in_place, "GSV_CORBA_CERTIFICATE", "");
  const BrokerProcess plain;
  without.reset();
  Running behaviour("gsv-wander", {"--broker", plain.reference()});
  behaviour.AwaitLine("offered at");
  const Strings run{"run",         "playground", "--headless", "--lockstep",
                    "--duration",  "1",          "--robot",    "pebble",
                    "--behaviour", "wander",     "--broker",   plain.reference()};
  EXPECT_EQ(RunProgram("gsv", run).ending, "exit code 0");
  without.emplace("GSV_CORBA_CERTIFICATE", "");
  const Outcome refused = RunProgram("gsv", run);
  EXPECT_EQ(refused.ending, "exit code 4");
  EXPECT_THAT(refused.err, HasSubstr("the server requires TLS and a certificate"));
}

// If a service on another machine has no certificate, a program with a certificate must not call
// it.
TEST_F(CorbaTls, PlainServicesAreCalledOnThisMachineOnly) {
  OtherHost host(1);
  if (!host.refusal().empty()) GTEST_SKIP() << host.refusal();
  std::optional<Variable> without(std::in_place, "GSV_CORBA_CERTIFICATE", "");
  Running broker("gsv", {"--insecure-corba", "broker", "--listen", host.address_here(), "--port",
                         "0", "--memory"});
  const std::string reference = broker.AwaitLine("corbaloc");
  without.reset();
  Running refused("gsv", {"offers", "--broker", reference}, host.wrapper());
  const Outcome outcome = refused.AwaitEnd();
  EXPECT_EQ(outcome.ending, "exit code 5");
  EXPECT_THAT(outcome.err,
              HasSubstr("the server does not support TLS, and is not on this machine"));
  Running insecure("gsv", {"--insecure-corba", "offers", "--broker", reference}, host.wrapper());
  EXPECT_EQ(insecure.AwaitEnd().ending, "exit code 0");
  EXPECT_EQ(RunProgram("gsv", {"offers", "--broker", reference}).ending, "exit code 0");
}

TEST_F(CorbaTls, CertificatesOfAnotherAuthorityAreRejectedBothWays) {
  BrokerByTls broker;
  const Group other_group;
  const Outcome client = broker.Offers();
  EXPECT_EQ(client.ending, "exit code 5");
  EXPECT_THAT(client.err, HasSubstr("its certificate was not issued by this group's authority"));
  // This client trusts the server, but does not belong to its group.
  const Variable trusting("GSV_CORBA_AUTHORITY", group_.File("ca.pem"));
  const Outcome outsider = broker.Offers();
  EXPECT_EQ(outsider.ending, "exit code 5");
  EXPECT_THAT(outsider.err, HasSubstr("it rejects this program's certificate"));
  EXPECT_THAT(AwaitErrors(broker.program(), "authority"),
              HasSubstr("its certificate was not issued by this group's authority"));
}

TEST_F(CorbaTls, ExpiredCertificateIsRejectedByOwnerAndPeers) {
  BrokerByTls broker;
  using std::chrono::hours;
  ASSERT_TRUE(tls::MakeCertificate(group_.File(""), {"old", {}, {-hours(48), -hours(24)}}));
  const auto openssl = [&](const std::string& name) {
    std::ostringstream command;
    command << "cd " << group_.File("")
            << " && openssl s_client -connect 127.0.0.1:" << broker.port()
            << " -CAfile ca.pem -cert " << name << ".pem -key " << name
            << "-key.pem < /dev/null > /dev/null 2>&1";
    return std::system(command.str().c_str());
  };
  EXPECT_EQ(openssl("lab"), 0);
  (void)openssl("old");  // with TLS 1.3, openssl may not notice the refusal
  EXPECT_THAT(AwaitErrors(broker.program(), "refused"), HasSubstr("its certificate has expired"));
  const Variable old("GSV_CORBA_CERTIFICATE", group_.File("old.pem"));
  const Outcome refused = broker.Offers();
  EXPECT_THAT(refused.err, HasSubstr("this certificate has expired"));
  EXPECT_EQ(refused.ending, "exit code 2");
}

TEST_F(CorbaTls, InvalidFilesPreventTheStart) {
  const auto refusal = [&](const char* variable, const fs::path& file) {
    const Variable wrong(variable, file);
    const Outcome outcome = RunProgram("gsv", {"broker", "--memory"});
    EXPECT_THAT(outcome.ending, ::testing::AnyOf("exit code 2", "exit code 5"));
    EXPECT_THAT(outcome.err, HasSubstr(file.string()));
    return outcome.err;
  };
  EXPECT_THAT(refusal("GSV_CORBA_CERTIFICATE", group_.File("none.pem")), HasSubstr("none.pem"));
  EXPECT_THAT(refusal("GSV_CORBA_KEY", group_.File("none.pem")), HasSubstr("cannot read a key"));
  EXPECT_THAT(refusal("GSV_CORBA_KEY", group_.File("ca-key.pem")),
              HasSubstr("does not belong to the certificate"));
  EXPECT_THAT(refusal("GSV_CORBA_AUTHORITY", group_.File("lab.pem")),
              HasSubstr("not the certificate of an authority"));
  if (geteuid() == 0) return;  // root may read everything
  fs::permissions(group_.File("lab-key.pem"), fs::perms::none);
  EXPECT_THAT(refusal("GSV_CORBA_KEY", group_.File("lab-key.pem")), HasSubstr("denied"));
}

// There are more connections than the broker has threads, and more than it allows pending
// handshakes.
TEST_F(CorbaTls, StalledHandshakesDelayNoOtherClient) {
  BrokerByTls broker;
  std::vector<std::unique_ptr<Peer>> stalled;
  for (int i = 0; i < 300; ++i) {
    stalled.push_back(std::make_unique<Peer>(broker.port()));
    // Sends the start of a TLS hello.
    if (i % 2 == 0) stalled.back()->Send({"\x16\x03\x01\x02\x00\x01", 6});
  }
  const Outcome offers = broker.Offers();
  EXPECT_EQ(offers.ending, "exit code 0") << offers.err;
  // The oldest connection was dropped to accept the newest. The newest connections have the same
  // time limit as others.
  EXPECT_THAT(stalled.front()->AwaitEnd(), IsEmpty());
  (void)stalled.back()->AwaitEnd();
  EXPECT_THAT(AwaitErrors(broker.program(), "finish"),
              HasSubstr("did not finish the TLS handshake"));
  EXPECT_EQ(broker.Offers().ending, "exit code 0");
}

TEST_F(CorbaTls, GarbageEndsOnlyItsOwnConnection) {
  BrokerByTls broker;
  Running server("gsv", {"serve", "--headless", "--broker", broker.reference()});
  server.AwaitLine("broker: ");
  const std::string offers = broker.Offers().out;
  ASSERT_THAT(offers, HasSubstr("127.0.0.1:"));
  const int service = std::stoi(offers.substr(offers.find("127.0.0.1:") + 10));
  std::uint32_t state = 7;
  for (int round = 0; round < 100; ++round) {
    std::string bytes;
    for (int i = 0; i < 200; ++i) {
      state = state * 1664525 + 1013904223;
      bytes.push_back(static_cast<char>(state >> 24));
    }
    if (round % 3 == 1) bytes = "GIOP\1\2\1\0" + bytes;
    if (round % 3 == 2) bytes = "\x16\x03\x01" + bytes;
    for (const int port : {broker.port(), service}) {
      const Peer peer(port);
      peer.Send(bytes);
      // In the other rounds, the bytes may look like the start of a longer TLS record. The server
      // waits for the rest of this record, and does not close the connection.
      if (round % 3 == 0) (void)peer.AwaitEnd();
    }
  }
  EXPECT_EQ(broker.Offers().out, offers);
  const Outcome ps = RunProgram("gsv", {"ps", "--broker", broker.reference()});
  EXPECT_EQ(ps.ending, "exit code 0") << ps.err;
}

std::size_t DescriptorsOf(pid_t pid) {
  return static_cast<std::size_t>(std::distance(
      fs::directory_iterator("/proc/" + std::to_string(pid) + "/fd"), fs::directory_iterator()));
}

// Regression: a connection that ended after its handshake had no address any more when the ORB
// requested it, and stayed open.
TEST_F(CorbaTls, DisconnectAfterTheHandshakeLeaksNothing) {
  BrokerByTls broker;
  EXPECT_EQ(broker.Offers().ending, "exit code 0");
  const std::size_t before = DescriptorsOf(broker.pid());
  std::ostringstream command;
  command << "cd " << group_.File("") << " && openssl s_time -connect 127.0.0.1:" << broker.port()
          << " -new -time 1 -CAfile ca.pem -cert lab.pem -key lab-key.pem > /dev/null 2>&1";
  ASSERT_EQ(std::system(command.str().c_str()), 0);
  const auto deadline = std::chrono::steady_clock::now() + kProgramTimeout;
  while (DescriptorsOf(broker.pid()) > before && std::chrono::steady_clock::now() < deadline) {
  }
  EXPECT_LE(DescriptorsOf(broker.pid()), before);
  EXPECT_EQ(broker.Offers().ending, "exit code 0");
}

// Regression: omniORB's own transport crashes if the peer closes the connection during the
// handshake.
TEST_F(CorbaTls, CloseDuringTheHandshakeFailsOnlyThatCall) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address = broker::Loopback(0);
  socklen_t length = sizeof address;
  ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(listen(listener, 8), 0);
  ASSERT_EQ(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &length), 0);
  Running client("gsv", {"offers", "--broker",
                         "corbaloc:ssliop:1.2@127.0.0.1:" +
                             std::to_string(ntohs(address.sin_port)) + "/TradingService"});
  const int connection = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
  const std::string close_notify("\x15\x03\x03\x00\x02\x01\x00", 7);
  send(connection, close_notify.data(), close_notify.size(), MSG_NOSIGNAL);
  shutdown(connection, SHUT_WR);
  (void)ReadToTheEnd(connection);
  close(connection);
  close(listener);
  const Outcome outcome = client.AwaitEnd();
  EXPECT_EQ(outcome.ending, "exit code 5");
  EXPECT_THAT(outcome.err, HasSubstr("it closed the connection"));
}

TEST_F(CorbaTls, InteroperatesWithOtherOrbs) {
  BrokerByTls broker;
  std::ofstream both(group_.File("both.pem"));
  for (const char* part : {"lab-key.pem", "lab.pem"})
    both << std::ifstream(group_.File(part)).rdbuf();
  both.close();
  const auto ask = [&](const fs::path& authority, const fs::path& key) {
    return RunProgram("../tests/foreign_tls_client",
                      {"-ORBsslCAFile", authority, "-ORBsslKeyFile", key, "-ORBsslKeyPassword", "",
                       broker.reference()})
        .out;
  };
  EXPECT_EQ(ask(group_.File("ca.pem"), group_.File("both.pem")), "alive\n");
}

// Returns the report of `gsv doctor --security` about a program's sockets.
std::vector<nlohmann::json> SocketsOf(pid_t pid) {
  std::istringstream lines(RunProgram("gsv", {"doctor", "--security", "--json"}).out);
  for (std::string line; std::getline(lines, line);) {
    const auto process = nlohmann::json::parse(line);
    if (process["pid"] == pid) return process["sockets"];
  }
  return {};
}

TEST_F(CorbaTls, DoctorDistinguishesTlsFromPlainCorba) {
  Running by_tls("gsv", {"broker", "--listen", "0.0.0.0", "--port", "0", "--memory"});
  by_tls.AwaitLine("corbaloc");
  const auto good = SocketsOf(by_tls.process().pid());
  ASSERT_EQ(good.size(), 1u);
  EXPECT_EQ(good[0]["speaks"], "CORBA, TLS");
  EXPECT_EQ(good[0]["takes_certificate"], true);
  EXPECT_EQ(good[0]["complaint"], "");
  const Variable without("GSV_CORBA_CERTIFICATE", "");
  Running plain("gsv",
                {"--insecure-corba", "broker", "--listen", "0.0.0.0", "--port", "0", "--memory"});
  plain.AwaitLine("corbaloc");
  const auto bad = SocketsOf(plain.process().pid());
  ASSERT_EQ(bad.size(), 1u);
  EXPECT_EQ(bad[0]["speaks"], "CORBA");
  EXPECT_EQ(bad[0]["takes_certificate"], false);
  EXPECT_THAT(bad[0]["complaint"].get<std::string>(), HasSubstr("--insecure-corba"));
}

}  // namespace
}  // namespace gsv::testing
