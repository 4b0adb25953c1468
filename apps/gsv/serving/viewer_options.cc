#include "apps/gsv/serving/viewer_options.h"

#include <CLI/CLI.hpp>

#include "gsv/base/log.h"

namespace gsv::app {
namespace {

std::function<void(const std::string&)> TakeToken(std::string& token) {
  return [&token](const std::string& text) {
    // The text itself is told to nobody.
    if (const auto good = gateway::access::CheckToken(text); !good) {
      throw CLI::ValidationError(good.error().Sentence());
    }
    base::RedactInLog(text);
    token = text;
  };
}

}  // namespace

void AddViewerOptions(CLI::App& command, ViewerOptions& options) {
  command
      .add_option("--port", options.port,
                  "the viewer's port; 0: any that is free (default: 8080, or any)")
      ->check(CLI::Range(0, 65535));
  command
      .add_option("--listen", options.listen,
                  "the address on which the viewer listens; 0.0.0.0 is every one of this machine, "
                  "and like all but loopback takes a token")
      ->capture_default_str();
  command.add_option("--allow-host", options.names,
                     "another name of this machine under which the viewer may be opened");
  command
      .add_option_function<std::string>("--control-token", TakeToken(options.tokens.control),
                                        "who shows it may act; 16 characters or more. Seen by "
                                        "others in a list of processes: prefer the variable")
      ->envname("GSV_CONTROL_TOKEN");
  command
      .add_option_function<std::string>(
          "--watch-token", TakeToken(options.tokens.watch),
          "who shows it may watch; without it watching is free on this machine")
      ->envname("GSV_WATCH_TOKEN");
  CLI::Option* certificate =
      command
          .add_option("--tls-certificate", options.tls.certificate,
                      "a PEM file, for HTTPS; `gsv certificates make` makes one")
          ->envname("GSV_TLS_CERTIFICATE");
  CLI::Option* key = command.add_option("--tls-key", options.tls.key, "its key, a PEM file")
                         ->envname("GSV_TLS_KEY");
  certificate->needs(key);
  key->needs(certificate);
}

void AddRecordingsOption(CLI::App& command, ViewerOptions& options) {
  command.add_option("--recordings", options.recordings,
                     "the folder whose recordings the viewer lists, and to which it records; "
                     "without it: the current one");
}

base::Result<std::unique_ptr<gateway::Gateway>> StartViewer(
    const ViewerOptions& options, gateway::GatewayOptions gateway,
    const std::function<
        base::Result<std::unique_ptr<gateway::Gateway>>(const gateway::GatewayOptions&)>& start) {
  constexpr std::uint16_t kDefaultPort = 8080;
  const bool is_given = options.port >= 0;
  gateway.version = GSV_VERSION;
  gateway.host = options.listen;
  gateway.allowed_hosts = options.names;
  gateway.tokens = options.tokens;
  gateway.tls = options.tls;
  gateway.port = is_given ? static_cast<std::uint16_t>(options.port) : kDefaultPort;
  auto started = start(gateway);
  if (started || is_given) return started;
  gateway.port = 0;
  return start(gateway);
}

}  // namespace gsv::app
