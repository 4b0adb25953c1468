#include "apps/gsv/machine/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace gsv::app {
namespace {

constexpr std::size_t kMaxLine = 64 * 1024;

// Runs in the child and never returns. Another thread may have held malloc's locks during the fork,
// so this does not allocate. `arguments` ends with null. `input` is -1 for none.
[[noreturn]] void Execute(char* const* arguments, int input, int output, bool quiet, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(0);  // the parent ended before the call of prctl()
  const int nothing = open("/dev/null", O_RDWR);
  dup2(input >= 0 ? input : nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  if (quiet) dup2(nothing, STDERR_FILENO);
  // In a process group of its own, the child does not get Ctrl-C of the terminal. The parent gets
  // it and ends its children in order.
  setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execv(arguments[0], arguments);
  _exit(127);
}

}  // namespace

base::Result<std::unique_ptr<ChildProcess>> ChildProcess::Start(std::vector<std::string> arguments,
                                                                bool quiet, Input input) {
  const auto fail = [&](int error) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      std::string("cannot be started: ") + std::strerror(error), arguments.front());
  };
  int output_ends[2], input_ends[2] = {-1, -1};
  if (access(arguments.front().c_str(), X_OK) != 0 || pipe2(output_ends, O_CLOEXEC) != 0)
    return fail(errno);
  if (input == Input::kOpen && pipe2(input_ends, O_CLOEXEC) != 0) {
    const int error = errno;
    for (const int end : output_ends) close(end);
    return fail(error);
  }
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) Execute(argv.data(), input_ends[0], output_ends[1], quiet, parent);
  const int fork_error = errno;
  close(output_ends[1]);
  if (input_ends[0] >= 0) close(input_ends[0]);
  if (pid < 0) {
    close(output_ends[0]);
    if (input_ends[1] >= 0) close(input_ends[1]);
    return fail(fork_error);
  }
  return std::unique_ptr<ChildProcess>(new ChildProcess(pid, input_ends[1], output_ends[0]));
}

ChildProcess::ChildProcess(pid_t pid, int input, int output)
    : pid_(pid),
      input_(input),
      output_(output),
      pid_descriptor_(static_cast<int>(syscall(SYS_pidfd_open, pid, 0))) {}

ChildProcess::~ChildProcess() {
  if (Ending().empty()) {
    Signal(SIGTERM);
    if (AwaitEnd(std::chrono::seconds(2)).empty()) {
      Signal(SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  if (input_ >= 0) close(input_);
  close(output_);
  close(pid_descriptor_);
}

void ChildProcess::Signal(int signal) {
  if (Ending().empty()) kill(pid_, signal);
}

std::string ChildProcess::AwaitEnd(std::chrono::milliseconds timeout) {
  if (!Ending().empty()) return Ending();
  pollfd ended{pid_descriptor_, POLLIN, 0};
  poll(&ended, 1, static_cast<int>(timeout.count()));
  return Ending();
}

base::Status ChildProcess::Write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = write(input_, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      return base::Fail(base::ErrorCode::kUnavailable,
                        std::string("cannot be written to: ") + std::strerror(errno),
                        "the process " + std::to_string(pid_));
    }
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

std::optional<std::string> ChildProcess::ReadLine(std::chrono::milliseconds timeout) {
  const auto give_up = std::chrono::steady_clock::now() + timeout;
  for (;;) {
    if (const std::size_t end = buffer_.find('\n'); end != std::string::npos) {
      std::string line = buffer_.substr(0, end);
      buffer_.erase(0, end + 1);
      return line;
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        give_up - std::chrono::steady_clock::now());
    pollfd readable{output_, POLLIN, 0};
    if (left.count() <= 0 || buffer_.size() > kMaxLine ||
        poll(&readable, 1, static_cast<int>(left.count())) <= 0) {
      return std::nullopt;
    }
    char bytes[4096];
    const ssize_t count = read(output_, bytes, sizeof bytes);
    if (count <= 0) return std::nullopt;
    buffer_.append(bytes, static_cast<std::size_t>(count));
  }
}

std::string ChildProcess::Ending() {
  int status = 0;
  if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
  if (!status_) return {};
  return WIFSIGNALED(*status_) ? "signal " + std::to_string(WTERMSIG(*status_))
                               : "exit code " + std::to_string(WEXITSTATUS(*status_));
}

}  // namespace gsv::app
