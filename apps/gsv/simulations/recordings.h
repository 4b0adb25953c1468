// The current recordings of this process. A simulation has at most one current recording.
//
// Threads  any. Starting a recording writes the models, and stopping it waits for the disk. Queries
//          of the state do not wait for these operations.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/mutex.h"
#include "gsv/gateway/program/ports.h"
#include "gsv/scenario/scenario.h"

namespace gsv::recording {
class SimulationRecorder;
}

namespace gsv::app {

// Keys of the metadata record "gsv.simulation": the command line of the recording program, as a
// JSON array of its arguments, and its working directory.
inline constexpr std::string_view kArgumentsKey = "arguments";
inline constexpr std::string_view kFolderKey = "folder";

// The selected topics and rates. Rates are in Hz of simulated time.
struct RecordingChoice {
  // empty for all topics; a topic with a trailing "/" selects all topics below it
  std::vector<std::string> topics;
  double poses_rate = 50, readings_rate = 20, images_rate = 1, beams_rate = 10;
  bool png = false;  // true for images as PNG, false for JPEG
  // The scenario to attach. By default it is derived from the simulation.
  std::optional<scenario::Scenario> scenario{};
};

// Returns a command line without tokens, which may be published.
std::vector<std::string> WithoutSecrets(std::vector<std::string> arguments);

// Returns a sentence for each pattern of a selection that matches none of `topics`. The sentence
// lists the topics.
std::vector<std::string> ProblemsOf(const RecordingChoice& choice,
                                    const std::vector<std::string>& topics);

// Sets one rate, from "KIND=HZ", such as "poses=10". The page docs/formats/recording.md lists the
// kinds at --record-rate.
base::Status SetRate(const std::string& text, RecordingChoice& choice);

// Returns the absolute path of a folder. An empty path stands for the current folder. Returns
// kInvalidArgument if the path is not a folder.
base::Result<std::filesystem::path> RecordingsFolder(const std::filesystem::path& folder);

// Starts and stops recordings.
class Recordings final : public gateway::RecordingSwitch {
 public:
  // Recordings that are started in the viewer are written to `folder`.
  explicit Recordings(std::filesystem::path folder);
  ~Recordings() override;

  // Sets the simulation that the command `gsv run` itself created. Only recordings of this
  // simulation contain the process's arguments (kArgumentsKey), so only they can be run again.
  void SetSimulationOfCommand(const std::shared_ptr<simulation::Simulation>& simulation);

  // Sets the ROS 2 settings of the scenario that is attached to this simulation's recordings. These
  // settings are not used if the caller of Start() passes a scenario.
  void SetRos2(const std::shared_ptr<simulation::Simulation>& simulation,
               const scenario::Ros2Settings& settings);

  // Starts a recording. If `path` ends in ".mcap", it is a single file; otherwise it is a folder
  // for rosbag2. Returns kInvalidArgument if the simulation is being recorded, or if the path
  // exists already.
  base::Status Start(std::shared_ptr<simulation::Simulation> simulation, const std::string& path,
                     const RecordingChoice& choice = {});
  const std::filesystem::path& folder() const { return folder_; }

  // Records to NAME-TIME.mcap in the folder, with the default selection.
  base::Status Record(const std::shared_ptr<simulation::Simulation>& simulation) override;
  base::Status StopRecording(const std::string& simulation) override { return Stop(simulation); }
  State RecordingOf(const std::string& simulation) override;
  Totals totals() override;
  // Stops a recording. Returns kNotFound if the simulation is not being recorded. Any other
  // returned error is the error that ended the recording.
  base::Status Stop(const std::string& simulation);
  // Stops all recordings. Returns the first error, if there is one, and logs further errors.
  base::Status StopAll();

 private:
  // A current recording.
  struct Recording {
    std::weak_ptr<simulation::Simulation> simulation;
    std::string path;
    std::string bag;  // the file in a rosbag2 folder; empty for a single file
    std::unique_ptr<recording::SimulationRecorder> recorder;
  };
  // Finishes a recording that has ended, before a new one starts. Returns kInvalidArgument if the
  // simulation is being recorded.
  base::Status FinishEndedRecording(const std::shared_ptr<simulation::Simulation>& simulation);
  // Ends a recording, and writes the metadata of its rosbag2 folder.
  static base::Status Finish(Recording& recording);
  // Returns the state of a recording, for viewers.
  static State StateOf(const Recording& recording);
  // Adds the messages, dropped messages and bytes of one recording to `totals`.
  static void Add(const State& state, Totals& totals);
  // Adds the messages, dropped messages and bytes of an ended recording to ended_.
  void CountEnded(const Recording& recording);
  // Stores the state of a recording that ends. RecordingOf() returns this state from then on, so
  // that the path remains known.
  void SetLast(const std::string& simulation, const Recording& recording) GSV_REQUIRES(mutex_);

  const std::filesystem::path folder_;
  base::Mutex starting_;  // held while a recording starts; locked before mutex_
  base::Mutex mutex_;     // never held while waiting for the disk
  // by the name of the simulation
  std::map<std::string, Recording> recordings_ GSV_GUARDED_BY(mutex_);
  std::map<std::string, State> last_
      GSV_GUARDED_BY(mutex_);  // recordings that have ended, by the name of the simulation
  Totals ended_ GSV_GUARDED_BY(mutex_);     // totals of the ended recordings
  Totals reported_ GSV_GUARDED_BY(mutex_);  // the totals that were last returned
  // The argument of SetSimulationOfCommand().
  std::weak_ptr<simulation::Simulation> of_command_ GSV_GUARDED_BY(mutex_);
  // The simulation that is published to ROS 2 nodes, and its ROS 2 settings.
  std::weak_ptr<simulation::Simulation> published_ GSV_GUARDED_BY(mutex_);
  scenario::Ros2Settings ros2_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::app
