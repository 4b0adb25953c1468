#include "apps/gsv/running/run_server.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/process/program_end.h"
#include "apps/gsv/running/prepared_files.h"
#include "apps/gsv/running/run.h"
#include "apps/gsv/running/run_options.h"

namespace gsv::app {
namespace {

using base::ErrorCode;
using base::Result;

constexpr std::size_t kMaxRequest = 1 << 20;  // in bytes
// Time limit for a run to end in order after SIGTERM. It is shorter than the timeout of
// ~ChildProcess().
constexpr std::chrono::milliseconds kEndTimeout{1500};

struct RunRequest {
  std::vector<std::string> arguments;
  std::string output, errors;  // paths of files
};

Result<RunRequest> ParseRequest(const std::string& line) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  try {
    return RunRequest{json.at("arguments").get<std::vector<std::string>>(),
                      json.at("stdout").get<std::string>(), json.at("stderr").get<std::string>()};
  } catch (const nlohmann::json::exception& error) {
    return base::Fail(ErrorCode::kInvalidArgument, error.what(), "the request for a run");
  }
}

Result<RunOptions> OptionsOf(const RunRequest& request) {
  RunArguments arguments;
  CLI::App app("", "gsv run");
  AddRunOptions(app, arguments);
  TakeOneValuePerOption(app);
  try {
    app.parse(std::vector<std::string>(request.arguments.rbegin(), request.arguments.rend()));
  } catch (const CLI::ParseError& error) {
    return base::Fail(ErrorCode::kInvalidArgument, error.what(), "gsv run");
  }
  return ParseArguments(arguments);
}

// Returns whether a run needs a broker. It needs none if its behaviours run in this process, or if
// its robots have no behaviours. Other programs need not find the run through a broker, because it
// is a child process of `gsv test` or of a campaign.
bool NeedsBroker(const RunOptions& options) {
  if (!options.edits.empty() || options.runtime.viewer) return true;
  const bool has_option = !options.behaviour.empty() || !options.behaviour_of.empty();
  if (has_option && !options.in_process) return true;
  return std::any_of(options.scenario.robots.begin(), options.scenario.robots.end(),
                     [&](const scenario::RobotEntry& robot) {
                       return !robot.behaviour_constraint.empty() ||
                              (!robot.behaviour.empty() && !options.in_process);
                     });
}

bool HasOneThread() {
  std::size_t threads = 0;
  std::error_code ignored;
  for (const auto& each : std::filesystem::directory_iterator("/proc/self/task", ignored)) {
    (void)each;
    ++threads;
  }
  return threads == 1;
}

bool Redirect(const std::string& file, int descriptor) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  return opened >= 0 && dup2(opened, descriptor) >= 0;
}

// Makes `ps` show this process with these arguments. The kernel shows the memory in which the
// program's arguments are, and zeros fill the unused part of this memory. trials/prepared_runs.cc
// makes this memory long enough for most command lines.
void ShowAs(const std::vector<std::string>& arguments) {
  std::ifstream file("/proc/self/stat");
  std::string stat((std::istreambuf_iterator<char>(file)), {});
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string::npos) return;
  std::istringstream fields(stat.substr(name_end + 1));
  // The number of the field arg_start; proc(5) counts fields from 1. The third field follows the
  // name.
  constexpr int kArgStart = 48;
  std::string skipped;
  for (int i = 3; i < kArgStart; ++i) fields >> skipped;
  std::uintptr_t start = 0, end = 0;
  if (!(fields >> start >> end) || start == 0 || end <= start) return;
  std::string text;
  for (const std::string& argument : arguments) text += argument + '\0';
  text.resize(end - start - 1);
  std::memcpy(reinterpret_cast<char*>(start), text.c_str(), end - start);
}

std::vector<std::string> CommandLineOf(const RunRequest& request) {
  std::vector<std::string> arguments{ProgramPath().string(), "run"};
  arguments.insert(arguments.end(), request.arguments.begin(), request.arguments.end());
  return arguments;
}

// Starts the program again for the run (execv), because the run server had several threads at the
// fork. Only the calling thread survives fork(), and locks that other threads hold stay locked. GSV
// itself starts no threads before a run, but a plug-in may.
[[noreturn]] void ExecuteRun(const RunRequest& request) {
  std::vector<std::string> arguments = CommandLineOf(request);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  execv(argv.front(), argv.data());
  _exit(kInfrastructure);
}

