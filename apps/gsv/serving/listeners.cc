#include "apps/gsv/serving/listeners.h"

#include <arpa/inet.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "apps/gsv/machine/installation.h"
#include "apps/gsv/simulations/recordings.h"
#include "gsv/base/sorting.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;
using SocketsByInode = std::map<std::uint64_t, Listener>;

// The first port of DDS, and the number of ports per domain (RTPS 2.3, 9.6.1.1).
constexpr std::uint32_t kFirstDdsPort = 7400, kPortsOfDomain = 250;

std::string ReadWhole(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Converts a text such as "0100007F", which has 32-bit words of the address in this machine's byte
// order.
std::string AddressText(std::string_view hex) {
  std::array<std::uint32_t, 4> words{};
  const std::size_t count = hex.size() / 8;
  if (hex.size() % 8 != 0 || (count != 1 && count != 4)) return {};
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view word = hex.substr(8 * i, 8);
    std::from_chars(word.data(), word.data() + word.size(), words[i], 16);
  }
  std::array<char, INET6_ADDRSTRLEN> text{};
  inet_ntop(count == 1 ? AF_INET : AF_INET6, words.data(), text.data(), text.size());
  return text.data();
}

// Adds the listening Unix domain sockets in a table in the format of /proc/net/unix.
void AddUnixSockets(std::string_view table, SocketsByInode& sockets) {
  constexpr std::string_view kAcceptsConnections = "00010000";
  std::istringstream lines{std::string(table)};
  std::string line;
  std::getline(lines, line);  // skips the heading
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string address, references, protocol, flags, type, state, path;
    std::uint64_t inode = 0;
    fields >> address >> references >> protocol >> flags >> type >> state >> inode >> path;
    if (flags == kAcceptsConnections && !path.empty()) sockets[inode] = {path, 0};
  }
}

// Returns the value of a variable at the start of a process, or an empty text.
std::string VariableOf(const fs::path& process, const std::string& name) {
  std::istringstream environment(ReadWhole(process / "environ"));
  for (std::string entry; std::getline(environment, entry, '\0');) {
    if (entry.starts_with(name + "=")) return entry.substr(name.size() + 1);
  }
  return {};
}

std::vector<std::pair<std::uint64_t, Listener>> DdsSocketsOf(const fs::path& process) {
  const std::string text = VariableOf(process, "ROS_DOMAIN_ID");
  std::uint32_t domain = 0;
  std::from_chars(text.data(), text.data() + text.size(), domain);
  auto sockets = ParseDdsSockets(ReadWhole(process / "net" / "udp"), domain);
  const bool takes_keys = VariableOf(process, "ROS_SECURITY_ENABLE") == "true" &&
                          VariableOf(process, "ROS_SECURITY_STRATEGY") == "Enforce";
  for (auto& [inode, listener] : sockets) listener.takes_keys = takes_keys;
  return sockets;
}

SocketsByInode SocketsOf(const fs::path& process) {
  SocketsByInode sockets;
  for (const char* table : {"tcp", "tcp6"}) {
    for (auto& [inode, listener] : ParseSocketTable(ReadWhole(process / "net" / table))) {
      sockets[inode] = std::move(listener);
    }
  }
  for (auto& [inode, listener] : DdsSocketsOf(process)) {
    sockets[inode] = std::move(listener);
  }
  AddUnixSockets(ReadWhole(process / "net" / "unix"), sockets);
  return sockets;
}

std::vector<Listener> ListenersOf(const fs::path& process) {
  constexpr std::string_view kSocket = "socket:[";
  const SocketsByInode sockets = SocketsOf(process);
  std::vector<Listener> listeners;
  std::error_code error;
  for (fs::directory_iterator each(process / "fd", error), end; !error && each != end;
       each.increment(error)) {
    std::error_code gone;
    const std::string link = fs::read_symlink(each->path(), gone);
    if (!link.starts_with(kSocket)) continue;
    const auto found = sockets.find(std::strtoull(link.c_str() + kSocket.size(), nullptr, 10));
    if (found != sockets.end()) listeners.push_back(found->second);
  }
  return listeners;
}

// Returns the sockets in a table of TCP or UDP whose state is `wanted`, each with its inode.
std::vector<std::pair<std::uint64_t, Listener>> ParseInternetTable(std::string_view table,
                                                                   std::string_view wanted) {
  std::vector<std::pair<std::uint64_t, Listener>> sockets;
  std::istringstream lines{std::string(table)};
  std::string line;
  std::getline(lines, line);  // skips the heading
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string number, local, remote, state, queues, timer, retransmits, uid, timeout;
    std::uint64_t inode = 0;
    fields >> number >> local >> remote >> state >> queues >> timer >> retransmits >> uid >>
        timeout >> inode;
    const std::size_t colon = local.find(':');
    if (!fields || state != wanted || colon == std::string::npos) continue;
    Listener listener;
    listener.address = AddressText(std::string_view(local).substr(0, colon));
    std::from_chars(local.data() + colon + 1, local.data() + local.size(), listener.port, 16);
    if (!listener.address.empty()) sockets.emplace_back(inode, std::move(listener));
  }
  return sockets;
}

bool IsProgramOfOurs(const fs::path& program) {
  const std::string name = program.filename();
  return program.parent_path() == fs::path(ProgramPath()).parent_path() &&
         (name == "gsv" || name.starts_with("gsv-"));
}

}  // namespace

bool Listener::IsLocal() const {
  return port == 0 || address.starts_with("127.") || address == "::1" ||
         address.starts_with("::ffff:127.");
}

std::vector<std::pair<std::uint64_t, Listener>> ParseSocketTable(std::string_view table) {
  return ParseInternetTable(table, "0A");  // 0A is the state of a listening socket
}

std::vector<std::pair<std::uint64_t, Listener>> ParseDdsSockets(std::string_view table,
                                                                std::uint32_t domain) {
  // 07 is the state of a socket that is not connected
  auto sockets = ParseInternetTable(table, "07");
  const std::uint32_t first = kFirstDdsPort + kPortsOfDomain * domain;
  std::erase_if(sockets, [first](const auto& socket) {
    return socket.second.port < first || socket.second.port >= first + kPortsOfDomain;
  });
  for (auto& [inode, listener] : sockets) listener.is_dds = true;
  return sockets;
}

std::vector<ListeningProcess> FindListeningProcesses() {
  std::vector<ListeningProcess> processes;
  std::error_code error;
  for (fs::directory_iterator each("/proc", error), end; !error && each != end;
       each.increment(error)) {
    const std::string name = each->path().filename();
    ListeningProcess process;
    const auto [last, wrong] = std::from_chars(name.data(), name.data() + name.size(), process.pid);
    if (wrong != std::errc() || last != name.data() + name.size()) continue;
    if (process.pid == getpid()) continue;
    std::error_code denied;
    const fs::path program = fs::read_symlink(each->path() / "exe", denied);
    if (denied || !IsProgramOfOurs(program)) continue;
    process.listeners = ListenersOf(each->path());
    if (process.listeners.empty()) continue;
    std::istringstream arguments(ReadWhole(each->path() / "cmdline"));
    for (std::string argument; std::getline(arguments, argument, '\0');) {
      process.arguments.push_back(argument);
    }
    process.arguments = WithoutSecrets(std::move(process.arguments));
    process.folder = fs::read_symlink(each->path() / "cwd", denied);
    processes.push_back(std::move(process));
  }
  base::Sort(processes, [](const auto& a, const auto& b) { return a.pid < b.pid; });
  return processes;
}

}  // namespace gsv::app
