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

int PrintError(const base::Error& error) {
  std::fprintf(stderr, "%s\n", error.Sentence().c_str());
  return error.code == base::ErrorCode::kInvalidArgument ? kUsage : kInfrastructure;
}

// Makes the kernel send SIGTERM to this process when the process `parent` ends. Returns false if
// `parent` has already ended.
bool EndWith(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  return getppid() == parent;
}

// Ends the process without destroying the ORB. A late thread of the ORB would use the destroyed ORB
// and crash (seen with omniORB 4.2.5 after a minute of mutated requests). In builds with sanitizers
// or coverage the ORB is destroyed, so that leaks and executed lines are reported.
int End(Broker& broker, int exit_code) {
  broker.Close();
  // If writing the broker's reference to stdout failed, nobody knows the broker's address, so the
  // exit code reports an error.
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
  // Blocks the signals before threads start, so that only sigwait() receives them.
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGINT);
  sigaddset(&ends, SIGTERM);
  struct sigaction hang_up {};
  sigaction(SIGHUP, nullptr, &hang_up);
  // if nohup started this process, SIGHUP is ignored, and remains ignored
  if (hang_up.sa_handler != SIG_IGN) sigaddset(&ends, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  if (command.parent != 0 && !EndWith(command.parent)) return kOk;

  if (auto limited = ApplyProcessLimits(command.process); !limited) {
    return PrintError(limited.error());
  }
  const auto broker = Broker::Start(command.broker);
  if (!broker) return PrintError(broker.error());
  std::printf("%s\n", (*broker)->reference().c_str());
  std::fflush(stdout);

  int signal = 0;
  sigwait(&ends, &signal);
  return End(**broker, signal == SIGINT ? kInterrupted : kOk);
}

}  // namespace gsv::broker
