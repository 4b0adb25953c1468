#include <cstdio>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands.h"
#include "apps/gsv/exit_code.h"
#include "apps/gsv/installation.h"
#include "apps/gsv/remote_simulations.h"
#include "gsv/gateway/relay.h"

namespace gsv::app {
namespace {

// The viewer's address of an instance that is named by it, or by its offer.
base::Result<std::string> ViewerOf(const std::string& instance, const std::string& broker) {
  if (instance.starts_with("http://")) return instance;
  const auto found = FindOneInstance({broker, instance, {}});
  if (!found) return base::Fail(found.error());
  if (!found->viewer_url.empty()) return found->viewer_url;
  return base::Fail(base::ErrorCode::kUnavailable,
                    "it was started without a viewer (--headless), so there is nothing to relay",
                    found->Describe());
}

int View(const std::string& url, int port, bool port_given, Signals& signals) {
  gateway::GatewayOptions options;
  options.port = static_cast<std::uint16_t>(port);
  options.web_root = ShareFolder() / "web";
  auto relay = gateway::Relay::Start(options, url);
  if (!relay && !port_given) {
    options.port = 0;
    relay = gateway::Relay::Start(options, url);
  }
  if (!relay) return Complain(relay.error());
  std::printf("viewer: %s\n", (*relay)->url().c_str());
  std::fflush(stdout);
  signals.Wait();
  return kOk;
}

}  // namespace

void AddViewCommand(const CommandLine& line) {
  struct Arguments {
    std::string instance, broker;
    int port = -1;
  };
  CLI::App* command = line.app.add_subcommand(
      "view",
      "Watch the simulations of another instance: its only viewer, however many watch here");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("instance", arguments->instance,
                      "the other instance: its viewer, http://HOST:PORT/, or its offer's name, pid "
                      "or HOST:PID; without it: the newest of yours");
  command
      ->add_option("--broker", arguments->broker,
                   "where it is offered; without it: those of your running instances")
      ->envname("GSV_BROKER");
  command->add_option("--port", arguments->port, "this viewer's port; 0: any that is free")
      ->check(CLI::Range(0, 65535));
  command->callback([arguments, line] {
    const auto url = ViewerOf(arguments->instance, arguments->broker);
    if (!url) {
      line.exit_code = Complain(url.error());
      return;
    }
    line.exit_code = View(*url, arguments->port >= 0 ? arguments->port : 8080, arguments->port >= 0,
                          line.signals);
  });
}

}  // namespace gsv::app
