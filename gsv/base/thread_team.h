// Threads that share out one range of work at a time and wait for each other.
//
// Threads      one caller of ParallelFor() at a time; it works along.
// Determinism  which thread takes which piece is not determined: pieces must not depend on each
//              other, and what they write must not depend on how the range is cut.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"

namespace gsv::base {

class ThreadTeam {
 public:
  // As many as the machine has processors, but not more than `kMaxDefaultThreads`.
  static int DefaultThreads();
  static constexpr int kMaxDefaultThreads = 16;

  // `threads` >= 1, the caller of ParallelFor() among them.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int threads() const { return static_cast<int>(workers_.size()) + 1; }

  // Calls work(begin, end) for pieces of at most `grain` that together are [0, count), and returns
  // when all are done. A single piece is done by the caller alone: small work pays for no thread.
  // `work` does not throw and calls no ParallelFor() itself.
  template <class Work>
  void ParallelFor(std::size_t count, std::size_t grain, const Work& work) {
    if (count <= grain || workers_.empty()) {
      if (count > 0) work(std::size_t{0}, count);
      return;
    }
    Run({count, grain, &work, [](const void* of, std::size_t begin, std::size_t end) {
           (*static_cast<const Work*>(of))(begin, end);
         }});
  }

 private:
  struct Job {
    std::size_t count = 0, grain = 1;
    const void* work = nullptr;
    void (*call)(const void* work, std::size_t begin, std::size_t end) = nullptr;
  };

  void Run(const Job& job);
  void Work(std::size_t self);
  void WaitForWorkers();
  void RunPieces(std::size_t self);
  // Waits for a job that is open and takes part in it; false at the end.
  bool Join();
  bool TryJoin();

  // While a job is open workers may join it; whoever finds no piece left closes it, and the caller
  // waits for those who joined. A worker that wakes too late is not waited for.
  static constexpr unsigned kOpen = 1u << 31;
  Job job_;
  // A thread's own part of the range. It begins there, so that from one job to the next it tends to
  // find what it works on in its own cache; then it helps the others.
  struct alignas(64) Part {
    std::atomic<std::size_t> next{0};  // where the next piece begins
    std::size_t end = 0;
  };
  std::vector<Part> parts_;         // of each thread, the caller's first
  std::atomic<unsigned> state_{0};  // kOpen, and how many workers have joined
  std::atomic<bool> is_stopping_{false};
  Mutex mutex_;
  ConditionVariable called_;
  std::vector<std::thread> workers_;
};

}  // namespace gsv::base
