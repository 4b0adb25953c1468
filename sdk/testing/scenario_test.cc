#include "sdk/testing/scenario_test.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <vector>

namespace gsv::testing {
namespace {

std::string GsvProgram() {
  const char* program = std::getenv("GSV_PROGRAM");
  return program != nullptr ? program : "gsv";
}

// A program that ends with this process. Its stdout can be read, and with `with_errors` its stderr
// as well.
class Program {
 public:
  Program(std::vector<std::string> arguments, bool with_errors) {
    int ends[2];
    if (pipe(ends) != 0) return;
    std::vector<char*> argv;
    argv.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    std::vector<char*> environment;
    for (char** entry = environ; *entry != nullptr; ++entry) {
      if (!std::string_view(*entry).starts_with("GSV_BROKER=")) environment.push_back(*entry);
    }
    environment.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      dup2(ends[1], STDOUT_FILENO);
      if (with_errors) dup2(ends[1], STDERR_FILENO);
      close(ends[0]);
      close(ends[1]);
      execvpe(argv[0], argv.data(), environment.data());
      _exit(127);
    }
    close(ends[1]);
    output_ = fdopen(ends[0], "r");
  }
  ~Program() {
    if (process_ > 0) kill(process_, SIGTERM);
    (void)AwaitEnd();
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // Returns the next line, or an empty text at the end.
  std::string ReadLine() {
    char* line = nullptr;
    std::size_t size = 0;
    const ssize_t length = output_ == nullptr ? -1 : getline(&line, &size, output_);
    std::string text = length > 0 ? std::string(line, static_cast<std::size_t>(length)) : "";
    free(line);
    return text;
  }
  // Returns the exit code, or -1 if the program did not end by itself.
  int AwaitEnd() {
    int status = 0;
    if (process_ > 0 && waitpid(process_, &status, 0) == process_) process_ = 0;
    if (output_ != nullptr) fclose(std::exchange(output_, nullptr));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t process_ = 0;
  std::FILE* output_ = nullptr;
};

struct Simulator {
  Simulator() : program({GsvProgram(), "serve", "--headless"}, false) {
    constexpr std::string_view kMark = "broker: ";
    for (std::string line = program.ReadLine(); !line.empty(); line = program.ReadLine()) {
      if (!line.starts_with(kMark)) continue;
      broker = line.substr(kMark.size(), line.find('\n') - kMark.size());
      break;
    }
    if (broker.empty()) {
      failure = GsvProgram() + " serve did not start; GSV_PROGRAM names the program";
      return;
    }
    auto connected = Application::Connect(broker);
    if (connected) {
      application = *std::move(connected);
    } else {
      failure = connected.error().Sentence();
    }
  }

  Program program;
  std::string broker, failure;
  std::unique_ptr<Application> application;
};

Simulator& TheSimulator() {
  static Simulator simulator;
  return simulator;
}

}  // namespace

void ExpectPasses(const std::string& scenario, const std::vector<std::string>& options) {
  std::vector<std::string> arguments{GsvProgram(), "test", scenario};
  arguments.insert(arguments.end(), options.begin(), options.end());
  Program program(std::move(arguments), true);
  std::string said;
  for (std::string line = program.ReadLine(); !line.empty(); line = program.ReadLine()) {
    said += line;
  }
  EXPECT_EQ(program.AwaitEnd(), 0) << said;
}

void SimulatorTest::SetUp() {
  ASSERT_NE(TheSimulator().application, nullptr) << TheSimulator().failure;
}

Application& SimulatorTest::simulator() { return *TheSimulator().application; }

const std::string& SimulatorTest::broker() { return TheSimulator().broker; }

}  // namespace gsv::testing
