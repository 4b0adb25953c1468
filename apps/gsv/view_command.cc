#include <cstdio>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands.h"
#include "apps/gsv/exit_code.h"
#include "apps/gsv/installation.h"
#include "gsv/gateway/relay.h"

namespace gsv::app {
namespace {

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
    std::string url;
    int port = -1;
  };
  CLI::App* command = line.app.add_subcommand(
      "view", "Watch a simulation that runs on another instance, at its viewer's URL");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("url", arguments->url, "the other instance's viewer, http://HOST:PORT/")
      ->required();
  command->add_option("--port", arguments->port, "this viewer's port; 0: any that is free")
      ->check(CLI::Range(0, 65535));
  command->callback([arguments, line] {
    line.exit_code = View(arguments->url, arguments->port >= 0 ? arguments->port : 8080,
                          arguments->port >= 0, line.signals);
  });
}

}  // namespace gsv::app
