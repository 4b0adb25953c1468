// Hosts that ssh reaches, as the present user of this machine: behind real sshds of the test's own,
// or behind a program that stands in for ssh. Nothing of them outlives the object.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/programs.h"

namespace gsv::testing {

class SshHosts {
 public:
  enum class Kind { kSshd, kStandIn };

  // Why there can be none of this kind here; empty: there can.
  static std::string Missing(Kind kind);

  // Returns once all of them listen, on 127.0.0.1, 127.0.0.2 and so on.
  SshHosts(Kind kind, int count);
  ~SshHosts();
  SshHosts(const SshHosts&) = delete;
  SshHosts& operator=(const SshHosts&) = delete;

  // What a campaign's file says so that it reaches them: keys of its mapping `ssh`.
  std::string Keys() const;
  // kill -9 of what listens on the host, and of its connections.
  void Lose(int host);

 private:
  void StartSshd(int host);
  std::filesystem::path FileOf(int host) const;

  const Kind kind_;
  const base::testing::TestFolder folder_{};
  const int port_;
  std::vector<std::unique_ptr<Running>> servers_;  // null: lost, or there is none
};

// Processes of this machine whose command line contains `text`.
std::vector<int> ProcessesWith(const std::string& text);

}  // namespace gsv::testing
