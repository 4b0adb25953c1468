// RecordedCurves reads curves over a whole recording in the background. The first request for a
// curve starts reading. Later requests return the points that were read so far.
//
// Threads  Get() from any thread. The first Get() starts a thread that reads the recording.
// Bounded  keeps the sixteen most recently requested curves; reading a curve ends after a minute.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/gateway/curves/curve_points.h"
#include "gsv/gateway/curves/curve_source.h"

namespace gsv::gateway::curves {

// Upper limit of CurveRequest::max_points.
inline constexpr std::size_t kMaxCurvePoints = 100'000;

// The points of a curve that were read so far, and the progress of reading.
struct Curve {
  std::vector<Point> points;  // by time
  std::size_t samples = 0;    // number of samples that were read so far
  bool is_whole = true;       // whether every sample is a point
  bool is_done = false;       // whether reading has ended, at the end or earlier
  base::SimTime read_to{};    // time up to which the recording was read
  std::string problem;        // reason for missing parts; empty: none
};

// Reads curves over a whole recording in the background.
class RecordedCurves {
 public:
  // `reader` and `scene` must outlive this. `timeout`: limit for reading a curve, wall-clock time.
  RecordedCurves(const recording::McapReader& reader, const RecordedScene& scene,
                 std::chrono::milliseconds timeout = std::chrono::minutes(1))
      : reader_(reader), scene_(scene), timeout_(timeout) {}
  ~RecordedCurves() { Stop(); }

  // Returns the curve as far as it was read. Errors: see MakeCurveSource(); kInvalidArgument if
  // `request.max_points` is not from 2 to kMaxCurvePoints; kUnavailable after Stop().
  base::Result<Curve> Get(const CurveRequest& request);

  // Stops reading, and waits until the thread has ended.
  void Stop();

 private:
  // A requested curve, its points so far, and the progress of reading.
  struct Job;

  // Returns the job of the request, or null. Marks the job as the most recently used job.
  std::shared_ptr<Job> Find(const CurveRequest& request) GSV_REQUIRES(mutex_);
  // The main function of the reading thread.
  void Run();
  // Reads the messages of one curve.
  void Read(Job& job);

  const recording::McapReader& reader_;
  const RecordedScene& scene_;
  const std::chrono::milliseconds timeout_;
  base::Mutex mutex_;
  base::ConditionVariable changed_;  // notified after changes of jobs_ and is_stopping_
  std::vector<std::shared_ptr<Job>> jobs_
      GSV_GUARDED_BY(mutex_);  // the curves; the most recently requested one is last
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
  std::thread thread_;  // computes the curves; started by the first request
};

}  // namespace gsv::gateway::curves
