// A thread pool for parallel loops: one range of work at a time.
//
// Threads      one caller of ParallelFor() at a time; the caller also processes pieces.
// Determinism  the assignment of pieces to threads varies. So pieces must not depend on each other,
//              and their results must not depend on how the range is divided.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <thread>
#include <type_traits>
#include <vector>

#include "gsv/base/mutex.h"

namespace gsv::base {

// The threads of a parallel loop. They are started once and used for many loops.
class ThreadTeam {
 public:
  // Returns the number of processors, but at most `kMaxDefaultThreads`.
  static int DefaultThreads();
  static constexpr int kMaxDefaultThreads = 16;

  // `threads` >= 1, including the caller of ParallelFor().
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int threads() const { return static_cast<int>(workers_.size()) + 1; }

  // Calls work(begin, end) for pieces of [0, count) with at most `grain` indices each (with one
  // thread: for the whole range), and returns when all calls have returned. If there is only one
  // piece, the caller processes it and no worker is woken. `work` does not throw and calls no
  // ParallelFor() itself. It may have a third parameter: the index of the calling thread, from 0 to
  // threads() - 1. If it has a function End(thread), each thread calls it after its last piece.
  template <class Work>
  void ParallelFor(std::size_t count, std::size_t grain, const Work& work) {
    ParallelFor(count, grain, work, [] {});
  }
  // Also calls own() on the calling thread, while the workers already process pieces. `own` does
  // not throw, calls no ParallelFor() itself, and does not depend on the pieces.
  template <class Work, class Own>
  void ParallelFor(std::size_t count, std::size_t grain, const Work& work, const Own& own) {
    if (count <= grain || workers_.empty()) {
      own();
      if (count > 0) Call<Work>(&work, 0, count, 0);
      if (count > 0) End<Work>(&work, 0);
      return;
    }
    Open({count, grain, &work, &Call<Work>, &End<Work>});
    own();
    RunPieces(0);
    WaitForWorkers();
  }

 private:
  // One call of ParallelFor(): its arguments, and the instances of Call() and End() that convert
  // `work` back to its type.
  struct Job {
    std::size_t count = 0, grain = 1;
    const void* work = nullptr;
    void (*call)(const void* work, std::size_t begin, std::size_t end,
                 std::size_t thread) = nullptr;
    void (*end)(const void* work, std::size_t thread) = nullptr;
  };

  template <class Work>
  // Calls the function object `of`, whose type is Work, for one piece.
  static void Call(const void* of, std::size_t begin, std::size_t end, std::size_t thread) {
    const Work& work = *static_cast<const Work*>(of);
    if constexpr (std::is_invocable_v<Work, std::size_t, std::size_t, std::size_t>) {
      work(begin, end, thread);
    } else {
      work(begin, end);
    }
  }
  // Calls the function End() of `of`, if it has one.
  template <class Work>
  static void End(const void* of, std::size_t thread) {
    if constexpr (requires(const Work& work) { work.End(thread); }) {
      static_cast<const Work*>(of)->End(thread);
    }
  }

  // Divides the job among the threads, and lets the workers join it.
  void Open(const Job& job);
  // The function of each worker thread. `self` is the index of the thread, see ParallelFor().
  void Work(std::size_t self);
  // Returns when all workers that have joined the job have left it.
  void WaitForWorkers();
  // Processes pieces of the open job until none is left, and then closes the job.
  void RunPieces(std::size_t self);
  // Waits for an open job and joins it. Returns false when the team ends.
  bool Join();
  // Adds the calling thread to the workers of the open job. ParallelFor() waits for all these
  // workers. Returns false if no job is open.
  bool TryJoin();

  // Workers may join a job while the job is open. The first thread that finds no piece left closes
  // the job. The caller then waits for the workers that have joined, and not for workers that wake
  // later.
  static constexpr unsigned kOpen = 1u << 31;
  Job job_;  // the open job, or the last one
  // The part of the range with which a thread begins. Equal parts in successive jobs keep data in
  // the thread's cache. When its own part is done, the thread processes pieces of the other parts.
  struct alignas(64) Part {
    std::atomic<std::size_t> next{0};  // index at which the next piece begins
    std::size_t end = 0;
  };
  std::vector<Part> parts_;         // one per thread; parts_[0] belongs to the caller
  std::atomic<unsigned> state_{0};  // the bit kOpen, and the number of workers that have joined
  std::atomic<bool> is_stopping_{false};
  Mutex mutex_;
  ConditionVariable called_;  // notified when a job opens, and when the team ends
  std::vector<std::thread> workers_;
};

}  // namespace gsv::base
