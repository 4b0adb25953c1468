// A broker in a child process, for tests that go over TCP.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

namespace gsv::broker {

class BrokerProcess {
 public:
  // Returns when it serves, or has ended.
  explicit BrokerProcess(std::vector<std::string> arguments = {"0"});
  // Ends it.
  ~BrokerProcess();
  BrokerProcess(const BrokerProcess&) = delete;
  BrokerProcess& operator=(const BrokerProcess&) = delete;

  // "corbaloc::1.2@127.0.0.1:…/TradingService"; empty when it ended without one.
  const std::string& reference() const { return reference_; }
  std::string port() const;
  pid_t pid() const { return pid_; }

  void Send(int signal);
  // SIGSTOP; returns when it stands still.
  void Stop();
  // Waits for the end; the exit code, or minus the signal that ended it.
  int Wait();
  // All that it wrote on stderr; call it after Wait().
  std::string Complaint();

 private:
  std::string reference_;
  pid_t pid_ = 0;
  int complaint_ = -1;
};

}  // namespace gsv::broker
