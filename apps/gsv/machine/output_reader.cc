#include "apps/gsv/machine/output_reader.h"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <iterator>
#include <utility>

#include "apps/gsv/machine/child_process.h"

namespace gsv::app {
namespace {

constexpr std::size_t kMaxLineBytes = 16 * 1024;
constexpr int kPauseMilliseconds = 200;
constexpr std::chrono::milliseconds kWaitTimeout{500};
// maximum number of reads (4 KiB each) after the end of a child, enough for a full pipe
constexpr int kMaxReadsAtEnd = 1000;

// Returns how the child ended. Does not reap the child, because its ChildProcess does that.
std::string EndingOf(pid_t pid) {
  siginfo_t info{};
  if (waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
      info.si_pid != pid) {
    return "unknown result";
  }
  return (info.si_code == CLD_EXITED ? "exit code " : "signal ") + std::to_string(info.si_status);
}

}  // namespace

OutputReader::OutputReader(Callbacks callbacks) : callbacks_(std::move(callbacks)) {
  if (pipe2(wake_ends_, O_CLOEXEC | O_NONBLOCK) != 0) wake_ends_[0] = wake_ends_[1] = -1;
  thread_ = std::jthread([this] { Run(); });
}

OutputReader::~OutputReader() {
  {
    const base::MutexLock lock(mutex_);
    is_stopping_ = true;
  }
  Wake();
  thread_.join();
  for (const int end : wake_ends_) {
    if (end >= 0) close(end);
  }
}

void OutputReader::Wake() {
  const char byte = 0;
  while (write(wake_ends_[1], &byte, 1) < 0 && errno == EINTR) {
  }
}

void OutputReader::AddErrors(const ChildProcess& child) {
  {
    const base::MutexLock lock(mutex_);
    added_.push_back({child.pid(), child.errors(), Stream::kErrors, {}});
    added_children_[child.pid()] = child.pid_descriptor();
  }
  Wake();
}

void OutputReader::AddOutput(ChildProcess& child) {
  {
    const base::MutexLock lock(mutex_);
    added_.push_back({child.pid(), child.output(), Stream::kOutput, child.TakeBuffer()});
  }
  Wake();
}

void OutputReader::WaitForOutput() {
  base::MutexLock lock(mutex_);
  has_waiter_ = true;
  Wake();
  all_read_.wait_for(lock, kWaitTimeout, [this]() GSV_REQUIRES(mutex_) { return !has_waiter_; });
}

void OutputReader::Emit(const Source& source, const std::string& line) {
  callbacks_.on_line(source.pid, source.stream, line);
}

bool OutputReader::Read(Source& source) {
  std::array<char, 4096> bytes;
  const ssize_t count = read(source.descriptor, bytes.data(), bytes.size());
  if (count < 0) return errno == EINTR || errno == EAGAIN;
  if (count == 0) {
    if (!source.partial.empty()) Emit(source, std::exchange(source.partial, {}));
    return false;
  }
  source.partial.append(bytes.data(), static_cast<std::size_t>(count));
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = source.partial.find('\n', begin);
    if (end == std::string::npos) break;
    Emit(source, source.partial.substr(begin, end - begin));
    begin = end + 1;
  }
  source.partial.erase(0, begin);
  if (source.partial.size() >= kMaxLineBytes) Emit(source, std::exchange(source.partial, {}));
  return true;
}

// Limits the number of reads, because another process that the child started may keep the pipe open
// and write to it forever.
void OutputReader::ReadRest(Source& source) {
  pollfd event{source.descriptor, POLLIN, 0};
  for (int i = 0; i < kMaxReadsAtEnd && poll(&event, 1, 0) > 0 && Read(source); ++i) {
  }
  if (!source.partial.empty()) Emit(source, std::exchange(source.partial, {}));
}

void OutputReader::EndChild(pid_t pid) {
  for (Source& source : sources_) {
    if (source.pid == pid) ReadRest(source);
  }
  std::erase_if(sources_, [&](const Source& source) { return source.pid == pid; });
  callbacks_.on_end(pid, EndingOf(pid));
}

void OutputReader::Run() {
  pthread_setname_np(pthread_self(), "output");
  for (;;) {
    bool has_waiter = false;
    {
      const base::MutexLock lock(mutex_);
      if (is_stopping_) break;
      has_waiter = has_waiter_;
      std::move(added_.begin(), added_.end(), std::back_inserter(sources_));
      added_.clear();
      for (const auto& [pid, descriptor] : added_children_) children_[pid] = {descriptor, false};
      added_children_.clear();
    }
    std::vector<pollfd> events{{wake_ends_[0], POLLIN, 0}};
    for (const Source& source : sources_) events.push_back({source.descriptor, POLLIN, 0});
    std::vector<pid_t> watched;
    for (const auto& [pid, child] : children_) {
      if (child.has_ended) continue;
      watched.push_back(pid);
      events.push_back({child.pid_descriptor, POLLIN, 0});
    }
    const int ready = poll(events.data(), events.size(), has_waiter ? 0 : kPauseMilliseconds);
    if (events[0].revents != 0) {
      std::array<char, 64> bytes;
      while (read(wake_ends_[0], bytes.data(), bytes.size()) > 0) {
      }
    }
    const std::size_t read_count = sources_.size();
    if (ready > 0) {
      for (std::size_t i = 0; i < read_count; ++i) {
        if (events[1 + i].revents != 0 && !Read(sources_[i])) sources_[i].descriptor = -1;
      }
      std::erase_if(sources_, [](const Source& source) { return source.descriptor < 0; });
      for (std::size_t i = 0; i < watched.size(); ++i) {
        if (events[1 + read_count + i].revents == 0) continue;
        children_[watched[i]].has_ended = true;
        EndChild(watched[i]);
      }
    }
    callbacks_.on_pause();
    if (has_waiter && ready == 0) {
      const base::MutexLock lock(mutex_);
      has_waiter_ = false;
      all_read_.notify_all();
    }
  }
  for (Source& source : sources_) ReadRest(source);
}

}  // namespace gsv::app
