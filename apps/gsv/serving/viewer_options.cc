#include "apps/gsv/serving/viewer_options.h"

#include <CLI/CLI.hpp>

#include "apps/gsv/process/option_values.h"
#include "gsv/base/log.h"

namespace gsv::app {
namespace {

std::function<void(const std::string&)> TakeToken(std::string& token) {
  return [&token](const std::string& text) {
    // Messages must not contain the token.
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
                  "port of the viewer (default: 8080, or a free port if 8080 is in use)\nWith 0, "
                  "gsv chooses a free port.")
      ->check(Between(0, 65535))
      ->type_name("PORT")
      ->group(kViewerGroup);
  command
      .add_option("--listen", options.listen,
                  "address of the viewer\n"
                  "0.0.0.0 means all addresses of this machine. All addresses except loopback "
                  "require a token.")
      ->capture_default_str()
      ->type_name("ADDRESS")
      ->group(kNetworkGroup);
  command
      .add_option("--allow-host", options.names,
                  "additional host name that browsers may use for the viewer; repeatable")
      ->type_name("NAME")
      ->group(kNetworkGroup);
  command
      .add_option_function<std::string>("--control-token", TakeToken(options.tokens.control),
                                        "token that allows control (16+ characters)\nOther users "
                                        "can see it in `ps`, so prefer the variable.")
      ->type_name("TOKEN")
      ->envname("GSV_CONTROL_TOKEN")
      ->group(kNetworkGroup);
  command
      .add_option_function<std::string>(
          "--watch-token", TakeToken(options.tokens.watch),
          "token that allows watching (default: everybody on this machine can watch)\nOn addresses "
          "other than loopback, watching always requires this token or the control token.")
      ->type_name("TOKEN")
      ->envname("GSV_WATCH_TOKEN")
      ->group(kNetworkGroup);
  CLI::Option* certificate =
      command
          .add_option("--tls-certificate", options.tls.certificate,
                      "certificate for HTTPS (PEM)\n`gsv certificates make` makes one.")
          ->type_name("FILE")
          ->envname("GSV_TLS_CERTIFICATE")
          ->group(kNetworkGroup);
  CLI::Option* key =
      command.add_option("--tls-key", options.tls.key, "private key of the certificate (PEM)")
          ->type_name("FILE")
          ->envname("GSV_TLS_KEY")
          ->group(kNetworkGroup);
  certificate->needs(key);
  key->needs(certificate);
}

void AddRecordingsOption(CLI::App& command, ViewerOptions& options) {
  command
      .add_option("--recordings", options.recordings,
                  "folder of recordings (default: current folder)")
      ->type_name("FOLDER")
      ->group(kViewerGroup);
  command
      .add_option("--history", options.history_mib,
                  "memory for the history of each simulation, in MiB; 0 keeps no history")
      ->check(Between(0, 65536))
      ->capture_default_str()
      ->type_name("MIB")
      ->group(kViewerGroup);
}

void AddBrokerOption(CLI::App& command, std::string& broker) {
  command
      .add_option("--broker", broker,
                  "broker, corbaloc::1.2@HOST:PORT/TradingService (default: start one)")
      ->type_name("ADDRESS")
      ->envname("GSV_BROKER")
      ->group(kNetworkGroup);
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
