#include <cstdio>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/serving/remote_simulations.h"
#include "apps/gsv/serving/viewer_options.h"
#include "gsv/base/log.h"

namespace gsv::app {
namespace {

// The viewer's address of an instance that is named by it, or by its offer.
base::Result<std::string> ViewerOf(const std::string& instance, const std::string& broker) {
  if (instance.starts_with("http://") || instance.starts_with("https://")) return instance;
  if (instance.find("://") != std::string::npos) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a viewer's address begins with http:// or https://", instance);
  }
  const auto found = FindOneInstance({broker, instance, {}});
  if (!found) return base::Fail(found.error());
  if (!found->viewer_url.empty()) return found->viewer_url;
  return base::Fail(base::ErrorCode::kUnavailable,
                    "it was started without a viewer (--headless), so there is nothing to relay",
                    found->Describe());
}

int View(const gateway::RelayedInstance& there, const ViewerOptions& web, Signals& signals) {
  gateway::GatewayOptions options;
  options.web_root = ShareFolder() / "web";
  options.docs_root = ShareFolder() / "docs";
  auto relay = StartViewer(
      web, options, [&](const auto& here) { return gateway::Gateway::StartRelay(here, there); });
  if (!relay) return Complain(relay.error());
  std::printf("viewer: %s\n", (*relay)->url().c_str());
  std::fflush(stdout);
  signals.Wait();
  return kOk;
}

}  // namespace

void AddViewCommand(const CommandLine& line) {
  struct Arguments {
    std::string instance, broker, token, authority;
    ViewerOptions web;
  };
  CLI::App* command = line.app.add_subcommand(
      "view",
      "Watch the simulations of another instance: its only viewer, however many watch here");
  auto arguments = std::make_shared<Arguments>();
  command->add_option(
      "instance", arguments->instance,
      "the other instance: its viewer, http(s)://HOST:PORT/, or its offer's name, pid "
      "or HOST:PID; without it: the newest of yours");
  command
      ->add_option("--broker", arguments->broker,
                   "where it is offered; without it: those of your running instances")
      ->envname("GSV_BROKER");
  command
      ->add_option(
          "--token", arguments->token,
          "the other instance's control or watch token, shown there for all who watch here")
      ->envname("GSV_TOKEN");
  command->add_option("--authority", arguments->authority,
                      "a PEM file with the certificate of who signed that of the other instance, "
                      "where that one speaks HTTPS; without it: whom this system trusts");
  AddViewerOptions(*command, arguments->web);
  command->callback([arguments, line] {
    base::RedactInLog(arguments->token);
    const auto url = ViewerOf(arguments->instance, arguments->broker);
    if (!url) {
      line.exit_code = Complain(url.error());
      return;
    }
    line.exit_code =
        View({*url, arguments->token, arguments->authority}, arguments->web, line.signals);
  });
}

}  // namespace gsv::app
