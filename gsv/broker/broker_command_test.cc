#include "gsv/broker/broker_command.h"

#include <array>
#include <csignal>
#include <cstdlib>

#include <fcntl.h>
#include <netinet/in.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/testing/broker_fixture.h"

namespace gsv::broker {
namespace {

// Returns a port on which no process listens at this time.
std::string FreePort() {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  EXPECT_EQ(bind(socket, any, size), 0);
  EXPECT_EQ(getsockname(socket, any, &size), 0);
  close(socket);
  return std::to_string(ntohs(address.sin_port));
}

TEST(Broker, EndsOnSignalsWithAnExitCode) {
  BrokerProcess terminated;
  terminated.Send(SIGTERM);
  EXPECT_EQ(terminated.Wait(), 0);
  BrokerProcess interrupted;
  interrupted.Send(SIGINT);
  EXPECT_EQ(interrupted.Wait(), 130);
}

TEST(Broker, ReportsThatItsPortIsInUse) {
  BrokerProcess first;
  BrokerProcess second({first.port()});
  EXPECT_EQ(second.reference(), "");
  EXPECT_EQ(second.Wait(), 5);
  EXPECT_EQ(second.Stderr(), "broker at 127.0.0.1:" + first.port() + ": port " + first.port() +
                                 " is in use; choose another, or 0 for any free port\n");
}

TEST(Broker, RestartsOnTheSamePortWithoutOffersIfItHasNoFile) {
  const std::string port = FreePort();
  BrokerProcess first({port});
  ASSERT_EQ(first.port(), port);
  auto client = BrokerClient::Connect(TestOrb(), first.reference());
  ASSERT_TRUE(client) << client.error().Sentence();
  ASSERT_TRUE(client->EnsureServiceType({.name = "Robot"}));
  first.Send(SIGTERM);
  ASSERT_EQ(first.Wait(), 0);
  BrokerProcess second({port});
  ASSERT_EQ(second.reference(), "corbaloc::1.2@127.0.0.1:" + port + "/TradingService");
  auto again = BrokerClient::Connect(TestOrb(), second.reference());
  ASSERT_TRUE(again) << again.error().Sentence();
  EXPECT_TRUE(again->ServiceTypeNames()->empty());
}

// The test reads the broker's stdout up to its end, which comes only when the broker has ended.
TEST(Broker, EndsWithItsParent) {
  int out[2];
  ASSERT_EQ(pipe2(out, O_CLOEXEC), 0);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  std::string shell = "sh";
  std::string option = "-c";
  std::string script = std::string(std::getenv("GSV_BUILD_DIR")) +
                       "/tests/gsv_broker_test_server 0; echo the parent outlived it";
  std::array<char*, 4> argv = {shell.data(), option.data(), script.data(), nullptr};
  pid_t parent = 0;
  ASSERT_EQ(posix_spawnp(&parent, "sh", &actions, nullptr, argv.data(), environ), 0);
  posix_spawn_file_actions_destroy(&actions);
  close(out[1]);

  std::string printed;
  const auto read_one = [&] {
    char c = 0;
    if (read(out[0], &c, 1) != 1) return false;
    printed.push_back(c);
    return true;
  };
  while (read_one() && printed.back() != '\n') {
  }
  EXPECT_EQ(printed.substr(0, 14), "corbaloc::1.2@");
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  while (read_one()) {
  }
  EXPECT_EQ(printed.back(), '\n') << "nothing more was printed";
  close(out[0]);
}

}  // namespace
}  // namespace gsv::broker