[[noreturn]] void RunInChild(const RunRequest& request, const Result<RunOptions>& options,
                             Signals& signals, pid_t parent, bool is_forked_whole) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(kInterrupted);
  setpgid(0, 0);
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0 || !Redirect(request.output, STDOUT_FILENO) ||
      !Redirect(request.errors, STDERR_FILENO)) {
    _exit(kInfrastructure);
  }
  if (!is_forked_whole) ExecuteRun(request);
  ShowAs(CommandLineOf(request));
  int exit_code = kOk;
  if (options) {
    const auto result = Run(*options, signals);
    exit_code = result ? *result : PrintError(result.error());
  } else {
    exit_code = PrintError(options.error());
  }
  exit_code = EndProgram(exit_code);
  std::fflush(nullptr);
  // Ends without static destructors. They would write to memory that this process shares with the
  // run server, so the kernel would have to copy it.
  std::_Exit(exit_code);
}

class RunServer {
 public:
  explicit RunServer(Signals& signals) : signals_(signals) {
    sigset_t ends;
    sigemptyset(&ends);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ends, signal);
    ends_ = signalfd(-1, &ends, SFD_CLOEXEC | SFD_NONBLOCK);
  }
  ~RunServer() { close(ends_); }
  RunServer(const RunServer&) = delete;
  RunServer& operator=(const RunServer&) = delete;

  int Serve() {
    while (const auto line = NextLine()) {
      const auto request = ParseRequest(*line);
      if (!request) return PrintError(request.error());
      const auto ending = Serve(*request);
      if (!ending) return kInterrupted;
      const std::string answer = *ending + "\n";
      if (write(STDOUT_FILENO, answer.data(), answer.size()) < 0) return kInfrastructure;
    }
    return kOk;
  }

 private:
  // Returns the next line of stdin. Returns nullopt if stdin has ended, or after a signal.
  std::optional<std::string> NextLine() {
    for (;;) {
      if (const std::size_t end = buffer_.find('\n'); end != std::string::npos) {
        std::string line = buffer_.substr(0, end);
        buffer_.erase(0, end + 1);
        return line;
      }
      std::array<pollfd, 2> events{{{STDIN_FILENO, POLLIN, 0}, {ends_, POLLIN, 0}}};
      if (poll(events.data(), events.size(), -1) < 0 && errno != EINTR) return std::nullopt;
      if (events[1].revents != 0) return std::nullopt;
      std::array<char, 4096> bytes;
      const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
      if (count <= 0 || buffer_.size() > kMaxRequest) return std::nullopt;
      buffer_.append(bytes.data(), static_cast<std::size_t>(count));
    }
  }

  // Executes one run. Returns how it ended, or nullopt if this process must end.
  std::optional<std::string> Serve(const RunRequest& request) {
    auto options = OptionsOf(request);
    if (options) {
      files_.Provide(*options);
      options->runtime.has_broker = NeedsBroker(*options);
    }
    const bool is_forked_whole = HasOneThread();
    const pid_t parent = getpid();
    const pid_t run = fork();
    if (run < 0) return std::nullopt;
    if (run == 0) RunInChild(request, options, signals_, parent, is_forked_whole);
    const int run_ends = static_cast<int>(syscall(SYS_pidfd_open, run, 0));
    std::array<pollfd, 2> events{{{run_ends, POLLIN, 0}, {ends_, POLLIN, 0}}};
    while (poll(events.data(), events.size(), -1) < 0 && errno == EINTR) {
    }
    const bool is_to_end = events[0].revents == 0;
    if (is_to_end) {
      kill(run, SIGTERM);
      events[0].revents = 0;
      if (poll(events.data(), 1, static_cast<int>(kEndTimeout.count())) <= 0) kill(run, SIGKILL);
    }
    close(run_ends);
    int status = 0;
    while (waitpid(run, &status, 0) < 0 && errno == EINTR) {
    }
    if (is_to_end) return std::nullopt;
    return WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                               : "exit code " + std::to_string(WEXITSTATUS(status));
  }

  Signals& signals_;
  int ends_ = -1;
  PreparedFiles files_;
  std::string buffer_;
};

}  // namespace

int ServeRuns(Signals& signals) {
  unsetenv("GSV_BROKER");  // because each run has its own broker
  ShowAs({ProgramPath().string(), "run-server"});
  return RunServer(signals).Serve();
}

}  // namespace gsv::app
