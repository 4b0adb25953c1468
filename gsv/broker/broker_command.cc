#include "gsv/broker/broker_command.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include <sys/prctl.h>
#include <unistd.h>

namespace gsv::broker {
namespace {

constexpr int kOk = 0;
constexpr int kUsage = 2;
constexpr int kInfrastructure = 5;
constexpr int kInterrupted = 130;

int Complain(const base::Error& error) {
  std::fprintf(stderr, "%s\n", error.Sentence().c_str());
  return error.code == base::ErrorCode::kInvalidArgument ? kUsage : kInfrastructure;
}

// False when the parent is gone already.
bool EndWith(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  return getppid() == parent;
}

// Of a process that ends the ORB is not taken down: a thread of its own that is late finds it gone,
// and the process dies (omniORB 4.2.5, seen after a minute of mutated requests). Sanitizers tell
// what was lost, and coverage what ran, when all is taken down.
int End(Broker& broker, int exit_code) {
  broker.Close();
  // The broker's reference goes to stdout. A client that reads it there did not get it.
  const bool is_lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (is_lost && exit_code == kOk) exit_code = kInfrastructure;
#if !defined(GSV_SANITIZED) && !defined(GSV_COVERAGE)
  std::fflush(nullptr);
  std::_Exit(exit_code);
#else
  return exit_code;
#endif
}

}  // namespace

int BrokerMain(const BrokerCommand& command) {
  // Blocked before a thread starts, so that only sigwait() sees them.
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGINT);
  sigaddset(&ends, SIGTERM);
  struct sigaction hang_up {};
  sigaction(SIGHUP, nullptr, &hang_up);
  if (hang_up.sa_handler != SIG_IGN) sigaddset(&ends, SIGHUP);  // nohup ignores it
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  if (command.parent != 0 && !EndWith(command.parent)) return kOk;

  if (auto limited = ApplyProcessLimits(command.process); !limited) {
    return Complain(limited.error());
  }
  const auto broker = Broker::Start(command.broker);
  if (!broker) return Complain(broker.error());
  std::printf("%s\n", (*broker)->reference().c_str());
  std::fflush(stdout);

  int signal = 0;
  sigwait(&ends, &signal);
  return End(**broker, signal == SIGINT ? kInterrupted : kOk);
}

}  // namespace gsv::broker
