#include "gsv/gateway/curves/recorded_curves.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace gsv::gateway::curves {
namespace {

constexpr std::size_t kMaxCurves = 16;
constexpr int kMessagesBetweenChecks = 256;  // number of messages between two checks of the clock
                                             // and of is_dropped

}  // namespace

struct RecordedCurves::Job {
  Job(const CurveRequest& requested, std::unique_ptr<CurveSource> made,
      const recording::Summary& summary)
      : request(requested),
        source(std::move(made)),
        points(summary.start, summary.end, requested.max_points),
        read_to(summary.start) {}

  const CurveRequest request;
  const std::unique_ptr<CurveSource> source;  // used only by the reading thread
  std::atomic<bool> is_dropped = false;

  base::Mutex mutex;
  CurvePoints points GSV_GUARDED_BY(mutex);
  base::SimTime read_to GSV_GUARDED_BY(mutex);
  bool is_done GSV_GUARDED_BY(mutex) = false;
  std::string problem GSV_GUARDED_BY(mutex);
};

base::Result<Curve> RecordedCurves::Get(const CurveRequest& request) {
  if (request.max_points < 2 || request.max_points > kMaxCurvePoints) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "'most' must be a number from 2 to 100000");
  }
  std::shared_ptr<Job> job;
  {
    const base::MutexLock lock(mutex_);
    if (is_stopping_) {
      return base::Fail(base::ErrorCode::kUnavailable, "the server is shutting down");
    }
    job = Find(request);
    if (!job) {
      auto source = MakeCurveSource(reader_, scene_, request);
      if (!source) return base::Fail(source.error());
      job = std::make_shared<Job>(request, *std::move(source), reader_.summary());
      jobs_.push_back(job);
      if (jobs_.size() > kMaxCurves) {
        jobs_.front()->is_dropped = true;
        jobs_.erase(jobs_.begin());
      }
      if (!thread_.joinable()) thread_ = std::thread([this] { Run(); });
      changed_.notify_all();
    }
  }
  const base::MutexLock lock(job->mutex);
  return Curve{job->points.Points(), job->points.samples(), job->points.is_whole(),
               job->is_done,         job->read_to,          job->problem};
}

std::shared_ptr<RecordedCurves::Job> RecordedCurves::Find(const CurveRequest& request) {
  const auto found = std::find_if(jobs_.begin(), jobs_.end(),
                                  [&](const auto& job) { return job->request == request; });
  if (found == jobs_.end()) return nullptr;
  std::rotate(found, found + 1, jobs_.end());
  return jobs_.back();
}

void RecordedCurves::Stop() {
  std::thread thread;
  {
    const base::MutexLock lock(mutex_);
    is_stopping_ = true;
    for (const auto& job : jobs_) job->is_dropped = true;
    thread.swap(thread_);
    changed_.notify_all();
  }
  if (thread.joinable()) thread.join();
}

void RecordedCurves::Run() {
  const auto is_waiting = [](const std::shared_ptr<Job>& job) {
    const base::MutexLock lock(job->mutex);
    return !job->is_done;
  };
  for (;;) {
    std::shared_ptr<Job> job;
    {
      base::MutexLock lock(mutex_);
      changed_.wait(lock, [&]() GSV_REQUIRES(mutex_) {
        return is_stopping_ || std::any_of(jobs_.begin(), jobs_.end(), is_waiting);
      });
      if (is_stopping_) return;
      job = *std::find_if(jobs_.begin(), jobs_.end(), is_waiting);
    }
    Read(*job);
  }
}

void RecordedCurves::Read(Job& job) {
  const auto end = std::chrono::steady_clock::now() + timeout_;
  recording::MessageCursor cursor = reader_.Messages();
  const auto finish = [&](const std::string& problem) {
    const base::MutexLock lock(job.mutex);
    job.is_done = true;
    if (!problem.empty()) job.problem = problem;
  };
  for (int count = 1;; ++count) {
    if (count % kMessagesBetweenChecks == 0) {
      if (job.is_dropped) return finish("no viewer needs the curve any more");
      if (std::chrono::steady_clock::now() > end) {
        return finish("reading the recording took too long; the curve is incomplete");
      }
    }
    const auto message = cursor.Next();
    if (!message) {  // a part of the file is damaged; the next call of Next() continues after it
      const base::MutexLock lock(job.mutex);
      job.problem = message.error().Sentence();
      continue;
    }
    if (!*message) break;
    const std::optional<double> sample = job.source->SampleIn(**message);
    const base::MutexLock lock(job.mutex);
    job.read_to = (*message)->log_time;
    if (sample) job.points.Add((*message)->log_time, *sample);
  }
  finish("");
}

}  // namespace gsv::gateway::curves
