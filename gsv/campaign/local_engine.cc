#include "gsv/campaign/local_engine.h"

#include <chrono>
#include <thread>
#include <utility>

#include "gsv/base/mutex.h"

namespace gsv::campaign {
namespace {

using EngineClock = std::chrono::steady_clock;
constexpr auto kWritePeriod = std::chrono::milliseconds(500);

class Work {
 public:
  Work(const LocalEngine& engine, std::vector<std::int64_t> runs)
      : engine_(engine), runs_(std::move(runs)) {
    for (int i = 0; i < engine.jobs; ++i) threads_.emplace_back([this] { ExecuteRuns(); });
  }
  ~Work() { is_cancelled_ = true; }

  // Returns the results since the last call. If there are none, waits briefly for a result.
  std::vector<RunResult> Collect() {
    base::MutexLock lock(mutex_);
    changed_.wait_for(lock, kWritePeriod,
                      [this]() GSV_REQUIRES(mutex_) { return idle_ == threads_.size(); });
    return std::exchange(done_, {});
  }
  bool IsOver() {
    const base::MutexLock lock(mutex_);
    return idle_ == threads_.size() && done_.empty();
  }
  void Cancel() { is_cancelled_ = true; }

 private:
  void ExecuteRuns() {
    base::MutexLock lock(mutex_);
    while (next_ < runs_.size() && !is_cancelled_) {
      const std::int64_t run = runs_[next_++];
      lock.unlock();
      auto result = engine_.execute(run, is_cancelled_);
      lock.lock();
      if (result) done_.push_back(*std::move(result));
    }
    ++idle_;
    changed_.notify_all();
  }

  const LocalEngine& engine_;
  const std::vector<std::int64_t> runs_;
  std::atomic<bool> is_cancelled_{false};
  base::Mutex mutex_;
  base::ConditionVariable changed_;
  std::size_t next_ GSV_GUARDED_BY(mutex_) = 0;
  std::size_t idle_ GSV_GUARDED_BY(mutex_) = 0;
  std::vector<RunResult> done_ GSV_GUARDED_BY(mutex_);
  std::vector<std::jthread> threads_;  // destroyed first, because they use the other members
};

}  // namespace

base::Status LocalEngine::Run(Results& results) const {
  const auto planned = results.PlannedRuns();
  if (!planned) return base::Fail(planned.error());
  const auto done = results.DoneRuns();
  if (!done) return base::Fail(done.error());
  const auto not_passed = results.NotPassed();
  if (!not_passed) return base::Fail(not_passed.error());
  std::vector<std::int64_t> left;
  for (std::int64_t run = 0; run < *planned; ++run) {
    if (!done->contains(run)) left.push_back(run);
  }
  return Execute(std::move(left), {static_cast<std::size_t>(*planned), done->size(), *not_passed},
                 [&](const std::vector<RunResult>& more) { return results.Add(more); });
}

base::Status LocalEngine::Execute(
    std::vector<std::int64_t> runs, Progress progress,
    const std::function<base::Status(const std::vector<RunResult>&)>& keep) const {
  const auto start = EngineClock::now();
  const std::size_t to_take = runs.size();
  std::size_t taken = 0;
  Work work(*this, std::move(runs));
  while (!work.IsOver()) {
    const std::vector<RunResult> collected = work.Collect();
    if (!collected.empty()) {
      if (auto ok = keep(collected); !ok) return ok;
    }
    taken += collected.size();
    progress.done += collected.size();
    for (const RunResult& result : collected) progress.not_passed += result.status != "passed";
    const double seconds = std::chrono::duration<double>(EngineClock::now() - start).count();
    if (taken > 0)
      progress.seconds_left =
          seconds / static_cast<double>(taken) * static_cast<double>(to_take - taken);
    if (report) report(progress);
    if (is_interrupted && is_interrupted()) work.Cancel();
  }
  return {};
}

}  // namespace gsv::campaign
