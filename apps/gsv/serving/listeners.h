// Finds this user's running programs gsv and gsv-NAME that are in the folder of this program, and
// the addresses on which they listen, in /proc (proc(5)).
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
  bool takes_keys = false;  // whether its process enforces DDS Security

  bool IsLocal() const;  // Whether only programs on this machine can connect to the socket.
};

// A running program of GSV, and its sockets.
struct ListeningProcess {
  pid_t pid = 0;
  std::vector<std::string> arguments;  // the arguments of the program, without tokens
  std::string folder;                  // its working directory
  std::vector<Listener> listeners;
};

// Returns the processes that have sockets, ordered by pid. This process, processes of other users,
// and processes that end during the search are not found.
std::vector<ListeningProcess> FindListeningProcesses();

// Parses a table in the format of /proc/net/tcp and tcp6. Returns the listening sockets, each with
// its inode.
std::vector<std::pair<std::uint64_t, Listener>> ParseSocketTable(std::string_view table);
// Parses a table in the format of /proc/net/udp. Returns the sockets at the ports of a DDS domain,
// each with its inode.
std::vector<std::pair<std::uint64_t, Listener>> ParseDdsSockets(std::string_view table,
                                                                std::uint32_t domain);

}  // namespace gsv::app
