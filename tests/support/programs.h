// For tests: runs the real programs of GSV.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/gsv/machine/child_process.h"
#include "gsv/base/sanitizer.h"
#include "gsv/base/test_folder.h"

namespace gsv::testing {

// Wall-clock time limit for an answer of a program. A program that exceeds it counts as hung.
inline constexpr std::chrono::seconds kProgramTimeout{90 * base::kSlowdown};

// `name` is that of a program in the build's bin folder, or a path.
std::filesystem::path Program(const std::string& name);
// A path below GSV_REAL_DIR. The file may be missing.
std::filesystem::path RealFile(const std::string& path);

// The output of a program that has ended, and how it ended.
struct Outcome {
  std::string ending;  // such as "exit code 0" or "signal 9"
  std::string out, err;

  nlohmann::json LastLine() const;  // The last line of stdout, as JSON.
};

// A program in the background. Its stderr goes to a file.
class Running {
 public:
  // `wrapper` is a command line that executes the program as its last action, as nice, taskset and
  // env do.
  Running(const std::string& program, std::vector<std::string> arguments,
          const std::vector<std::string>& wrapper = {});
  // Waits for the first line on stdout that contains `text`, and returns it.
  std::string AwaitLine(const std::string& text);
  Outcome AwaitEnd();
  app::ChildProcess& process() { return *process_; }
  std::string errors() const;

 private:
  base::testing::TestFolder folder_;
  std::unique_ptr<app::ChildProcess> process_;
  std::string out_;
};

Outcome RunProgram(const std::string& program, std::vector<std::string> arguments);

// Returns the body of the answer of a server on this machine, or an empty text if there is none.
std::string HttpGet(const std::string& url);

// A broker process. By default it listens on loopback.
class BrokerProcess {
 public:
  explicit BrokerProcess(const std::string& address = "127.0.0.1");
  const std::string& reference() const { return reference_; }

 private:
  Running process_;
  std::string reference_;
};

}  // namespace gsv::testing
