// Finds the running programs of GSV of this user, and the addresses on which they listen, in /proc
// (proc(5)).
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gsv::app {

// A socket on which a program listens.
struct Listener {
  // such as "127.0.0.1", "0.0.0.0" or "::"; or the path of a Unix domain socket
  std::string address;
  std::uint16_t port = 0;   // 0 for a Unix domain socket
  bool is_dds = false;      // whether it is a UDP socket of ROS 2
  bool takes_keys = false;  // whether its process uses DDS Security

  bool IsLocal() const;  // Whether only programs on this machine can connect to the socket.
};

// A running program of GSV, and its sockets.
struct ListeningProcess {
  pid_t pid = 0;
  std::vector<std::string> arguments;  // the arguments of the program, without tokens
  std::string folder;                  // its working directory
  std::vector<Listener> listeners;
};

// Returns the processes by pid. Processes of other users, and processes that end during the search,
// are not found.
std::vector<ListeningProcess> FindListeningProcesses();

// Returns the listening sockets in a table of the form of /proc/net/tcp and tcp6, by inode.
std::vector<std::pair<std::uint64_t, Listener>> ParseSocketTable(std::string_view table);
// Returns the sockets at the ports of a DDS domain in a table of the form of /proc/net/udp, by
// inode.
std::vector<std::pair<std::uint64_t, Listener>> ParseDdsSockets(std::string_view table,
                                                                std::uint32_t domain);

}  // namespace gsv::app
