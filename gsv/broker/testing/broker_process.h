// For tests over TCP: a broker, or the service of an offer, in a child process.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace gsv::broker {

// A child process that a test starts. Stores the first line that the process prints. The destructor
// kills the process.
class TestProcess {
 public:
  // Starts `program`, which is in the folder of the tests. Returns when the process has printed a
  // line, or has ended.
  TestProcess(const std::string& program, std::vector<std::string> arguments);
  // Sends SIGKILL, unless Wait() was called.
  ~TestProcess();
  TestProcess(const TestProcess&) = delete;
  TestProcess& operator=(const TestProcess&) = delete;

  // The first line on stdout; empty if the process ended without one.
  const std::string& first_line() const { return first_line_; }
  pid_t pid() const { return pid_; }

  // Sends a signal to the process.
  void Send(int signal);
  // Sends SIGSTOP. Returns when the process has stopped.
  void Stop();
  // Waits for the end of the process. Returns the exit code, or minus the number of the signal that
  // ended the process.
  int Wait();
  // Returns everything that the process wrote on stderr. Call it after Wait().
  std::string Stderr();

 private:
  std::string first_line_;
  pid_t pid_ = 0;
  int stderr_ = -1;  // descriptor of the pipe from which stderr is read
};

class BrokerProcess : public TestProcess {
 public:
  // Returns when the broker serves, or has ended.
  explicit BrokerProcess(std::vector<std::string> arguments = {"0"})
      : TestProcess("gsv_broker_test_server", std::move(arguments)) {}

  // For example "corbaloc::1.2@127.0.0.1:…/TradingService"; empty if the process ended before it
  // printed its reference.
  const std::string& reference() const { return first_line(); }
  std::string port() const;
};

// A process that exports itself as a "Service" to a broker.
class ServiceProcess : public TestProcess {
 public:
  explicit ServiceProcess(const std::string& broker)
      : TestProcess("gsv_broker_test_service", {broker}) {}

  const std::string& offer_id() const { return first_line(); }
};

}  // namespace gsv::broker
