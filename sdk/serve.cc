#include "sdk/serve.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include <CLI/CLI.hpp>

#include "gsv/base/log.h"
#include "sdk/offered_behaviour.h"

namespace gsv {
namespace {

constexpr int kUsage = 2;
constexpr int kInfrastructure = 5;

struct Arguments {
  std::string broker;
  std::string name;
  bool exit_with_parent = false;
};

int PrintError(const base::Error& error) {
  std::fprintf(stderr, "%s\n", error.Sentence().c_str());
  return error.code == base::ErrorCode::kInvalidArgument ? kUsage : kInfrastructure;
}

// Blocks SIGINT and SIGTERM in this and all later threads, for sigwait(). Also blocks SIGHUP,
// unless SIGHUP is ignored, for example by nohup.
sigset_t BlockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  struct sigaction hang_up {};
  sigaction(SIGHUP, nullptr, &hang_up);
  if (hang_up.sa_handler != SIG_IGN) sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

// Whether a gsv started this program and reads all of its output.
bool IsCaptured() { return std::getenv("GSV_OUTPUT_CAPTURED") != nullptr; }

int Serve(const Arguments& arguments, const BehaviourModule& module, BehaviourFactory factory,
          const sigset_t& signals) {
  auto offered = OfferedBehaviour::Offer(arguments.broker,
                                         {arguments.name, module.description, module.time_managed},
                                         std::move(factory));
  if (!offered) return PrintError(offered.error());
  // The parent process may wait for this line on stdout.
  std::printf("%s: offered at %s\n", arguments.name.c_str(), (*offered)->broker().c_str());
  std::fflush(stdout);
  // If gsv captures the output, it reads stdout until the program ends. Other parent processes stop
  // reading after the line above. For them, the behaviour's output goes to stderr.
  if (arguments.exit_with_parent && !IsCaptured()) dup2(STDERR_FILENO, STDOUT_FILENO);
  int signal = 0;
  sigwait(&signals, &signal);
  // A behaviour that does not return from its run would delay the end, so a second signal ends the
  // program at once.
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  return 0;
}

}  // namespace

int ServeBehaviour(int argc, char** argv, const BehaviourModule& module) {
  if (IsCaptured()) std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  Arguments arguments;
  arguments.name = module.name;
  CLI::App app(module.description);
  app.add_option("--broker", arguments.broker, "broker to which the behaviour is offered")
      ->envname("GSV_BROKER")
      ->required();
  app.add_option("--name", arguments.name, "name of the offer")->capture_default_str();
  app.add_flag("--exit-with-parent", arguments.exit_with_parent,
               "end when the program that started this one ends");
  BehaviourFactory factory = module.configure(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsage;
  }
  base::InitLogging(spdlog::level::info);
  if (arguments.exit_with_parent) prctl(PR_SET_PDEATHSIG, SIGTERM);
  const sigset_t signals = BlockSignals();
  return Serve(arguments, module, std::move(factory), signals);
}

}  // namespace gsv
