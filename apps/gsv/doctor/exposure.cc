#include "apps/gsv/doctor/exposure.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "gsv/gateway/access/access_rule.h"
#include "gsv/tls/server_probe.h"

namespace gsv::app {
namespace {

constexpr timeval kAnswerTimeout{2, 0};

class Connection {
 public:
  explicit Connection(const Listener& listener) {
    // If the socket listens on all addresses, connects to the loopback address.
    const bool is_ipv6 = listener.address.find(':') != std::string::npos;
    descriptor_ = socket(is_ipv6 ? AF_INET6 : AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &kAnswerTimeout, sizeof kAnswerTimeout);
    setsockopt(descriptor_, SOL_SOCKET, SO_SNDTIMEO, &kAnswerTimeout, sizeof kAnswerTimeout);
    int failed = -1;
    if (is_ipv6) {
      sockaddr_in6 address{};
      address.sin6_family = AF_INET6;
      address.sin6_port = htons(listener.port);
      inet_pton(AF_INET6, listener.address == "::" ? "::1" : listener.address.c_str(),
                &address.sin6_addr);
      failed = connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address);
    } else {
      sockaddr_in address{};
      address.sin_family = AF_INET;
      address.sin_port = htons(listener.port);
      inet_pton(AF_INET, listener.address == "0.0.0.0" ? "127.0.0.1" : listener.address.c_str(),
                &address.sin_addr);
      failed = connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address);
    }
    is_open_ = failed == 0;
  }
  ~Connection() { close(descriptor_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  int descriptor() const { return descriptor_; }

  // Returns the first part of the answer, or an empty text if there is none.
  std::string Exchange(const std::string& request) const {
    if (!is_open_ || send(descriptor_, request.data(), request.size(), MSG_NOSIGNAL) < 0) return {};
    std::string answer(4096, '\0');
    const ssize_t length = recv(descriptor_, answer.data(), answer.size(), 0);
    answer.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
    return answer;
  }

 private:
  int descriptor_ = -1;
  bool is_open_ = false;
};

std::string Asking(const Listener& listener, const char* method, const char* target,
                   const std::string& body) {
  const bool is_any = listener.address == "0.0.0.0" || listener.address == "::";
  const std::string host =
      gateway::Authority(is_any ? "127.0.0.1" : listener.address, listener.port);
  return fmt::format(
      "{} {} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nContent-Length: {}\r\n\r\n{}", method,
      target, host, body.size(), body);
}

// Returns 401 for "HTTP/1.1 401 …".
int StatusOf(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") && answer.size() > 12 ? std::atoi(answer.c_str() + 9) : 0;
}

// Returns a LocateRequest of GIOP 1.0, little-endian, for an arbitrary object key (CORBA 3.0,
// 15.4.5)
std::string LocateRequest() {
  const char request[] = "GIOP\1\0\1\3\x0c\0\0\0\1\0\0\0\4\0\0\0none";
  return {request, sizeof request - 1};
}

bool TakesToken(int status) { return status == 401 || status == 403; }

const char* Name(Speaks speaks) {
  switch (speaks) {
    case Speaks::kHttp:
      return "viewer, HTTP";
    case Speaks::kHttps:
      return "viewer, HTTPS";
    case Speaks::kCorba:
      return "CORBA";
    case Speaks::kCorbaTls:
      return "CORBA, TLS";
    case Speaks::kRos2:
      return "ROS 2, UDP";
    case Speaks::kUnknown:
      return "does not respond";
  }
  return "";
}

std::string Place(const Listener& listener) {
  return listener.port == 0 ? listener.address
                            : gateway::Authority(listener.address, listener.port);
}

std::string Reach(const Listener& listener) {
  if (listener.port == 0) return "only this user";
  return listener.IsLocal() ? "only this machine" : "other machines";
}

std::string Takes(const Exposure& exposure) {
  if (exposure.takes_certificate) return "certificate of its authority";
  if (exposure.takes_keys) return "keys of its keystore";
  if (exposure.speaks != Speaks::kHttp && exposure.speaks != Speaks::kHttps) return "no token";
  if (exposure.watching_takes_token) return "token required";
  return exposure.acting_takes_token ? "token required for control, watching without token"
                                     : "no token";
}

// Returns the value of an option, which is given as "--name VALUE" or "--name=VALUE".
std::optional<std::string> Option(const ListeningProcess& process, const std::string& name) {
  const std::vector<std::string>& arguments = process.arguments;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == name && i + 1 < arguments.size()) return arguments[i + 1];
    if (arguments[i].starts_with(name + "=")) return arguments[i].substr(name.size() + 1);
  }
  return std::nullopt;
}

// Returns the folders whose files can be downloaded, according to the command line.
std::vector<std::string> FoldersServed(const ListeningProcess& process, bool has_viewer) {
  if (!has_viewer) return {};
  std::vector<std::string> folders{(ShareFolder() / "web").string()};
  const std::string recordings = Option(process, "--recordings").value_or(".");
  folders.push_back((std::filesystem::path(process.folder) / recordings).lexically_normal());
  return folders;
}

}  // namespace

