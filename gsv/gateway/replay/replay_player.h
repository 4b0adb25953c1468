// A recording that plays: what a simulation is to the live gateway.
//
// Threads  any; a thread of its own reads the file and publishes.
// Errors   kNotRunning with a sentence when the phase does not allow an action.
#pragma once

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/gateway/curves/recorded_curves.h"
#include "gsv/gateway/recorded/recorded_scene.h"
#include "gsv/gateway/recorded/recorded_timeline.h"
#include "gsv/gateway/replay/replay_clock.h"
#include "gsv/gateway/replay/replay_stream.h"

namespace gsv::gateway {

struct ReplayOptions {
  double speed = 1;   // simulated seconds a wall second, > 0
  bool loop = false;  // begins anew at the end
};

class ReplayPlayer {
 public:
  // Stands at the beginning. Fails when the file is no recording, or holds no messages.
  static base::Result<std::unique_ptr<ReplayPlayer>> Open(const std::string& path,
                                                          const ReplayOptions& options);
  ~ReplayPlayer();

  const std::string& name() const { return name_; }  // the recorded simulation's
  const std::shared_ptr<Hub>& hub() const { return stream_.hub(); }
  const RecordedScene& scene() const { return scene_; }
  const RecordedTimeline& timeline() const { return timeline_; }
  // Values over the whole recording.
  curves::RecordedCurves& curves() { return curves_; }
  // What the file lacks.
  const base::Problems& problems() const { return problems_; }

  // As of a simulation, at the replay's position.
  simulation::SimulationStatus status() const;
  base::Result<SharedBytes> SceneNow() const;
  ReplayClock clock() const;

  base::Status Start();
  base::Status Pause();
  base::Status Resume();
  // Moves on by so many of the simulation's steps, then stands still.
  base::Status Step(std::int64_t count);
  void Rewind();
  // To the instant, or the end that is nearer; plays on if it played.
  void Seek(base::SimTime time);
  // Goes to the recorded pose so many after the present instant, or before it if negative, and
  // stands still there.
  base::Status StepPoses(std::int64_t count);
  base::Status SetSpeed(double speed);
  void SetLoop(bool loop);
  // The recorded topics of the robot's sensors, which are listed to viewers from now on.
  std::vector<std::string> ListTopicsOf(const std::string& robot);

  // Ends the thread and lets nobody in any more.
  void Stop();

 private:
  ReplayPlayer(std::unique_ptr<recording::McapReader> reader, const std::string& path,
               const ReplayOptions& options);

  void ReadMetadata();
  template <typename Change>
  auto Command(Change change);
  void Wake();
  void Run();

  const std::unique_ptr<recording::McapReader> reader_;
  std::string name_;
  simulation::Mode mode_ = simulation::Mode::kRealTime;
  base::SimTime step_ = std::chrono::milliseconds(10);
  const RecordedScene scene_;
  const RecordedTimeline timeline_;
  curves::RecordedCurves curves_;
  base::Problems problems_;

  mutable base::Mutex mutex_;
  base::ConditionVariable changed_;
  ReplayClock clock_ GSV_GUARDED_BY(mutex_);
  bool has_jumped_ GSV_GUARDED_BY(mutex_) = false;
  bool is_woken_ GSV_GUARDED_BY(mutex_) = false;
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;

  ReplayStream stream_;
  std::thread thread_;
};

}  // namespace gsv::gateway
