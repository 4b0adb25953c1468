#include "gsv/campaign/queue_driver.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "gsv/base/sorting.h"

namespace gsv::campaign {
namespace {

using DriverClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kGatherPeriod{500};
// if there is no progress for this time, the driver prints why the tasks wait
constexpr auto kSilence = std::chrono::seconds(30);
constexpr std::size_t kFewTasks = 1000;
// a run gets the result "error" after this number of tasks have ended without finishing it
constexpr std::size_t kMaxAttempts = 3;
// a task counts as lost if this number of consecutive queries did not list it
constexpr int kMissedQueriesUntilGone = 2;
// maximum number of bytes of a task's log in an error message
constexpr std::size_t kMaxLogBytes = 1000;

std::string EndOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  std::string end = text.str();
  if (end.size() > kMaxLogBytes) end = "…" + end.substr(end.size() - kMaxLogBytes);
  while (!end.empty() && end.back() == '\n') end.pop_back();
  return end;
}

class Drive {
 public:
  Drive(const QueueDriver& settings, Spool& spool, Results& results)
      : settings_(settings), spool_(spool), results_(results) {}

  base::Status Run() {
    auto batches = spool_.Batches();
    if (!batches) return base::Fail(batches.error());
    batches_ = *std::move(batches);
    progress_.planned = spool_.campaign().runs();
    if (auto ok = CollectResults(); !ok) return ok;
    done_before_ = done_.size();
    auto next_look = start_;
    while (done_.size() < progress_.planned) {
      if (DriverClock::now() >= next_look) {
        if (auto ok = QueryAndSubmit(); !ok) return ok;
        if (!settings_.waits && IsSubmissionComplete()) return {};
        next_look = DriverClock::now() + settings_.poll_period;
      }
      if (settings_.is_interrupted(std::min(kGatherPeriod, settings_.poll_period))) return {};
      if (auto ok = CollectResults(); !ok) return ok;
    }
    return {};
  }

 private:
  // Collects new results and updates the state of the runs.
  base::Status CollectResults() {
    const auto gathered = Gather(spool_, results_);
    if (!gathered) return base::Fail(gathered.error());
    if (*gathered > 0 || done_.empty()) {
      auto done = results_.DoneRuns();
      if (!done) return base::Fail(done.error());
      if (done->size() != done_.size()) last_progress_ = DriverClock::now();
      done_ = *std::move(done);
      const auto not_passed = results_.NotPassed();
      if (!not_passed) return base::Fail(not_passed.error());
      progress_.not_passed = *not_passed;
    }
    progress_.done = done_.size();
    const double seconds = std::chrono::duration<double>(DriverClock::now() - start_).count();
    if (done_.size() > done_before_) {
      progress_.seconds_left = seconds / static_cast<double>(done_.size() - done_before_) *
                               static_cast<double>(progress_.planned - done_.size());
    }
    if (settings_.report) settings_.report(progress_);
    return {};
  }

  base::Status QueryAndSubmit() {
    const std::vector<Batch> open = OpenBatches();
    auto tasks = settings_.queue.TasksOf(open);
    if (!tasks) {
      // The content of the queue is unknown, so nothing can be submitted. Running tasks continue.
      base::Error error = tasks.error();
      if (error.code == base::ErrorCode::kNotFound) {
        // The command line would report kNotFound with the exit code of a missing file.
        error.code = base::ErrorCode::kUnavailable;
        return base::Fail(error);
      }
      if (!has_queried_) return base::Fail(error);
      if (!std::exchange(is_queue_silent_, true))
        settings_.say(tasks.error().Sentence() +
                      "; gsv will query the queue again, and running tasks continue");
      return {};
    }
    has_queried_ = true;
    is_queue_silent_ = false;
    for (const Batch& batch : open) {
      for (std::size_t task = 0; task < batch.tasks(); ++task) {
        const std::string share = batch.ShareOf(task);
        missed_queries_[share] = tasks->contains(share) ? 0 : missed_queries_[share] + 1;
      }
    }
    ExplainTheWait(*tasks);
    // Collects again, because a task may have written results between the last collection and the
    // query.
    if (auto ok = CollectResults(); !ok) return ok;
    if (auto ok = DropBatchesWithoutRuns(); !ok) return ok;
    auto missing = MissingRuns();
    if (!missing) return base::Fail(missing.error());
    if (missing->empty()) return {};
    if (is_waiting_to_submit_ && tasks->size() >= tasks_at_refusal_) return {};
    return SubmitRuns(*std::move(missing), tasks->size());
  }

