// For tests: hosts that ssh reaches as the present user of this machine. They are real sshds that
// the test starts, or a program that replaces ssh. The destructor removes everything.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/programs.h"

namespace gsv::testing {

// Hosts that tests reach by ssh.
class SshHosts {
 public:
  enum class Kind { kSshd, kStandIn };

  // The reason why this machine cannot have hosts of this kind; empty if it can.
  static std::string Missing(Kind kind);

  // Returns when all hosts listen, on 127.0.0.1, 127.0.0.2 and so on.
  SshHosts(Kind kind, int count);
  ~SshHosts();
  SshHosts(const SshHosts&) = delete;
  SshHosts& operator=(const SshHosts&) = delete;

  // The keys of the mapping `ssh` in a campaign's file, with which it reaches these hosts.
  std::string Keys() const;
  // Kills the host's server and its connections (SIGKILL).
  void Lose(int host);

 private:
  void StartSshd(int host);
  std::filesystem::path FileOf(int host) const;

  const Kind kind_;
  const base::testing::TestFolder folder_{};
  const int port_;
  std::vector<std::unique_ptr<Running>> servers_;  // null for a host that is lost or does not exist
};

// Returns the processes of this machine whose command line contains `text`.
std::vector<int> ProcessesWith(const std::string& text);

}  // namespace gsv::testing
