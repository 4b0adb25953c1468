// Values over a whole recording, read in the background. What is asked for the first time begins to
// be read; whoever asks again is told how far it has come.
//
// Threads  Get() any; one of its own reads, begun by the first Get().
// Bounded  sixteen curves are kept, those that were asked for last; reading one ends after a
// minute.
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

inline constexpr std::size_t kMaxCurvePoints = 100'000;

struct Curve {
  std::vector<Point> points;  // by time
  std::size_t samples = 0;    // that were read
  bool is_whole = true;       // every one of them is a point
  bool is_done = false;       // the recording's end was reached, or reading was given up
  base::SimTime read_to{};    // so far the points reach
  std::string problem;        // why something is missing; empty: nothing is
};

class RecordedCurves {
 public:
  // `reader` and `scene` outlive this. `longest`: how long reading a curve may take, wall time.
  RecordedCurves(const recording::McapReader& reader, const RecordedScene& scene,
                 std::chrono::milliseconds longest = std::chrono::minutes(1))
      : reader_(reader), scene_(scene), longest_(longest) {}
  ~RecordedCurves() { Stop(); }

  // As far as it is read. Errors: see MakeCurveSource(); kInvalidArgument if `wish.most` is not
  // from 2 to kMaxCurvePoints; kUnavailable after Stop().
  base::Result<Curve> Get(const CurveRequest& wish);

  // Waits until nothing is read any more.
  void Stop();

 private:
  struct Job;

  // The one for the wish, or null; it counts as asked for now.
  std::shared_ptr<Job> Find(const CurveRequest& wish) GSV_REQUIRES(mutex_);
  void Run();
  void Read(Job& job);

  const recording::McapReader& reader_;
  const RecordedScene& scene_;
  const std::chrono::milliseconds longest_;
  base::Mutex mutex_;
  base::ConditionVariable changed_;
  std::vector<std::shared_ptr<Job>> jobs_
      GSV_GUARDED_BY(mutex_);  // the one that was asked for last stands last
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

}  // namespace gsv::gateway::curves