  // Returns the batches that have unfinished runs.
  std::vector<Batch> OpenBatches() const {
    std::vector<Batch> open;
    for (const Batch& batch : batches_) {
      if (std::any_of(batch.runs.begin(), batch.runs.end(),
                      [this](std::int64_t run) { return !done_.contains(run); }))
        open.push_back(batch);
    }
    return open;
  }

  bool IsGone(const Batch& batch, std::size_t task) const {
    const auto missed = missed_queries_.find(batch.ShareOf(task));
    return missed != missed_queries_.end() && missed->second >= kMissedQueriesUntilGone;
  }

  // Whether all runs are in submitted tasks, and the state of every task is certain. A task that
  // one query does not list may still be in the queue. Only if the next query does not list it
  // either, the task counts as lost.
  bool IsSubmissionComplete() const {
    return !is_waiting_to_submit_ &&
           std::none_of(missed_queries_.begin(), missed_queries_.end(), [](const auto& missed) {
             return missed.second > 0 && missed.second < kMissedQueriesUntilGone;
           });
  }

  // Drops the batches that left the queue before any of their runs began. An earlier driver may
  // have cancelled such a batch, or not have submitted it. If this driver submitted such a batch,
  // this function fails.
  base::Status DropBatchesWithoutRuns() {
    for (const Batch& batch : OpenBatches()) {
      bool has_no_run = true;
      for (std::size_t task = 0; task < batch.tasks() && has_no_run; ++task)
        has_no_run = IsGone(batch, task) && !HasBegun(batch.ShareOf(task));
      if (!has_no_run) continue;
      spool_.Remove(batch);
      std::erase_if(batches_, [&](const Batch& one) { return one.number == batch.number; });
      if (!ours_.contains(batch.number)) continue;
      const auto log = spool_.LogOf(batch, "0");
      const std::string said = EndOf(log);
      return base::Fail(
          base::ErrorCode::kUnavailable,
          fmt::format(
              "{}: job {} ended before any of its runs started{}", settings_.title, batch.job,
              said.empty()
                  ? "; check that it was not cancelled, and that the nodes can write to this folder"
                  : ": " + said),
          log);
    }
    return {};
  }

  bool HasBegun(const std::string& share) const {
    const std::string prefix = share + ".";
    for (auto reader = spool_.read().lower_bound(prefix);
         reader != spool_.read().end() && reader->first.starts_with(prefix); ++reader) {
      const auto& attempt = reader->second.attempt();
      if (attempt && (attempt->runs > 0 || !reader->second.open_runs().empty())) return true;
    }
    return false;
  }

  // Returns the runs that are neither done nor in the queue. If tasks have begun a run but ended
  // without its result, the run comes later in the list. After kMaxAttempts such tasks, it gets the
  // result "error".
  base::Result<std::vector<std::int64_t>> MissingRuns() {
    std::set<std::int64_t> queued;
    for (const Batch& batch : OpenBatches()) {
      for (std::size_t task = 0; task < batch.tasks(); ++task) {
        if (IsGone(batch, task)) continue;
        for (const std::int64_t run : batch.RunsOf(task)) queued.insert(run);
      }
    }
    std::map<std::int64_t, std::size_t> attempts;
    for (const auto& [name, reader] : spool_.read()) {
      for (const std::int64_t run : reader.open_runs()) ++attempts[run];
    }
    std::vector<std::int64_t> missing;
    std::vector<RunResult> given_up;
    for (std::int64_t run = 0; run < static_cast<std::int64_t>(progress_.planned); ++run) {
      if (done_.contains(run) || queued.contains(run)) continue;
      if (const auto found = attempts.find(run);
          found != attempts.end() && found->second >= kMaxAttempts) {
        given_up.push_back(GivenUp(run));
      } else {
        missing.push_back(run);
      }
    }
    base::Sort(missing, [&](std::int64_t a, std::int64_t b) { return attempts[a] < attempts[b]; });
    if (given_up.empty()) return missing;
    if (auto ok = results_.Add(given_up); !ok) return base::Fail(ok.error());
    for (const RunResult& result : given_up) done_.insert(result.run);
    return missing;
  }

