// A ReplayPlayer plays a recording for viewers. In a gateway for replays, it has the role of the
// simulation.
//
// Threads  any. This object has its own thread, which reads the file and publishes.
// Errors   kNotRunning with a sentence if the phase does not allow an action.
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

// How a replay plays.
struct ReplayOptions {
  double speed = 1;   // simulated seconds per second of wall-clock time, > 0
  bool loop = false;  // whether to restart at the end
};

// Plays a recording for viewers.
class ReplayPlayer {
 public:
  // Opens a recording at its start. Fails if the file is not a recording or has no messages.
  static base::Result<std::unique_ptr<ReplayPlayer>> Open(const std::string& path,
                                                          const ReplayOptions& options);
  // Like the function above, for a recording that is open already. `name` is the simulation's name
  // if the recording does not contain it. `models`: see RecordedScene.
  static base::Result<std::unique_ptr<ReplayPlayer>> Open(
      std::unique_ptr<recording::McapReader> reader, const std::string& name,
      const ReplayOptions& options, ModelSource models = nullptr);
  ~ReplayPlayer();

  const std::string& name() const { return name_; }  // name of the recorded simulation
  const std::shared_ptr<Hub>& hub() const { return stream_.hub(); }
  const RecordedScene& scene() const { return scene_; }
  const recording::McapReader& reader() const { return *reader_; }
  const RecordedTimeline& timeline() const { return timeline_; }
  // Curves over the whole recording.
  curves::RecordedCurves& curves() { return curves_; }
  // Problems of the file.
  const base::Problems& problems() const { return problems_; }

  // Returns the recorded status at the replay's position, in the form of a simulation's status.
  simulation::SimulationStatus status() const;
  // Returns the recorded scene for the current poses.
  base::Result<SharedBytes> SceneNow() const;
  // Returns the recorded poses at the replay's position; empty if there are none yet.
  messages::gsv_msgs::Poses poses() const { return stream_.recorded_poses(); }
  // Returns a copy of the clock of the replay.
  ReplayClock clock() const;

  // Start(), Pause() and Resume() fail with kNotRunning if the present phase does not allow them.
  base::Status Start();
  base::Status Pause();
  base::Status Resume();
  // Advances by `count` steps of the simulation and pauses.
  base::Status Step(std::int64_t count);
  // Returns to the start, in the phase kCreated.
  void Rewind();
  // Moves to the instant, limited to the recording, and continues playing if it played.
  void Seek(base::SimTime time);
  // Moves to the `count`th recorded pose after the position, or before it if negative, and pauses.
  base::Status StepPoses(std::int64_t count);
  base::Status SetSpeed(double speed);
  void SetLoop(bool loop);
  // Returns the recorded topics of a robot's sensors and advertises them from now on.
  std::vector<std::string> ListTopicsOf(const std::string& robot);

  // Ends the thread and refuses further viewers.
  void Stop();

 private:
  ReplayPlayer(std::unique_ptr<recording::McapReader> reader, const std::string& path,
               const ReplayOptions& options, ModelSource models);

  // Reads the recording's metadata: name, mode and step size.
  void ReadMetadata();
  template <typename Change>
  auto Command(Change change);
  // Makes the thread publish at once.
  void Wake();
  // The main function of the thread.
  void Run();

  const std::unique_ptr<recording::McapReader> reader_;
  std::string name_;
  // The mode and the step size of the recorded simulation.
  simulation::Mode mode_ = simulation::Mode::kRealTime;
  base::SimTime step_ = std::chrono::milliseconds(10);
  const RecordedScene scene_;
  const RecordedTimeline timeline_;
  curves::RecordedCurves curves_;
  base::Problems problems_;

  mutable base::Mutex mutex_;
  base::ConditionVariable changed_;  // notified after commands, by Wake() and by Stop()
  ReplayClock clock_ GSV_GUARDED_BY(mutex_);
  // Whether the position has jumped since the last publication.
  bool has_jumped_ GSV_GUARDED_BY(mutex_) = false;
  bool is_woken_ GSV_GUARDED_BY(mutex_) = false;  // see Wake()
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;

  ReplayStream stream_;
  std::thread thread_;  // executes Run()
};

}  // namespace gsv::gateway
