// Runs GSV's real programs for tests.
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

// Wall time after which a program that should have answered has hung.
inline constexpr std::chrono::seconds kProgramTimeout{90 * base::kSlowdown};

std::filesystem::path Program(const std::string& name);   // in the build's bin, or a whole path
std::filesystem::path RealFile(const std::string& path);  // of GSV_REAL_DIR; may not be there

struct Outcome {
  std::string ending;  // "exit code 0"
  std::string out, err;

  nlohmann::json LastLine() const;  // of stdout, as JSON
};

// A program in the background, its stderr kept in a file.
class Running {
 public:
  // `wrapper`: a command line that ends in becoming the program, as nice, taskset and env do.
  Running(const std::string& program, std::vector<std::string> arguments,
          const std::vector<std::string>& wrapper = {});
  // The first line on stdout that contains `text`, which is waited for.
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

// The body of the answer from a server on this machine; empty when there is none.
std::string HttpGet(const std::string& url);

// A broker, on loopback unless told otherwise.
class BrokerProcess {
 public:
  explicit BrokerProcess(const std::string& address = "127.0.0.1");
  const std::string& reference() const { return reference_; }

 private:
  Running process_;
  std::string reference_;
};

}  // namespace gsv::testing