  RunResult GivenUp(std::int64_t run) const {
    RunResult result{run, "error"};
    result.message = fmt::format(
        "its task ended {} times during the run; check the memory and time limits of the queue, "
        "and {}",
        kMaxAttempts, spool_.logs().string());
    const auto values = spool_.campaign().ValuesOf(static_cast<std::size_t>(run));
    for (std::size_t i = 0; i < values.size(); ++i)
      result.parameters[spool_.campaign().parameters[i].path] = values[i];
    return result;
  }

  base::Status SubmitRuns(std::vector<std::int64_t> runs, std::size_t tasks_in_queue) {
    const auto most = settings_.queue.MaxTasks();
    if (!most) return base::Fail(most.error());
    const std::size_t tasks = std::min(*most, kFewTasks);
    const std::size_t runs_per_task =
        settings_.runs_per_task > 0 ? settings_.runs_per_task : (runs.size() + tasks - 1) / tasks;
    for (std::size_t first = 0; first < runs.size(); first += *most * runs_per_task) {
      const std::size_t end = std::min(runs.size(), first + *most * runs_per_task);
      Batch batch = NewBatch(runs_per_task);
      batch.runs.assign(runs.begin() + static_cast<std::ptrdiff_t>(first),
                        runs.begin() + static_cast<std::ptrdiff_t>(end));
      if (auto ok = spool_.Put(batch); !ok) return ok;
      auto job = settings_.queue.Submit(spool_, batch);
      if (!job && job.error().code == base::ErrorCode::kNotRunning) {
        spool_.Remove(batch);
        if (tasks_in_queue == 0) return base::Fail(job.error());
        if (!std::exchange(is_waiting_to_submit_, true)) {
          settings_.say(fmt::format("{}; {} runs will be submitted when the queue is shorter",
                                    job.error().Sentence(), runs.size() - first));
        }
        tasks_at_refusal_ = tasks_in_queue;
        return {};
      }
      if (!job) return base::Fail(job.error());
      batch.job = *std::move(job);
      if (auto ok = spool_.Put(batch); !ok) return ok;
      settings_.say(fmt::format("{}: submitted {} runs in {} tasks, job {}{}", settings_.title,
                                batch.runs.size(), batch.tasks(), batch.job,
                                batch.job == batch.name ? "" : ", " + batch.name));
      tasks_in_queue += batch.tasks();
      ours_.insert(batch.number);
      batches_.push_back(std::move(batch));
    }
    is_waiting_to_submit_ = false;
    return {};
  }

  Batch NewBatch(std::size_t runs_per_task) const {
    Batch batch;
    batch.number = batches_.empty() ? 1 : batches_.back().number + 1;
    batch.submitted = UnixSeconds();
    // The name is unique even if the user deletes the spool and starts again.
    batch.name = fmt::format("gsv-{}-{}-{:x}", spool_.campaign().Identity().substr(0, 8),
                             batch.number, static_cast<std::int64_t>(1e3 * batch.submitted));
    batch.runs_per_task = runs_per_task;
    batch.timeout = settings_.timeout;
    batch.failures = settings_.failures;
    return batch;
  }

  void ExplainTheWait(const std::map<std::string, QueuedTask>& tasks) {
    std::map<std::string, std::size_t> reasons;
    for (const auto& [share, task] : tasks) {
      if (task.state != "PENDING") return;
      ++reasons[task.reason];
    }
    if (reasons.empty() || DriverClock::now() - last_progress_ < kSilence) return;
    std::string sentence = "all tasks wait in the queue:";
    for (const auto& [reason, count] : reasons)
      sentence += fmt::format(" {} for {},", count, reason);
    sentence.pop_back();
    if (sentence != std::exchange(last_said_, sentence)) settings_.say(sentence);
  }

  const QueueDriver& settings_;
  Spool& spool_;
  Results& results_;
  const DriverClock::time_point start_ = DriverClock::now();
  DriverClock::time_point last_progress_ = start_;
  std::vector<Batch> batches_;  // ordered by number
  std::set<int> ours_;          // batches that this driver submitted
  std::set<std::int64_t> done_;
  std::size_t done_before_ = 0;  // number of runs that were done when this driver started
  Progress progress_;
  // number of consecutive queries that did not list a task, by the task's share
  std::map<std::string, int> missed_queries_;
  bool has_queried_ = false, is_queue_silent_ = false, is_waiting_to_submit_ = false;
  std::size_t tasks_at_refusal_ = 0;
  std::string last_said_;
};

}  // namespace

base::Status QueueDriver::Run(Spool& spool, Results& results) const {
  return Drive(*this, spool, results).Run();
}

}  // namespace gsv::campaign
