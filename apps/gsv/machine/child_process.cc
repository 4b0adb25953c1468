#include "apps/gsv/machine/child_process.h"

#include <fcntl.h>
#include <linux/close_range.h>
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

struct Ends {
  // descriptors for the child's stdin, stdout and stderr; -1: stdin is /dev/null, stderr is that of
  // the parent
  int input = -1, output = -1, errors = -1;
};

// Runs in the child and never returns. During the fork, another thread may have held malloc's
// locks. So this function must not allocate memory. `arguments` and `environment` end with null.
[[noreturn]] void Execute(char* const* arguments, char* const* environment, const Ends& ends,
                          bool quiet, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  // If the parent ended before the call of prctl(), the kernel sends no signal.
  if (getppid() != parent) _exit(0);
  const int nothing = open("/dev/null", O_RDWR);
  dup2(ends.input >= 0 ? ends.input : nothing, STDIN_FILENO);
  dup2(ends.output, STDOUT_FILENO);
  if (quiet) dup2(nothing, STDERR_FILENO);
  if (ends.errors >= 0) dup2(ends.errors, STDERR_FILENO);
  // In a separate process group, the child gets no SIGINT when the user presses Ctrl-C. Only the
  // parent gets SIGINT, and ends its children in order.
  setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  // The kernel closes all other files when the new program starts. Otherwise, an inherited socket
  // of a library would keep its port in use after the end of the parent.
  close_range(STDERR_FILENO + 1, ~0u, CLOSE_RANGE_CLOEXEC);
  execve(arguments[0], arguments, environment);
  _exit(127);
}

// Returns pointers to the words, with null at the end.
std::vector<char*> PointersTo(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// A pipe. The destructor closes its two ends, except an end whose ownership was passed to a caller
// by TakeReadEnd() or TakeWriteEnd().
class Pipe {
 public:
  Pipe() = default;
  ~Pipe() {
    for (const int end : ends_) {
      if (end >= 0) close(end);
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  bool Open() { return pipe2(ends_, O_CLOEXEC) == 0; }
  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  int TakeReadEnd() { return std::exchange(ends_[0], -1); }
  int TakeWriteEnd() { return std::exchange(ends_[1], -1); }

 private:
  int ends_[2] = {-1, -1};
};

}  // namespace

base::Result<std::unique_ptr<ChildProcess>> ChildProcess::Start(std::vector<std::string> arguments,
                                                                bool quiet, Input input) {
  return Start(std::move(arguments), {quiet, input, false, {}});
}

base::Result<std::unique_ptr<ChildProcess>> ChildProcess::StartCaptured(
    std::vector<std::string> arguments, std::vector<std::string> environment) {
  return Start(std::move(arguments), {false, Input::kEmpty, true, std::move(environment)});
}

base::Result<std::unique_ptr<ChildProcess>> ChildProcess::Start(std::vector<std::string> arguments,
                                                                Streams streams) {
  const auto fail = [&](int error) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      std::string("cannot be started: ") + std::strerror(error), arguments.front());
  };
  Pipe output, input, errors;
  if (access(arguments.front().c_str(), X_OK) != 0 || !output.Open()) return fail(errno);
  if (streams.input == Input::kOpen && !input.Open()) return fail(errno);
  if (streams.captures_errors && !errors.Open()) return fail(errno);
  std::vector<char*> argv = PointersTo(arguments);
  std::vector<char*> environment = PointersTo(streams.environment);
  environment.pop_back();
  for (char** variable = environ; *variable != nullptr; ++variable)
    environment.push_back(*variable);
  environment.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) {
    Execute(argv.data(), environment.data(),
            {input.read_end(), output.write_end(), errors.write_end()}, streams.quiet, parent);
  }
  if (pid < 0) return fail(errno);
  return std::unique_ptr<ChildProcess>(
      new ChildProcess(pid, input.TakeWriteEnd(), output.TakeReadEnd(), errors.TakeReadEnd()));
}

ChildProcess::ChildProcess(pid_t pid, int input, int output, int errors)
    : pid_(pid),
      input_(input),
      output_(output),
      errors_(errors),
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
  if (errors_ >= 0) close(errors_);
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
