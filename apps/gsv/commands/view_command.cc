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

// Returns the address of an instance's viewer. `instance` is that address or the instance's name.
base::Result<std::string> ViewerOf(const std::string& instance, const std::string& broker) {
  if (instance.starts_with("http://") || instance.starts_with("https://")) return instance;
  if (instance.find("://") != std::string::npos) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        "cannot be used as the address of a viewer: it must begin with http:// or https://",
        instance);
  }
  const auto found = FindOneInstance({broker, instance, {}});
  if (!found) return base::Fail(found.error());
  if (!found->viewer_url.empty()) return found->viewer_url;
  return base::Fail(base::ErrorCode::kUnavailable,
                    "cannot be relayed: it runs without a viewer. Start it without --headless",
                    found->Describe());
}

int View(const gateway::RelayedInstance& there, const ViewerOptions& web, Signals& signals) {
  gateway::GatewayOptions options;
  options.web_root = ShareFolder() / "web";
  options.docs_root = ShareFolder() / "docs";
  auto relay = StartViewer(
      web, options, [&](const auto& here) { return gateway::Gateway::StartRelay(here, there); });
  if (!relay) return PrintError(relay.error());
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
  constexpr const char* kOtherGroup = "The other instance";
  CLI::App* command = line.app.add_subcommand("view", "Relay another running gsv to many viewers");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("instance", arguments->instance,
                      "viewer address http(s)://HOST:PORT/, name, PID or HOST:PID (default: your "
                      "newest)");
  command
      ->add_option("--broker", arguments->broker,
                   "broker to search (default: those of your running instances)")
      ->type_name("ADDRESS")
      ->envname("GSV_BROKER")
      ->group(kOtherGroup);
  command->add_option("--token", arguments->token, "control or watch token of the other instance")
      ->type_name("TOKEN")
      ->envname("GSV_TOKEN")
      ->group(kOtherGroup);
  command
      ->add_option("--authority", arguments->authority,
                   "certificate authority of the other instance, PEM (default: the system's)")
      ->type_name("FILE")
      ->group(kOtherGroup);
  AddViewerOptions(*command, arguments->web);
  command->callback([arguments, line] {
    base::RedactInLog(arguments->token);
    const auto url = ViewerOf(arguments->instance, arguments->broker);
    if (!url) {
      line.exit_code = PrintError(url.error());
      return;
    }
    line.exit_code =
        View({*url, arguments->token, arguments->authority}, arguments->web, line.signals);
  });
}

}  // namespace gsv::app