Exposure Probe(const Listener& listener) {
  Exposure exposure;
  if (listener.port == 0) {
    exposure.speaks = Speaks::kCorba;
    return exposure;
  }
  // DDS authenticates participants only if it uses keys.
  if (listener.is_dds) {
    exposure.speaks = Speaks::kRos2;
    exposure.takes_keys = listener.takes_keys;
    return exposure;
  }
  const std::string look = Asking(listener, "GET", "/api/server", "");
  // This request has no effect, because it only previews a scenario. It needs the permission to
  // control, so the answer shows whether a token is required.
  const std::string act = Asking(listener, "POST", "/api/preview", "{}");
  const std::string answer = Connection(listener).Exchange(look);
  if (StatusOf(answer) == 0 && Connection(listener).Exchange(LocateRequest()).starts_with("GIOP")) {
    exposure.speaks = Speaks::kCorba;
  } else if (StatusOf(answer) == 400 && answer.find("https://") != std::string::npos) {
    exposure.speaks = Speaks::kHttps;
    const auto ask = [&](const std::string& request) {
      const Connection connection(listener);
      return StatusOf(tls::ProbeServer(connection.descriptor(), request).answer);
    };
    exposure.watching_takes_token = TakesToken(ask(look));
    exposure.acting_takes_token = TakesToken(ask(act));
  } else if (StatusOf(answer) != 0) {
    exposure.speaks = Speaks::kHttp;
    exposure.watching_takes_token = TakesToken(StatusOf(answer));
    exposure.acting_takes_token = TakesToken(StatusOf(Connection(listener).Exchange(act)));
  } else {
    const Connection connection(listener);
    const tls::ProbeResult reception = tls::ProbeServer(connection.descriptor(), LocateRequest());
    const bool is_answered = reception.answer.starts_with("GIOP");
    if (is_answered || reception.asks_for_certificate) exposure.speaks = Speaks::kCorbaTls;
    exposure.takes_certificate = !is_answered && reception.asks_for_certificate;
  }
  return exposure;
}

std::string ExposureWarning(const Listener& listener, const Exposure& exposure) {
  if (listener.IsLocal()) return {};
  switch (exposure.speaks) {
    case Speaks::kHttps:
      return exposure.acting_takes_token ? ""
                                         : "everyone who can reach this address can control the "
                                           "program; start it with --control-token";
    case Speaks::kHttp:
      return exposure.acting_takes_token ? "others in the network can read the traffic and the "
                                           "tokens; use --tls-certificate and --tls-key (`gsv "
                                           "certificates make` makes them)"
                                         : "everyone who can reach this address can control the "
                                           "program; start it with --control-token and "
                                           "--tls-certificate";
    case Speaks::kCorba:
      return "--insecure-corba lets everyone who can reach this address control the program; use a "
             "certificate (GSV_CORBA_CERTIFICATE), listen on 127.0.0.1, or use a firewall";
    case Speaks::kCorbaTls:
      return exposure.takes_certificate
                 ? ""
                 : "everyone who can reach this address can call the program";
    case Speaks::kRos2:
      return exposure.takes_keys
                 ? ""
                 : "everyone who can reach this address can read all topics, command robots "
                   "without a behaviour, and control the simulation; start the program with "
                   "--ros2-range localhost, with keys (SROS2), or use a firewall";
    case Speaks::kUnknown:
      return "the program does not respond, so its addresses are unknown; check whether it is "
             "suspended";
  }
  return {};
}

int PrintExposure(bool json) {
  int warnings = 0;
  const std::vector<ListeningProcess> processes = FindListeningProcesses();
  for (const ListeningProcess& process : processes) {
    if (!json) {
      std::printf("%d: %s\n", static_cast<int>(process.pid),
                  fmt::format("{}", fmt::join(process.arguments, " ")).c_str());
    }
    bool has_viewer = false;
    nlohmann::ordered_json sockets = nlohmann::json::array();
    for (const Listener& listener : process.listeners) {
      const Exposure exposure = Probe(listener);
      const std::string warning = ExposureWarning(listener, exposure);
      const bool is_web = exposure.speaks == Speaks::kHttp || exposure.speaks == Speaks::kHttps;
      has_viewer = has_viewer || is_web;
      if (!warning.empty()) ++warnings;
      if (!json) {
        std::printf("  %s: %s; %s; %s%s\n", Place(listener).c_str(), Name(exposure.speaks),
                    Reach(listener).c_str(), Takes(exposure).c_str(),
                    warning.empty() ? "" : ("\n    BEWARE: " + warning).c_str());
      }
      sockets.push_back(
          {{"address", Place(listener)},
           {"speaks", Name(exposure.speaks)},
           {"local", listener.IsLocal()},
           {"tls", exposure.speaks == Speaks::kHttps || exposure.speaks == Speaks::kCorbaTls},
           {"takes_certificate", exposure.takes_certificate},
           {"takes_keys", exposure.takes_keys},
           {"watching_takes_token", exposure.watching_takes_token},
           {"acting_takes_token", exposure.acting_takes_token},
           {"complaint", warning}});
    }
    const std::vector<std::string> folders = FoldersServed(process, has_viewer);
    for (const std::string& folder : folders) {
      if (!json) std::printf("  serves files of %s\n", folder.c_str());
    }
    if (json) {
      const nlohmann::ordered_json line{{"pid", process.pid},
                                        {"command", process.arguments},
                                        {"sockets", sockets},
                                        {"folders", folders}};
      std::printf("%s\n",
                  line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    }
  }
  if (!json && processes.empty())
    std::printf("no GSV program of this user listens on this machine\n");
  if (!json && warnings == 0 && !processes.empty()) std::printf("no problems found\n");
  return warnings == 0 ? kOk : kInfrastructure;
}

}  // namespace gsv::app
