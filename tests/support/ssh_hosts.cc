#include "tests/support/ssh_hosts.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace gsv::testing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSshd = "/usr/sbin/sshd";
constexpr const char* kKeygen = "/usr/bin/ssh-keygen";

// The fake ssh. Usage: ssh [-X | -o VALUE]... HOST COMMAND. A host exists as long as its file,
// which lists the processes of its tasks.
constexpr const char* kStandIn = R"(#!/bin/sh
while [ "${1#-}" != "$1" ]; do
  [ "$1" = -o ] && shift
  shift
done
host=$(dirname "$0")/$1
[ -e "$host" ] || { echo "ssh: connect to host $1 port 22: Connection refused" >&2; exit 255; }
exec 3<&0
sh -c "$2" <&3 &
echo $! >>"$host"
wait $!
code=$?
[ -e "$host" ] || { echo "Connection to $1 closed by remote host." >&2; exit 255; }
exit $code
)";

int FreePort() {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  socklen_t size = sizeof address;
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address);
  getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  close(socket);
  return ntohs(address.sin_port);
}

std::string TextOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<int> Processes() {
  std::vector<int> processes;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    const int process = std::atoi(entry.path().filename().c_str());
    if (process > 0) processes.push_back(process);
  }
  return processes;
}

// Parses "PID (sshd) STATE PARENT …".
bool IsSshdBelow(int process, int parent) {
  const std::string status = TextOf("/proc/" + std::to_string(process) + "/stat");
  const std::size_t name = status.find(" (sshd) ");
  return name != std::string::npos && std::atoi(&status[name + 10]) == parent;
}

void KillConnections(int parent) {
  for (const int process : Processes()) {
    if (!IsSshdBelow(process, parent)) continue;
    KillConnections(process);
    kill(process, SIGKILL);
  }
}

}  // namespace

std::string SshHosts::Missing(Kind kind) {
  if (kind == Kind::kStandIn) return {};
  for (const char* program : {kSshd, kKeygen, "/usr/bin/ssh"}) {
    if (access(program, X_OK) != 0)
      return std::string(program) +
             " does not exist; install openssh-server, which GSV does not need";
  }
  return {};
}

SshHosts::SshHosts(Kind kind, int count) : kind_(kind), port_(FreePort()) {
  if (kind == Kind::kStandIn) {
    const fs::path program = folder_.Write("ssh", kStandIn);
    fs::permissions(program, fs::perms::owner_all);
  } else {
    if (getuid() == 0) fs::create_directories("/run/sshd");  // root's sshd requires this folder
    for (const char* key : {"host", "user"})
      RunProgram(kKeygen, {"-q", "-t", "ed25519", "-N", "", "-f", folder_.path() / key});
  }
  servers_.resize(static_cast<std::size_t>(count));
  for (int host = 0; host < count; ++host) {
    if (kind == Kind::kSshd) {
      StartSshd(host);
    } else {
      std::ofstream made(FileOf(host));
    }
  }
}

SshHosts::~SshHosts() {
  for (std::size_t host = 0; host < servers_.size(); ++host) Lose(static_cast<int>(host));
}

fs::path SshHosts::FileOf(int host) const {
  return folder_.path() / ("127.0.0." + std::to_string(host + 1));
}

void SshHosts::StartSshd(int host) {
  const std::string folder = folder_.path(), address = FileOf(host).filename();
  const std::string configuration =
      folder_.Write(address, "ListenAddress " + address + ":" + std::to_string(port_) +
                                 "\nHostKey " + folder + "/host\nAuthorizedKeysFile " + folder +
                                 "/user.pub\nStrictModes no\nUsePAM no\nPidFile none\n"
                                 "PasswordAuthentication no\n");
  auto& server = servers_[static_cast<std::size_t>(host)];
  server = std::make_unique<Running>(
      kSshd, std::vector<std::string>{"-D", "-e", "-f", configuration},
      std::vector<std::string>{"/bin/sh", "-c", "exec \"$@\" 2>&1", "sh"});
  server->AwaitLine("Server listening on");
}

std::string SshHosts::Keys() const {
  const std::string folder = folder_.path();
  if (kind_ == Kind::kStandIn) return "program: " + folder + "/ssh";
  return "options: [-F, none, -p, '" + std::to_string(port_) + "', -i, " + folder +
         "/user, -o, IdentitiesOnly=yes, -o, StrictHostKeyChecking=no, -o, UserKnownHostsFile=" +
         folder + "/known, -o, LogLevel=ERROR]";
}

void SshHosts::Lose(int host) {
  if (kind_ == Kind::kStandIn) {
    std::ifstream tasks(FileOf(host));
    fs::remove(FileOf(host));
    for (int task; tasks >> task;) kill(task, SIGKILL);
    return;
  }
  auto& server = servers_[static_cast<std::size_t>(host)];
  if (server == nullptr) return;
  // The server is stopped first, so that it starts no connection that KillConnections() would miss.
  server->process().Signal(SIGSTOP);
  KillConnections(server->process().pid());
  server->process().Signal(SIGKILL);
  server.reset();
}

std::vector<int> ProcessesWith(const std::string& text) {
  std::vector<int> found;
  for (const int process : Processes()) {
    std::string line = TextOf("/proc/" + std::to_string(process) + "/cmdline");
    std::replace(line.begin(), line.end(), '\0', ' ');
    if (line.find(text) != std::string::npos) found.push_back(process);
  }
  return found;
}

}  // namespace gsv::testing
