// The current recordings of this process, at most one per simulation.
//
// Threads  any. Starting writes the models, and stopping waits for the disk. Queries of the state
//          wait for neither.
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

// The selection of topics and rates; rates in Hz of simulated time.
struct RecordingChoice {
  std::vector<std::string> topics;  // empty: all; a topic with a trailing "/" selects all below it
  double poses_rate = 50, readings_rate = 20, images_rate = 1, beams_rate = 10;
  bool png = false;  // images as PNG, else JPEG
  // The scenario to attach; default: derived from the simulation.
  std::optional<scenario::Scenario> scenario{};
};

// A command line without tokens, so that it may be published.
std::vector<std::string> WithoutSecrets(std::vector<std::string> arguments);

// A sentence for each pattern in a selection that matches none of `topics`, with the topics that
// there are.
std::vector<std::string> ComplaintsAbout(const RecordingChoice& choice,
                                         const std::vector<std::string>& topics);

// Sets one rate, from "KIND=HZ" with poses, readings, images or beams.
base::Status SetRate(const std::string& text, RecordingChoice& choice);

// The absolute path of a folder; empty: the current one. kInvalidArgument: it is not a folder.
base::Result<std::filesystem::path> RecordingsFolder(const std::filesystem::path& folder);

class Recordings final : public gateway::RecordingSwitch {
 public:
  // `folder`: for recordings that are started in the viewer.
  explicit Recordings(std::filesystem::path folder);
  ~Recordings() override;

  // Only recordings of this simulation contain the arguments of this process: those of its `gsv
  // run`, with which the recording can be simulated again.
  void SetSimulationOfCommand(const std::shared_ptr<simulation::Simulation>& simulation);

  // `path` ends in ".mcap": a single file; else a folder for rosbag2. kInvalidArgument if the
  // simulation is being recorded, or the path exists already.
  base::Status Start(std::shared_ptr<simulation::Simulation> simulation, const std::string& path,
                     const RecordingChoice& choice = {});
  const std::filesystem::path& folder() const { return folder_; }

  // Records to NAME-TIME.mcap in that folder, with the default selection.
  base::Status Record(const std::shared_ptr<simulation::Simulation>& simulation) override;
  base::Status StopRecording(const std::string& simulation) override { return Stop(simulation); }
  State RecordingOf(const std::string& simulation) override;
  Totals totals() override;
  // kNotFound if that simulation is not recorded. Any other error is that which ended the
  // recording.
  base::Status Stop(const std::string& simulation);
  // Returns the first error, if there is one; logs the others.
  base::Status StopAll();

 private:
  struct Recording {
    std::weak_ptr<simulation::Simulation> simulation;
    std::string path;
    std::string bag;  // the file in a rosbag2 folder; empty: a single file
    std::unique_ptr<recording::SimulationRecorder> recorder;
  };
  // Finishes an ended recording before a new one. kInvalidArgument if the simulation is being
  // recorded.
  base::Status FinishThatWhichIsOver(const std::shared_ptr<simulation::Simulation>& simulation);
  static base::Status Finish(Recording& recording);
  static State StateOf(const Recording& recording);
  static void Add(const State& state, Totals& totals);
  void CountEnded(const Recording& recording);

  const std::filesystem::path folder_;
  base::Mutex starting_;  // one at a time; taken before mutex_
  base::Mutex mutex_;     // never held while waiting for the disk
  std::map<std::string, Recording> recordings_ GSV_GUARDED_BY(mutex_);  // by the simulation's name
  std::map<std::string, State> last_
      GSV_GUARDED_BY(mutex_);            // ended ones, by the simulation's name
  Totals ended_ GSV_GUARDED_BY(mutex_);  // of the ended ones
  Totals told_ GSV_GUARDED_BY(mutex_);   // as returned last
  std::weak_ptr<simulation::Simulation> of_command_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::app
