#include "sdk/serve.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "gsv/base/log.h"
#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/corbaloc.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/orb/orb.h"
#include "sdk/behaviour_servant.h"
#include "sdk/fault_delay.h"

namespace gsv {
namespace {

constexpr int kUsage = 2;
constexpr int kInfrastructure = 5;

struct Arguments {
  std::string broker;
  std::string name;
  bool exit_with_parent = false;
};

std::string HostName() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : "localhost";
}

int Complain(const base::Error& error) {
  std::fprintf(stderr, "%s\n", error.Sentence().c_str());
  return error.code == base::ErrorCode::kInvalidArgument ? kUsage : kInfrastructure;
}

// SIGINT and SIGTERM are blocked from here on, in this and all later threads, for sigwait().
sigset_t BlockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

base::Result<CORBA::ORB_var> StartOrb(const std::string& broker) {
  orb::OrbOptions options;
  options.local_socket = true;
  auto reference = broker::NormaliseReference(broker);
  if (!reference) return base::Fail(reference.error());
  if (const std::string host = broker::HostOf(*reference); !host.empty()) {
    auto local = orb::LocalAddressTowards(host);
    if (!local) return base::Fail(local.error());
    options.host = *local;
  }
  return orb::StartOrb(options);
}

int Serve(const Arguments& arguments, const BehaviourModule& module, BehaviourFactory factory,
          const sigset_t& signals) {
  auto orb = StartOrb(arguments.broker);
  if (!orb) return Complain(orb.error());
  if (auto ok = sdk::DelayCallsAsEnvironmentSays(); !ok) return Complain(ok.error());
  auto broker = broker::BrokerClient::Connect(*orb, arguments.broker);
  if (!broker) return Complain(broker.error());
  if (auto ok = broker->EnsureServiceType(broker::AgentBehaviourFactoryType()); !ok)
    return Complain(ok.error());

  const PortableServer::POA_var poa = orb::RootPoa(*orb);
  const PortableServer::Servant_var<sdk::BehaviourFactoryServant> servant(
      new sdk::BehaviourFactoryServant(poa, std::move(factory)));
  const PortableServer::ObjectId_var id = poa->activate_object(servant);
  const CORBA::Object_var reference = poa->id_to_reference(id);
  const broker::BehaviourOffer offer{arguments.name, module.description, HostName(),
                                     static_cast<std::int32_t>(getpid()), module.time_managed};
  auto offer_id =
      broker->Export(broker::AgentBehaviourFactoryType().name, reference, PropertiesOf(offer));
  if (!offer_id) return Complain(offer_id.error());
  // One line on stdout: whoever started this program may wait for it.
  std::printf("%s: offered at %s\n", arguments.name.c_str(), broker->reference().c_str());
  std::fflush(stdout);

  int signal = 0;
  sigwait(&signals, &signal);
  if (auto ok = broker->Withdraw(*offer_id); !ok) {
    // The broker may have gone first; then there is no offer either.
    spdlog::debug("{}", ok.error().Sentence());
  }
  (*orb)->shutdown(true);
  (*orb)->destroy();
  return 0;
}

}  // namespace

int ServeBehaviour(int argc, char** argv, const BehaviourModule& module) {
  Arguments arguments;
  arguments.name = module.name;
  CLI::App app(module.description);
  app.add_option("--broker", arguments.broker, "the broker to offer the behaviour at")
      ->envname("GSV_BROKER")
      ->required();
  app.add_option("--name", arguments.name, "the name to offer it under")->capture_default_str();
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
