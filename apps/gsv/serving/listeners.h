// Which programs of GSV run on this machine as this user, and where they listen: as the kernel
// knows it (/proc, proc(5)), whatever their options said.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gsv::app {

struct Listener {
  std::string address;     // "127.0.0.1", "0.0.0.0", "::"; of a socket of the file system its path
  std::uint16_t port = 0;  // 0: a socket of the file system
  bool is_dds = false;     // a UDP socket of ROS 2

  bool IsLocal() const;  // only this machine can reach it
};

struct ListeningProcess {
  pid_t pid = 0;
  std::vector<std::string> arguments;  // without tokens
  std::string folder;                  // in which it was started
  std::vector<Listener> listeners;
};

// By pid. Others' processes are not seen, nor those that end meanwhile.
std::vector<ListeningProcess> FindListeningProcesses();

// The listening sockets of a table as /proc/net/tcp and tcp6 have it, by inode.
std::vector<std::pair<std::uint64_t, Listener>> ParseSocketTable(std::string_view table);
// The sockets at ports of DDS that a table as /proc/net/udp has, by inode. Those of domains above 101 lie
// among the ports that the kernel gives to anybody, and are left out.
std::vector<std::pair<std::uint64_t, Listener>> ParseDdsSockets(std::string_view table);

}  // namespace gsv::app
